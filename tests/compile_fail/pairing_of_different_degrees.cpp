// A 1-form is integrated over 1-chains.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return pair(Form<3, 1>(K), Chain<3, 2>(K));
#else
  return pair(Form<3, 1>(K), Chain<3, 1>(K));
#endif
}

}  // namespace derham
