// Nor has a dual 3-form.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return d(DualForm<3, 3>(K));
#else
  return d(DualForm<3, 2>(K));
#endif
}

}  // namespace derham
