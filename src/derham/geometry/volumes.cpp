#include "derham/geometry/volumes.hpp"

#include "derham/core/error.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/block_metric.hpp"
#include "derham/geometry/top_volumes.hpp"

#include <cmath>
#include <numeric>

namespace derham {

namespace {

constexpr Offset grain = 1 << 14;

// The volumes of degree k as BlockMetric gives them, and the degenerate simplices of every `grain` of them.
template <int k, int n>
std::vector<std::vector<Index>> measure(const SimplicialComplex<n>& K, const BlockMetric<n>& metric,
                                        std::vector<double>& volume) {
  const Offset size = K.size(k);
  reserve_large(volume, static_cast<std::size_t>(size));
  volume.assign(static_cast<std::size_t>(size), 1.0);
  std::vector<std::vector<Index>> degenerate(static_cast<std::size_t>((size + grain - 1) / grain));
  if constexpr (k > 0)
    parallel_blocks(size, grain, [&](Offset begin, Offset end) {
      metric.template measure_volumes<k>(static_cast<Index>(begin), static_cast<Index>(end), volume.data() + begin,
                                         degenerate[static_cast<std::size_t>(begin / grain)]);
    });
  return degenerate;
}

}  // namespace

template <int n>
TopVolumes top_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  TopVolumes result;
  for (const auto& part : measure<n>(K, BlockMetric<n>(K, geometry), result.volume))
    result.degenerate.insert(result.degenerate.end(), part.begin(), part.end());
  return result;
}

template <int n>
ByDegree<n> primal_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  const BlockMetric<n> metric(K, geometry);
  ByDegree<n> result;
  unrolled<n + 1>([&]<int k>() { (void)measure<k>(K, metric, result[k]); });
  for (double& volume : result[n]) volume = std::abs(volume);
  return result;
}

template <int n>
  requires(n >= 1)
std::vector<double> squared_lengths(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  geometry.require_fits(K);
  std::vector<double> squares(static_cast<std::size_t>(K.size(1)));
  parallel_blocks(K.size(1), grain, [&](Offset begin, Offset end) {
    for (Offset e = begin; e < end; ++e) {
      const auto [a, b] = geometry.template corners<1>(K, static_cast<Index>(e));
      double sum = 0;
      for (int axis = 0; axis < geometry.coordinate_dimension(); ++axis)
        sum += (b[axis] - a[axis]) * (b[axis] - a[axis]);
      squares[static_cast<std::size_t>(e)] = sum;
    }
  });
  return squares;
}

template <int n>
double total_volume(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  double sum = 0;
  for (const double volume : top_volumes(K, geometry).volume) sum += std::abs(volume);
  return sum;
}

template <int n>
std::vector<double> signed_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  if (!geometry.has_signed_volume())
    throw GeometryError(text("simplices of dimension ", n, " have no signed volume in dimension ",
                             geometry.ambient_dimension(), "; that needs positions in dimension ", n));
  return std::move(top_volumes(K, geometry).volume);
}

template <int n>
void orient_by_volume(SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  if (geometry.has_signed_volume()) K.orient_by(signed_volumes(K, geometry));
}

#define DERHAM_INSTANTIATE(n)                                                                      \
  template TopVolumes top_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);             \
  template ByDegree<n> primal_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);         \
  template double total_volume<n>(const SimplicialComplex<n>&, const Geometry<n>&);                \
  template std::vector<double> signed_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&); \
  template void orient_by_volume<n>(SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE
template std::vector<double> squared_lengths<1>(const SimplicialComplex<1>&, const Geometry<1>&);
template std::vector<double> squared_lengths<2>(const SimplicialComplex<2>&, const Geometry<2>&);
template std::vector<double> squared_lengths<3>(const SimplicialComplex<3>&, const Geometry<3>&);
template std::vector<double> squared_lengths<4>(const SimplicialComplex<4>&, const Geometry<4>&);

}  // namespace derham
