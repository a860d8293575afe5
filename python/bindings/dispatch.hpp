#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <type_traits>

namespace derham::python {

/// Calls action(std::integral_constant<int, value>) for low <= value <= high: how a dimension or a degree that is known at
/// run time becomes one that the library knows at compile time.
/// Throws   InputError that names `what` otherwise
template <int low, int high, class Action>
auto with_constant(int value, const char* what, Action&& action) {
  if (value < low || value > high) throw InputError(text(what, " is ", value, "; expected ", low, " to ", high));
  if constexpr (low < high)
    if (value > low) return with_constant<low + 1, high>(value, what, action);
  return action(std::integral_constant<int, low>());
}

}  // namespace derham::python
