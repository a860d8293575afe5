#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/predicates.hpp"
#include "derham/geometry/simplex_kernels.hpp"
#include "derham/geometry/simplex_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ranges>
#include <span>
#include <vector>

namespace derham {

/// Volumes and heights of some k-simplices, for the circumcentric dual. A height of at most 1e-10 circumradius +
/// rounding is exactly 0.
template <int k>
struct MetricBlock {
  static constexpr Index capacity = 256;
  struct alignas(16) Row : std::array<double, static_cast<std::size_t>(capacity)> {};

  Row volume{};                     ///< units length^k
  std::array<Row, k + 1> height{};  ///< [v]: signed distance of the circumcentre from the facet opposite to corner v
  Row rounding{};                   ///< what rounding of the coordinates may change a height by
  std::vector<Index> degenerate;    ///< top simplices among them; their heights are NaN
  std::vector<double> scratch;
};

/// Measures the simplices of every degree of a complex, block by block.
///
/// Two simplices at a time go through the closed formulas of simplex_kernels.hpp. Orthogonalised by SimplexMetric are only
/// the top simplices whose altitudes may be less than 1e-3 of the longest edge or than twice the rounding of coordinates,
/// simplices 2^120 times smaller than the mesh, and all in dimensions without formulas. So formulas never decide what is
/// degenerate, and the sign of a volume that they give is that of exact arithmetic.
template <int n>
class BlockMetric {
 public:
  BlockMetric(const SimplicialComplex<n>& K, const Geometry<n>& geometry)
      : complex_(K), geometry_(geometry), coordinates_(geometry.coordinates().data()), unit_(geometry.unit()) {
    geometry.require_fits(K);
    if (unit_ == 1) return;
    const auto original = geometry.coordinates();
    scaled_.resize(original.size());
    std::ranges::transform(original, scaled_.begin(), [&](double x) { return x / unit_; });
    coordinates_ = scaled_.data();
  }
  BlockMetric(const BlockMetric&) = delete;
  BlockMetric& operator=(const BlockMetric&) = delete;
  ~BlockMetric() = default;

  /// The power of two that heights and rounding of a MetricBlock count in.
  [[nodiscard]] double unit() const noexcept { return unit_; }

  /// Fills `block` for a list of k-simplices, at most its capacity.
  template <int k>
  void measure(std::span<const Index> simplices, MetricBlock<k>& block) const {
    block.degenerate.clear();
    for_each<k>(
        simplices,
        [&](std::size_t i, const kernels::Measured<k>& measured, Pack rounding) {
          volume<k>(measured).store(&block.volume[i]);
          rounding.store(&block.rounding[i]);
          const Pack smallest = zero_height * measured.radius + rounding;
          for (std::size_t v = 0; v <= k; ++v) {
            const Pack h = measured.height[v];
            select(abs(h) <= smallest, 0, h).store(&block.height[v][i]);
          }
        },
        [&](std::size_t i, Index simplex) { measure_carefully<k>(simplex, i, block); });
  }

  /// Volumes of the k-simplices [begin, end), where k = n = m with the sign of orientation_sign; adds the degenerate top
  /// simplices among them to the list.
  template <int k>
  void measure_volumes(Index begin, Index end, double* result, std::vector<Index>& degenerate) const {
    std::vector<double> scratch;
    for_each<k>(
        std::views::iota(begin, end),
        [&](std::size_t i, const kernels::Measured<k>& measured, Pack) {
          const Pack size = volume<k>(measured), signed_size = select(measured.content < 0, -size, size);
          result[i] = signed_size[0];
          if (begin + static_cast<Index>(i) + 1 < end) result[i + 1] = signed_size[1];
        },
        [&](std::size_t i, Index simplex) {
          const auto corners = geometry_.template corners<k>(complex_, simplex);
          const auto metric = orthogonalised<k>(corners, scratch);
          result[i] = metric.volume[full_mask<k>];
          if constexpr (k == n) {
            if (geometry_.has_signed_volume()) result[i] *= orientation_sign<n>(corners);
            if (metric.degenerate) degenerate.push_back(simplex);
          }
        });
  }

 private:
  static constexpr double zero_height = 1e-10;  // relative to the circumradius

  template <int k>
  [[nodiscard]] Pack volume(const kernels::Measured<k>& measured) const noexcept {
    Pack result = abs(measured.content) / static_cast<double>(factorial(k));
    for (int i = 0; i < k; ++i) result = result * unit_;
    return result;
  }

