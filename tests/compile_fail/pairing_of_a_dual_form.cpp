// Primal chains integrate primal forms.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return pair(DualForm<3, 1>(K), Chain<3, 1>(K));
#else
  return pair(Form<3, 1>(K), Chain<3, 1>(K));
#endif
}

}  // namespace derham
