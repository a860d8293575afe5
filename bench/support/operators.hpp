#pragma once

#include "bench/support/kernel.hpp"
#include "derham/complex/simplicial_complex.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace derham::bench {

/// An operator applied to one vector or several: `apply(x, y)`. The vectors are made beforehand, and `tables` is how many
/// bytes of tables one application reads.
template <class Apply>
Kernel application(const BenchMesh& mesh, Offset from, Offset to, Offset tables, Apply&& apply, Index columns = 1) {
  const auto length = [&](Offset simplices) { return static_cast<std::size_t>(simplices * columns); };
  const auto x = std::make_shared<std::vector<double>>(length(from), 1.0);
  const auto y = std::make_shared<std::vector<double>>(length(to));
  return {.run = [x, y, apply = std::forward<Apply>(apply)] { apply(*x, *y); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = static_cast<double>(tables) + 8.0 * static_cast<double>((from + to) * columns),
          .reset = {}};
}

/// What a wedge product of p- and q-forms reads beside values: the tuples, which hold the vertices, or the face tables
/// down to the lower degree.
inline Offset bytes_of_wedge(const SimplicialComplex<3>& K, int p, int q) {
  if (p * q == 0) return static_cast<Offset>(K.simplices(p + q).size_bytes());
  Offset bytes = 0;
  for (int k = p + q; k > std::min(p, q); --k) bytes += static_cast<Offset>(K.face_table(k).size_bytes());
  return bytes;
}

}  // namespace derham::bench
