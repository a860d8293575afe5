#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace derham::meshes::detail {

/// The most simplices or vertices a generator makes: what Index can number, and few enough that n(n+1) doubles for each
/// still have an address.
inline constexpr Offset count_limit =
    std::min<Offset>(std::numeric_limits<Index>::max(), std::numeric_limits<Offset>::max() / 1024);

/// The product of `factors` >= 0. Throws LimitError naming `what` when it exceeds count_limit.
template <class Factors = std::initializer_list<Offset>>
Offset checked_count(const char* what, const Factors& factors) {
  Offset product = 1;
  for (const Offset factor : factors) {
    if (factor > 0 && product > count_limit / factor)
      throw LimitError(text("more than ", count_limit, " ", what,
                            " are asked for, the most this build can number; use ", "a coarser mesh",
                            sizeof(Index) < 8 ? " or build with DERHAM_INDEX64" : ""));
    product *= factor;
  }
  return product;
}

inline void require_dimension(int n, int lowest, int highest) {
  if (n < lowest || n > highest)
    throw InputError(text("the dimension is ", n, "; it must be ", lowest, " to ", highest));
}

inline void require_at_least(const char* what, Offset value, Offset lowest) {
  if (value < lowest) throw InputError(text(what, " is ", value, "; it must be at least ", lowest));
}

inline void require_positive(const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value)) throw InputError(text(what, " is ", value, "; it must be positive"));
}

}  // namespace derham::meshes::detail