  /// Calls fast(i, measured, rounding) for simplices[i] and simplices[i + 1], i even, and then careful(i, simplices[i]) for
  /// those that formulas are not good enough for.
  template <int k, class Simplices, class Fast, class Careful>
  void for_each(const Simplices& simplices, Fast&& fast, Careful&& careful) const {
    switch (geometry_.coordinate_dimension()) {
      case 1:
        return for_each_pair<k, 1>(simplices, fast, careful);
      case 2:
        return for_each_pair<k, 2>(simplices, fast, careful);
      case 3:
        return for_each_pair<k, 3>(simplices, fast, careful);
      default:
        return for_each_pair<k, 0>(simplices, fast, careful);
    }
  }

  template <int k, int d, class Simplices, class Fast, class Careful>
  void for_each_pair(const Simplices& simplices, Fast& fast, Careful& careful) const {
    constexpr std::size_t lead = 16;  // corners are asked for so many simplices before they are needed
    const auto count = static_cast<std::size_t>(simplices.size());
    const auto simplex = [&](std::size_t i) { return simplices[static_cast<std::ptrdiff_t>(i)]; };
    if constexpr (kernels::available<k, d>) {
      for (std::size_t i = 0; i < count; i += 2) {
        if (i + lead + 1 < count)
          for (const std::size_t later : {i + lead, i + lead + 1})
            for (const std::size_t place : geometry_.template corner_places<k, d>(complex_, simplex(later)))
              __builtin_prefetch(coordinates_ + place);
        const Index first = simplex(i), second = simplex(std::min(i + 1, count - 1));
        const auto a = geometry_.template corner_places<k, d>(complex_, first),
                   b = geometry_.template corner_places<k, d>(complex_, second);
        kernels::Corners<k, d> corners;
        for (std::size_t v = 0; v <= k; ++v)
          for (std::size_t c = 0; c < d; ++c) corners[v][c] = Pack(coordinates_[a[v] + c], coordinates_[b[v] + c]);
        const Pack rounding = geometry_.relative_roundoff() * kernels::largest_coordinate(corners);
        const auto measured = kernels::measure<d>(corners);
        fast(i, measured, rounding);
        const PackMask trusted = is_trusted(measured, rounding);
        if (trusted.all()) continue;
        if (!trusted[0]) careful(i, first);
        if (!trusted[1] && i + 1 < count) careful(i + 1, second);
      }
    } else {
      for (std::size_t i = 0; i < count; ++i) careful(i, simplex(i));
    }
  }

  /// Powers of lengths stay in the range of doubles, and, in the top degree, no altitude comes near a tolerance: the
  /// smallest is at least content / longest^(k-1).
  template <int k>
  [[nodiscard]] static PackMask is_trusted(const kernels::Measured<k>& measured, Pack rounding) noexcept {
    const Pack longest = measured.longest;
    auto trusted = (longest > 0x1p-240) & (longest < 0x1p240);
    if constexpr (k == n) {
      Pack least = max(1e-6 * longest, 4 * rounding * rounding);
      for (int i = 1; i < k; ++i) least = least * longest;
      trusted = trusted & (measured.content * measured.content > least);
    }
    return trusted;
  }

  template <int k>
  [[nodiscard]] SimplexMetric<k, false> orthogonalised(const std::array<const double*, k + 1>& corners,
                                                       std::vector<double>& scratch) const {
    const int d = geometry_.coordinate_dimension();
    scratch.resize(static_cast<std::size_t>(k * d));
    // A face is as good as its top simplex.
    const double flatness = k == n ? geometry_.relative_flatness() : 0,
                 roundoff = k == n ? geometry_.roundoff(corners) : 0;
    return SimplexMetric<k, false>(corners, d, flatness, roundoff, scratch.data());
  }

  template <int k>
  void measure_carefully(Index simplex, std::size_t i, MetricBlock<k>& block) const {
    const auto corners = geometry_.template corners<k>(complex_, simplex);
    const auto metric = orthogonalised<k>(corners, block.scratch);
    const double scale = metric.unit / unit_, rounding = geometry_.roundoff(corners) / unit_;
    const double smallest = zero_height * metric.radius[full_mask<k>] * scale + rounding;
    block.volume[i] = metric.volume[full_mask<k>];
    block.rounding[i] = rounding;
    for (std::size_t v = 0; v <= k; ++v) {
      const double h = metric.height[full_mask<k>][v] * scale;
      block.height[v][i] = metric.degenerate         ? std::numeric_limits<double>::quiet_NaN()
                           : std::abs(h) <= smallest ? 0
                                                     : h;
    }
    if (k == n && metric.degenerate) block.degenerate.push_back(simplex);
  }

  const SimplicialComplex<n>& complex_;
  const Geometry<n>& geometry_;
  const double* coordinates_;  // in units
  double unit_;
  std::vector<double> scaled_;  // only where the unit is not 1
};

}  // namespace derham
