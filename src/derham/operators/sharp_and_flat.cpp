#include "derham/operators/sharp_and_flat.hpp"

#include "derham/core/parallel.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/geometry/circumcenter.hpp"
#include "derham/operators/dual_shares.hpp"
#include "derham/operators/not_flat.hpp"
#include "derham/operators/whitney_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace derham {
namespace {

constexpr Offset grain = 512;

template <int n>
void require(const SimplicialComplex<n>& K, const Geometry<n>& geometry, std::span<const double> vectors, int k) {
  geometry.require_fits(K);
  const auto expected = static_cast<std::size_t>(K.size(k)) * static_cast<std::size_t>(geometry.coordinate_dimension());
  if (vectors.size() != expected)
    throw InputError(text("a vector field of ", vectors.size(), " components; expected ",
                          geometry.coordinate_dimension(), " on each of the ", K.size(k),
                          k == 0 ? " vertices" : " top simplices"));
}

template <int n>
void require_comparable(const Geometry<n>& geometry) {
  if (geometry.has_common_frame()) return;
  throw GeometryError(text("vectors at vertices are means over top simplices, but ",
                           geometry.source() == MetricSource::lengths
                               ? "the geometry has edge lengths only, and so every top simplex a frame of its own"
                               : "the charts of the top simplices are turned against each other",
                           "; use vectors per top simplex"));
}

/// Body(t, shares, frame) for every top simplex, on all threads.
template <int n, class Body>
void for_each_top(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Body&& body) {
  parallel_blocks(K.size(n), grain, [&](Offset begin, Offset end) {
    detail::DualShares<n> shares(geometry);
    SimplexFrame<n> frame(geometry.coordinate_dimension());
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      shares.set(K, t);
      frame.set(geometry.corners(K, t));
      body(t, shares, frame);
    }
  });
}

double dot(const double* a, const double* b, std::size_t d) noexcept {
  double sum = 0;
  for (std::size_t c = 0; c < d; ++c) sum += a[c] * b[c];
  return sum;
}

/// X · (b - a).
double along(const double* X, const double* a, const double* b, std::size_t d) noexcept {
  double sum = 0;
  for (std::size_t c = 0; c < d; ++c) sum += X[c] * (b[c] - a[c]);
  return sum;
}

/// A mean with the signed shares of dual cells as weights, or with volumes where there is no dual volume. Per k-face of
/// every top simplex are kept its share, and `width` numbers to take the mean of.
template <int n, int k>
class SharedMean {
 public:
  static constexpr auto masks = detail::masks_of<n, k + 1>();

  SharedMean(const SimplicialComplex<n>& K, const Geometry<n>& geometry, std::size_t width)
      : complex_(&K), width_(width), volume_(static_cast<std::size_t>(K.size(n))),
        share_(volume_.size() * masks.size()), value_(share_.size() * width), dual_(dual_volumes(K, geometry)[k]) {
    if (!K.is_pure()) throw TopologyError("a mean over top simplices, but some simplices of the complex are in none");
  }

  /// Where the values of face number a of top simplex t go; call it once for each.
  double* at(Index t, std::size_t a, const detail::DualShares<n>& shares) {
    const auto top = static_cast<std::size_t>(t), place = top * masks.size() + a;
    volume_[top] = shares.volume();
    share_[place] = shares[masks[a]];
    return value_.data() + place * width_;
  }

  /// The means, shape (|K_k|, width).
  [[nodiscard]] std::vector<double> means() const {
    const auto& K = *complex_;
    std::vector<double> weight(static_cast<std::size_t>(K.size(k))), sum(weight.size() * width_);
    for (Index t = 0; t < K.size(n); ++t) {
      const auto index = face_indices(K, t);
      for (std::size_t a = 0; a < masks.size(); ++a) {
        const auto face = static_cast<std::size_t>(index[masks[a]]), top = static_cast<std::size_t>(t),
                   place = top * masks.size() + a;
        const double w = dual_[face] == 0 ? volume_[top] : share_[place];
        weight[face] += w;
        for (std::size_t c = 0; c < width_; ++c) sum[face * width_ + c] += w * value_[place * width_ + c];
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= weight[i / width_];
    return sum;
  }

 private:
  const SimplicialComplex<n>* complex_;
  std::size_t width_;
  std::vector<double> volume_, share_, value_, dual_;
};

}  // namespace

template <int n>
  requires(n >= 1)
std::vector<double> whitney_sharp(const Geometry<n>& geometry, const PrimalForm<n, 1>& w) {
  return WhitneyMap<n>(w.complex(), geometry).at_barycenters(w);
}

template <int n>
  requires(n >= 1)
std::vector<double> pd_sharp(const Geometry<n>& geometry, const PrimalForm<n, 1>& w) {
  const auto& K = w.complex();
  const WhitneyMap<n> W(K, geometry);
  std::vector<BarycentricPoint<n>> points(static_cast<std::size_t>(K.size(n)));
  parallel_blocks(K.size(n), grain, [&](Offset begin, Offset end) {
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      auto& point = points[static_cast<std::size_t>(t)];
      point.simplex = t;
      std::ranges::copy(circumcenter(K, geometry, n, t).barycentric, point.barycentric.begin());
    }
  });
  return W.at(w, points);
}

template <int n>
  requires(n >= 1)
