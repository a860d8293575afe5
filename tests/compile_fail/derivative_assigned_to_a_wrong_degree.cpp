// The derivative of a 1-form is a 2-form.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return Form<3, 1>(d(Form<3, 1>(K)));
#else
  return Form<3, 2>(d(Form<3, 1>(K)));
#endif
}

}  // namespace derham
