// Forms of different degrees cannot be added.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return Form<3, 1>(K) + Form<3, 2>(K);
#else
  return Form<3, 1>(K) + Form<3, 1>(K);
#endif
}

}  // namespace derham
