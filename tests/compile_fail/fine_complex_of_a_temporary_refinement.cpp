// The fine complex dies with the refinement.
#include "derham/complex/refinement.hpp"

namespace derham {

Index result(const SimplicialComplex<2>& K) {
#ifndef CONTROL
  const auto& fine = Refinement<2>(K).fine();
  return fine.size(0);
#else
  const Refinement<2> refinement(K);
  return refinement.fine().size(0);
#endif
}

}  // namespace derham