std::vector<double> pp_sharp(const Geometry<n>& geometry, const PrimalForm<n, 1>& w) {
  const auto& K = w.complex();
  require_comparable(geometry);
  geometry.require_fits(K);
  detail::require_not_flat(K, geometry);
  const auto d = static_cast<std::size_t>(geometry.coordinate_dimension());
  SharedMean<n, 0> mean(K, geometry, d);
  for_each_top(K, geometry, [&](Index t, const auto& shares, const auto& frame) {
    const auto index = face_indices(K, t);
    for (std::size_t v = 0; v <= n; ++v) {
      double* const X = mean.at(t, v, shares);
      for (std::size_t u = 0; u <= n; ++u) {
        if (u == v) continue;
        const Index e = index[(1U << u) | (1U << v)];
        const double value = (v < u ? 1 : -1) * K.sign(1, e) * w[e];
        for (std::size_t c = 0; c < d; ++c) X[c] += value * frame.gradient(u, c);
      }
    }
  });
  return mean.means();
}

template <int n>
  requires(n >= 1)
PrimalForm<n, 1> dpp_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry, std::span<const double> vectors) {
  require(K, geometry, vectors, n);
  detail::require_not_flat(K, geometry);
  const auto d = static_cast<std::size_t>(geometry.coordinate_dimension());
  SharedMean<n, 1> mean(K, geometry, 1);
  for_each_top(K, geometry, [&](Index t, const auto& shares, const auto&) {
    const auto corners = geometry.corners(K, t);
    const double* const X = vectors.data() + static_cast<std::size_t>(t) * d;
    for (std::size_t a = 0; a < mean.masks.size(); ++a) {
      const auto first = static_cast<std::size_t>(std::countr_zero(mean.masks[a])),
                 last = static_cast<std::size_t>(std::bit_width(mean.masks[a])) - 1;
      *mean.at(t, a, shares) = along(X, corners[first], corners[last], d);
    }
  });
  PrimalForm<n, 1> result(K, mean.means());
  for (Index e = 0; e < result.size(); ++e) result[e] *= K.sign(1, e);
  return result;
}

// The dual edge of facet f runs so that it ends at T with the sign of T in d of dual functions, (-1)^n [T:f].
template <int n>
  requires(n >= 1)
DualForm<n, 1> dpd_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry, std::span<const double> vectors) {
  require(K, geometry, vectors, n);
  detail::require_dual_cells(K);
  detail::require_not_flat(K, geometry);
  const auto d = static_cast<std::size_t>(geometry.coordinate_dimension());
  std::vector<double> piece(static_cast<std::size_t>(K.size(n)) * (n + 1));
  for_each_top(K, geometry, [&](Index t, const auto& shares, const auto& frame) {
    const double* const X = vectors.data() + static_cast<std::size_t>(t) * d;
    for (std::size_t v = 0; v <= n; ++v) {
      double length = 0;  // X·∇λ_v, which points from the facet to the circumcentre
      for (std::size_t c = 0; c < d; ++c) length += X[c] * frame.gradient(v, c);
      const auto& gradient = frame.gradients()[v];
      length *= shares.height(v) / std::sqrt(dot(gradient.data(), gradient.data(), n));
      const int sign = ((n + static_cast<int>(v)) % 2 == 0 ? 1 : -1) * K.sign(n, t);
      piece[static_cast<std::size_t>(t) * (n + 1) + v] = sign * length;
    }
  });
  DualForm<n, 1> result(K);
  for (Index t = 0; t < K.size(n); ++t)
    for (int v = 0; v <= n; ++v)
      result[K.face_opposite(n, t, v)] += piece[static_cast<std::size_t>(t) * (n + 1) + static_cast<std::size_t>(v)];
  return result;
}

template <int n>
  requires(n >= 1)
PrimalForm<n, 1> ppp_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry, std::span<const double> vectors) {
  require_comparable(geometry);
  require(K, geometry, vectors, 0);
  const auto d = static_cast<std::size_t>(geometry.coordinate_dimension());
  PrimalForm<n, 1> result(K);
  parallel_blocks(result.size(), grain, [&](Offset begin, Offset end) {
    for (auto e = static_cast<Index>(begin); e < end; ++e) {
      const auto ends = K.template simplex<1>(e);
      const auto corners = geometry.template corners<1>(K, e);
      double sum = 0;
      for (const Index v : ends) {
        const double* const X = vectors.data() + static_cast<std::size_t>(v) * d;
        sum += along(X, corners[0], corners[1], d);
      }
      result[e] = K.sign(1, e) * sum / 2;
    }
  });
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                                   \
  template std::vector<double> whitney_sharp(const Geometry<n>&, const PrimalForm<n, 1>&);                      \
  template std::vector<double> pd_sharp(const Geometry<n>&, const PrimalForm<n, 1>&);                           \
  template std::vector<double> pp_sharp(const Geometry<n>&, const PrimalForm<n, 1>&);                           \
  template PrimalForm<n, 1> dpp_flat(const SimplicialComplex<n>&, const Geometry<n>&, std::span<const double>); \
  template DualForm<n, 1> dpd_flat(const SimplicialComplex<n>&, const Geometry<n>&, std::span<const double>);   \
  template PrimalForm<n, 1> ppp_flat(const SimplicialComplex<n>&, const Geometry<n>&, std::span<const double>);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
