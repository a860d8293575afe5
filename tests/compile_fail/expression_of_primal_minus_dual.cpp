// On primal 1-forms of a surface d is primal, ⋆ is dual: they cannot be added.
#include "derham/operators/expression.hpp"

namespace derham {

Operator<PrimalForm<2, 1>, PrimalForm<2, 1>> result(const Derivative<2>& d, const HodgeStar<2>& star) {
#ifndef CONTROL
  return star * star - star;
#else
  return star * star - d * star * d * star;
#endif
}

}  // namespace derham
