// There are no 4-forms on a 3-complex.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return Form<3, 4>(K);
#else
  return Form<3, 3>(K);
#endif
}

}  // namespace derham
