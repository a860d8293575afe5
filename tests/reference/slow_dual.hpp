#pragma once

#include "derham/dual/circumcentric.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

/// The circumcentric dual top simplex by top simplex: each adds its own share of every dual volume, by the recursion over
/// its own faces, and all its faces are orthogonalised anew. What derham::circumcentric_dual computes in another order.
namespace derham::reference {

template <int n>
struct SlowDual {
  CircumcentricDual<n> result;
  ByDegree<n> scale;  ///< the dual volumes with circumradii for heights: what errors compare with

  SlowDual(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
    for (int k = 0; k <= n; ++k) {
      result.primal[k].assign(static_cast<std::size_t>(K.size(k)), 0.0);
      result.dual[k] = scale[k] = uncertainty_[k] = result.primal[k];
    }
    const int d = geometry.coordinate_dimension();
    std::vector<double> scratch(static_cast<std::size_t>(n * d));
    for (Index t = 0; t < K.size(n); ++t) {
      const auto corners = geometry.corners(K, t);
      const double roundoff = geometry.roundoff(corners);
      add(face_indices(K, t), SimplexMetric<n>(corners, d, geometry.relative_flatness(), roundoff, scratch.data()),
          roundoff);
    }
    for (int k = 0; k < n; ++k)
      for (std::size_t i = 0; i < result.dual[k].size(); ++i)
        if (std::abs(result.dual[k][i]) <= uncertainty_[k][i]) result.dual[k][i] = 0;
    for (const Index t : result.degenerate) {
      const auto index = face_indices(K, t);
      for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
        result.dual[mask_degree(mask)][index[mask]] = std::numeric_limits<double>::quiet_NaN();
    }
    result.well_centered = result.well_centered && result.degenerate.empty();
  }

 private:
  void add(const FaceArray<n, Index>& index, const SimplexMetric<n>& metric, double rounding) {
    for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
      result.primal[mask_degree(mask)][index[mask]] = metric.volume[mask];
    if (metric.degenerate) {
      result.degenerate.push_back(index[full_mask<n>]);
      return;
    }
    FaceArray<n, double> share{}, error{}, size{};
    share[full_mask<n>] = size[full_mask<n>] = 1;
    for (unsigned mask = full_mask<n>; mask > 0; --mask) {
      const int k = mask_degree(mask);
      for (int v = 0; v <= n; ++v) {
        const unsigned coface = mask | (1U << v);
        if (coface == mask) continue;
        const double radius = metric.radius[coface] * metric.unit;
        double h = metric.height[coface][v] * metric.unit;
        if (std::abs(h) <= 1e-10 * radius + rounding) h = 0;
        share[mask] += h * share[coface] / (n - k);
        error[mask] += ((1e-10 * std::abs(h) + rounding) * (std::abs(share[coface]) + error[coface]) +
                        std::abs(h) * error[coface]) /
                       (n - k);
        size[mask] += radius * size[coface] / (n - k);
        result.well_centered = result.well_centered && h > 0;
      }
      result.dual[k][index[mask]] += share[mask];
      uncertainty_[k][index[mask]] += error[mask];
      scale[k][index[mask]] += size[mask];
    }
  }

  ByDegree<n> uncertainty_;
};

}  // namespace derham::reference
