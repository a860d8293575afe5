// A 3-form on a 3-complex has no derivative.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return d(Form<3, 3>(K));
#else
  return d(Form<3, 2>(K));
#endif
}

}  // namespace derham
