// An operator refers to its complex, which must outlive it.
#include "derham/operators/operator.hpp"

namespace derham {

auto result(const SimplicialComplex<1>& K) {
#ifndef CONTROL
  return identity<Form<1, 0>>(SimplicialComplex<1>(K));
#else
  return identity<Form<1, 0>>(K);
#endif
}

}  // namespace derham
