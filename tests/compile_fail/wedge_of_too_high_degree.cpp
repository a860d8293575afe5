// On a surface there are no 3-forms, so a 1-form and a 2-form have no product.
#include "derham/forms/wedge.hpp"

namespace derham {

auto result(const SimplicialComplex<2>& K) {
#ifndef CONTROL
  return wedge(PrimalForm<2, 1>(K), PrimalForm<2, 2>(K));
#else
  return wedge(PrimalForm<2, 1>(K), PrimalForm<2, 1>(K));
#endif
}

}  // namespace derham
