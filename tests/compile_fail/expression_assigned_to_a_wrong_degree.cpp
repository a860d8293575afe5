// ⋆d⋆ takes 1-forms to 0-forms.
#include "derham/operators/expression.hpp"

namespace derham {

Operator<PrimalForm<2, 1>, PrimalForm<2, 0>> result(const Derivative<2>& d, const HodgeStar<2>& star) {
#ifndef CONTROL
  return d * star * d;
#else
  return star * d * star;
#endif
}

}  // namespace derham
