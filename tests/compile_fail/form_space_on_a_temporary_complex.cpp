// A form space refers to its complex, which must outlive it.
#include "derham/operators/form_space.hpp"

namespace derham {

FormSpace<2> result(const SimplicialComplex<2>& K) {
#ifndef CONTROL
  return FormSpace<2>::relative(SimplicialComplex<2>(K));
#else
  return FormSpace<2>::relative(K);
#endif
}

}  // namespace derham
