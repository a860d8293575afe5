// A 0-chain has no boundary.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return boundary(Chain<3, 0>(K));
#else
  return boundary(Chain<3, 1>(K));
#endif
}

}  // namespace derham
