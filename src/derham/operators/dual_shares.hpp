#pragma once

#include "derham/complex/local_faces.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

// Internal to this room.
namespace derham::detail {

/// What one top simplex T adds to the signed dual volumes of its faces: |⋆σ ∩ T|, by mask.
/// Units    length^(n - degree)
template <int n>
class DualShares {
 public:
  explicit DualShares(const Geometry<n>& geometry)
      : geometry_(&geometry), scratch_(static_cast<std::size_t>(n * geometry.coordinate_dimension())) {}

  /// Top simplex t; where it is flat the shares are NaN.
  void set(const SimplicialComplex<n>& K, Index t) {
    const SimplexMetric<n> metric(geometry_->corners(K, t), geometry_->coordinate_dimension(), 0, 0, scratch_.data());
    volume_ = metric.volume[full_mask<n>];
    share_.fill(std::numeric_limits<double>::quiet_NaN());
    height_.fill(std::numeric_limits<double>::quiet_NaN());
    if (metric.degenerate) return;
    for (std::size_t v = 0; v <= n; ++v) height_[v] = metric.height[full_mask<n>][v] * metric.unit;
    share_[full_mask<n>] = 1;
    for_each_mask<n>([&]<unsigned mask>() {
      constexpr int k = mask_degree(mask);
      if constexpr (k < n) {
        share_[mask] = 0;
        unrolled<n + 1>([&]<int v>() {
          constexpr unsigned coface = mask | (1U << v);
          if constexpr (coface != mask)
            share_[mask] += metric.height[coface][v] * metric.unit * share_[coface] / (n - k);
        });
      }
    });
  }

  [[nodiscard]] double volume() const noexcept { return volume_; }
  [[nodiscard]] double operator[](unsigned mask) const noexcept { return share_[mask]; }

  /// Signed distance of the circumcentre of T from the circumcentre of its facet opposite to vertex v.
  [[nodiscard]] double height(std::size_t v) const noexcept { return height_[v]; }

 private:
  const Geometry<n>* geometry_;
  std::vector<double> scratch_;
  double volume_ = 0;
  FaceArray<n, double> share_{};
  std::array<double, n + 1> height_{};
};

}  // namespace derham::detail
