// An operator on 1-forms cannot follow one that gives 2-forms.
#include "derham/operators/operator.hpp"

namespace derham {

using Gradient = Operator<PrimalForm<3, 0>, PrimalForm<3, 1>>;
using Curl = Operator<PrimalForm<3, 1>, PrimalForm<3, 2>>;

auto result(const Curl& curl, const Gradient& gradient) {
#ifndef CONTROL
  return gradient * curl;
#else
  return curl * gradient;
#endif
}

}  // namespace derham
