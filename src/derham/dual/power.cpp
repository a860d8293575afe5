// This follows Mullen, Memari, de Goes, Desbrun, "HOT: Hodge-optimized triangulations", 2011, and the recursion of
// circumcentric.hpp with its bounds on errors.
#include "derham/dual/power.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/dual/power_simplex.hpp"
#include "derham/geometry/top_volumes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace derham {
namespace {

constexpr double relative_error = 1e-10;  // of a height that is not zero

/// Dual volumes from the top simplices down, in the unit of the geometry.
template <int n>
class PowerRecursion {
 public:
  PowerRecursion(const SimplicialComplex<n>& K, const Geometry<n>& geometry, std::span<const double> weights,
                 CircumcentricDual<n>& result)
      : complex_(K), geometry_(geometry), weights_(weights), result_(result), unit_(geometry.unit()) {}

  void run(std::vector<double> values) {
    value_ = std::move(values);
    error_.assign(value_.size(), 0);
    keep<n>();
    unrolled<n>([&]<int i>() {
      add_shares<n - i>();
      keep<n - i - 1>();
    });
  }

 private:
  template <int k>
  struct Heights {
    std::array<double, k + 1> height{};
    double rounding = 0;
  };

  /// Signed distances of the power centre from the facets.
  template <int k>
  [[nodiscard]] Heights<k> measure(Index i, double* edges) const {
    const auto corners = geometry_.template corners<k>(complex_, i);
    const detail::PowerSimplex<k> simplex(detail::frame_of<k>(corners, geometry_.coordinate_dimension(), unit_, edges));
    typename detail::PowerSimplex<k>::Row weight{};
    const auto vertices = complex_.template simplex<k>(i);
    if (!weights_.empty())
      for (std::size_t v = 0; v <= k; ++v) weight[v] = weights_[static_cast<std::size_t>(vertices[v])] / unit_ / unit_;
    Heights<k> result;
    result.rounding = geometry_.roundoff(corners) / unit_;
    for (std::size_t v = 0; v <= k; ++v) {
      const double shift = simplex.shift(v, weight), height = simplex.zero.height(static_cast<int>(v)) - shift;
      const double smallest = relative_error * (simplex.zero.radius + std::abs(shift)) + result.rounding;
      result.height[v] = std::abs(height) <= smallest && std::isfinite(smallest) ? 0 : height;
    }
    return result;
  }

  template <int k>
  [[nodiscard]] std::vector<Heights<k>> measure() const {
    constexpr Offset grain = 1024;
    std::vector<Heights<k>> result(static_cast<std::size_t>(complex_.size(k)));
    parallel_blocks(complex_.size(k), grain, [&](Offset first, Offset last) {
      std::vector<double> edges(static_cast<std::size_t>(k * geometry_.coordinate_dimension()));
      for (Offset i = first; i < last; ++i)
        result[static_cast<std::size_t>(i)] = measure<k>(static_cast<Index>(i), edges.data());
    });
    return result;
  }

  /// From the dual volumes of degree k to those of degree k-1.
  template <int k>
  void add_shares() {
    const auto heights = measure<k>();
    std::vector<double> value(static_cast<std::size_t>(complex_.size(k - 1))), error(value.size());
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const auto faces = complex_.template faces<k>(static_cast<Index>(i));
      const double part = value_[i] / (n - k + 1), part_error = error_[i] / (n - k + 1);
      const double most = std::abs(part) + part_error;
      for (std::size_t v = 0; v <= k; ++v) {
        const double h = heights[i].height[v];
        const auto face = static_cast<std::size_t>(faces[k - v]);
        value[face] += h * part;
        error[face] += std::abs(h) * (relative_error * most + part_error) + heights[i].rounding * most;
        result_.well_centered = result_.well_centered && h > 0;
      }
    }
    for (std::size_t i = 0; i < value.size(); ++i)
      if (std::abs(value[i]) <= error[i])
        value[i] = std::isfinite(error[i]) ? 0 : std::numeric_limits<double>::quiet_NaN();
    value_ = std::move(value);
    error_ = std::move(error);
  }

  /// Writes the dual volumes of degree k, NaN where they are out of the range of doubles.
  template <int k>
  void keep() const {
    auto& dual = result_.dual[k];
    dual.resize(value_.size());
    std::ranges::transform(value_, dual.begin(), [&](double x) {
      const double volume = in_units(x, unit_, n - k);
      return x == 0 || std::isnormal(volume) ? volume : std::numeric_limits<double>::quiet_NaN();
    });
  }

  const SimplicialComplex<n>& complex_;
  const Geometry<n>& geometry_;
  std::span<const double> weights_;
  CircumcentricDual<n>& result_;
  double unit_;
  std::vector<double> value_, error_;  // of the degree that was treated last
};

}  // namespace

template <int n>
void require_weights(std::span<const double> weights, const SimplicialComplex<n>& K) {
  if (!weights.empty() && weights.size() != static_cast<std::size_t>(K.size(0)))
    throw InputError(text(weights.size(), " weights for ", K.size(0), " vertices"));
  for (std::size_t v = 0; v < weights.size(); ++v)
    if (!std::isfinite(weights[v]))
      throw InputError(text("the weight of vertex ", v, " is ", weights[v], "; weights must be finite"));
}

template <int n>
void require_numbers(const Material& material, const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  require_fits(material, K, geometry);
  if (material.width != 0)
    throw InputError("a diagonal Hodge star with a material of tensors; it takes numbers: use whitney_mass");
}

template <int n>
CircumcentricDual<n> power_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                std::span<const double> weights, const Material& material) {
  geometry.require_fits(K);
  require_weights(weights, K);
  require_numbers(material, K, geometry);
  CircumcentricDual<n> result;
  result.primal = primal_volumes(K, geometry);
  result.degenerate = top_volumes(K, geometry).degenerate;
  result.well_centered = result.degenerate.empty();
  std::vector<double> values(static_cast<std::size_t>(K.size(n)));
  for (Index t = 0; t < K.size(n); ++t) values[static_cast<std::size_t>(t)] = *material.of(t);
  for (const Index t : result.degenerate)
    values[static_cast<std::size_t>(t)] = std::numeric_limits<double>::quiet_NaN();
  PowerRecursion<n>(K, geometry, weights, result).run(std::move(values));
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                                        \
  template CircumcentricDual<n> power_dual(const SimplicialComplex<n>&, const Geometry<n>&, std::span<const double>, \
                                           const Material&);                                                         \
  template void require_weights(std::span<const double>, const SimplicialComplex<n>&);                               \
  template void require_numbers(const Material&, const SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
