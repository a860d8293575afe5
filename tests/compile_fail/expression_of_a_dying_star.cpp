// An expression refers to its Hodge star, which must outlive it.
#include "derham/operators/expression.hpp"

namespace derham {

using Velocity = Operator<PrimalForm<2, 0>, DualForm<2, 1>>;

Velocity result(const SimplicialComplex<2>& K, const HodgeStar<2>& star) {
  const Derivative<2> d(K);
#ifndef CONTROL
  return HodgeStar<2>(star) * d;
#else
  return star * d;
#endif
}

}  // namespace derham
