#include "derham/complex/simplicial_complex.hpp"

auto faces(const derham::SimplicialComplex<2>& K) {
#ifndef CONTROL
  return K.faces<0>(0);
#else
  return K.faces<1>(0);
#endif
}
