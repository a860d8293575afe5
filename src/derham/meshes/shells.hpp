#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace derham::meshes::detail {

/// The number of edges of Kuhn's triangulation of Z^n between z and the origin: the norm whose unit ball is the union
/// of the simplices about the origin (a hexagon for n = 2, a rhombic dodecahedron for n = 3). It is linear on every
/// simplex.
inline Index steps_from_origin(std::span<const Index> z) noexcept {
  return std::max(*std::ranges::max_element(z), Index{0}) - std::min(*std::ranges::min_element(z), Index{0});
}

/// Appends the point z of A_n* (Z^n compressed along its main diagonal by 1/√(n+1)), moved along its ray to the
/// distance step * steps_from_origin(z).
inline void append_shell_point(std::span<const Index> z, double step, std::vector<double>& points) {
  const auto n = static_cast<double>(z.size());
  const double sum = static_cast<double>(std::accumulate(z.begin(), z.end(), Index{0}));
  const double share = (1 - 1 / std::sqrt(n + 1)) / n * sum;
  double square = 0;
  for (const Index zi : z) square += (static_cast<double>(zi) - share) * (static_cast<double>(zi) - share);
  const double factor = square > 0 ? step * static_cast<double>(steps_from_origin(z)) / std::sqrt(square) : 0;
  for (const Index zi : z) points.push_back(factor * (static_cast<double>(zi) - share));
}

}  // namespace derham::meshes::detail
