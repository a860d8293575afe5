// A primal form and a dual form cannot be added, even where both have one value per edge.
#include "derham/forms/exterior_derivative.hpp"

namespace derham {

auto result(const SimplicialComplex<3>& K) {
#ifndef CONTROL
  return Form<3, 1>(K) + DualForm<3, 2>(K);
#else
  return DualForm<3, 2>(K) + DualForm<3, 2>(K);
#endif
}

}  // namespace derham
