// What a stranger's first program looks like; built three ways against derham, never inside its own build.
#include <derham/complex/simplicial_complex.hpp>

#include <iostream>

int main() {
  const derham::SimplicialComplex<3> K({{0, 1, 2, 3}, {1, 2, 3, 4}});
  for (int k = 0; k <= 3; ++k) std::cout << K.size(k) << ' ';
  std::cout << "chi " << K.euler_characteristic() << '\n';
}
