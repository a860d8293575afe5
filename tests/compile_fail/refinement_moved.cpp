// What refers to the fine complex of a refinement would be left behind.
#include "derham/complex/refinement.hpp"

#include <utility>

namespace derham {

Index result(const SimplicialComplex<2>& K) {
  Refinement<2> refinement(K);
#ifndef CONTROL
  const Refinement<2> moved(std::move(refinement));
  return moved.fine().size(0);
#else
  return refinement.fine().size(0);
#endif
}

}  // namespace derham
