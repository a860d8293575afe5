// A form refers to its complex, which must outlive it.
#include "derham/forms/form.hpp"

namespace derham {

auto result(const SimplicialComplex<1>& K) {
#ifndef CONTROL
  return Form<1, 0>(SimplicialComplex<1>(K));
#else
  return Form<1, 0>(K);
#endif
}

}  // namespace derham
