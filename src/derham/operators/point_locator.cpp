#include "derham/operators/point_locator.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/predicates.hpp"
#include "derham/operators/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace derham {
namespace {

constexpr double relative_tolerance = 1e-12;  // of the altitude

/// Boxes of the top simplices, larger on every side by what `locate` tolerates.
template <int n>
std::vector<double> boxes_of(const SimplicialComplex<n>& K, const Geometry<n>& geometry, double roundoff) {
  const auto m = static_cast<std::size_t>(geometry.ambient_dimension());
  std::vector<double> boxes(static_cast<std::size_t>(K.size(n)) * 2 * m);
  parallel_blocks(K.size(n), 4096, [&](Offset begin, Offset end) {
    for (Offset t = begin; t < end; ++t) {
      const auto corners = geometry.corners(K, static_cast<Index>(t));
      double* const low = boxes.data() + static_cast<std::size_t>(t) * 2 * m;
      double* const high = low + m;
      double longest = 0;
      for (std::size_t c = 0; c < m; ++c) {
        low[c] = high[c] = corners[0][c];
        for (const double* corner : corners) {
          low[c] = std::min(low[c], corner[c]);
          high[c] = std::max(high[c], corner[c]);
        }
        longest = std::max(longest, high[c] - low[c]);
      }
      const double margin = 2 * roundoff + 2 * n * relative_tolerance * longest;
      for (std::size_t c = 0; c < m; ++c) {
        low[c] -= margin;
        high[c] += margin;
      }
    }
  });
  return boxes;
}

template <int n>
std::array<double, n + 1> barycentric(const SimplexFrame<n>& frame, const double* corner,
                                      std::span<const double> point) {
  std::array<double, n + 1> lambda{};
  lambda[0] = 1;
  for (std::size_t v = 1; v <= n; ++v) {
    for (std::size_t c = 0; c < point.size(); ++c) lambda[v] += frame.gradient(v, c) * (point[c] - corner[c]);
    lambda[0] -= lambda[v];
  }
  return lambda;
}

/// Without the negative ones, and with sum 1.
template <std::size_t count>
void clamp(std::array<double, count>& lambda) {
  double sum = 0;
  for (double& x : lambda) sum += x = std::max(x, 0.0);
  for (double& x : lambda) x /= sum;
}

/// Whether λ is that of a point beyond no facet by more than is tolerated.
template <int n>
bool is_near(const SimplexFrame<n>& frame, const std::array<double, n + 1>& lambda, double roundoff) {
  for (std::size_t v = 0; v <= n; ++v) {
    double square = 0;
    for (const double x : frame.gradients()[v]) square += x * x;
    if (!(lambda[v] >= -(relative_tolerance + roundoff * std::sqrt(square)))) return false;
  }
  return true;
}

}  // namespace

template <int n>
PointLocator<n>::PointLocator(const SimplicialComplex<n>& K, const Geometry<n>& geometry)
    : complex_(&K), geometry_(&geometry), roundoff_(coordinate_roundoff(geometry.coordinates())) {
  geometry.require_fits(K);
  if (geometry.source() == MetricSource::lengths)
    throw GeometryError("points are located in space, but the geometry has edge lengths only; give positions");
  tree_ = BoxTree(boxes_of(K, geometry, roundoff_), geometry.ambient_dimension());
}

template <int n>
void PointLocator<n>::require_point(std::size_t coordinates) const {
  if (coordinates != static_cast<std::size_t>(geometry_->ambient_dimension()))
    throw InputError(
        text("a point of ", coordinates, " coordinates in space of dimension ", geometry_->ambient_dimension()));
}

/// Whether no corner, replaced by the point, gives a simplex of the other orientation.
template <int n>
bool PointLocator<n>::holds(Index t, std::span<const double> point) const {
  auto corners = geometry_->corners(*complex_, t);
  const Sign orientation = orientation_sign<n>(corners);
  if (orientation == 0) return false;
  for (auto& corner : corners) {
    const double* const kept = std::exchange(corner, point.data());
    if (orientation_sign<n>(corners) == -orientation) return false;
    corner = kept;
  }
  return true;
}

template <int n>
BarycentricPoint<n> PointLocator<n>::locate(std::span<const double> point, SimplexFrame<n>& frame) const {
  BarycentricPoint<n> found;
  const auto is_better = [&](Index t) { return found.simplex < 0 || t < found.simplex; };
  tree_.for_each_near(point, [&](Index t) {
    if (is_better(t) && holds(t, point)) found.simplex = t;
  });
  if (found.simplex < 0)
    tree_.for_each_near(point, [&](Index t) {
      if (!is_better(t)) return;
      const auto corners = geometry_->corners(*complex_, t);
      if (orientation_sign<n>(corners) == 0) return;
      frame.set(corners);
      if (is_near<n>(frame, barycentric<n>(frame, corners[0], point), roundoff_)) found.simplex = t;
    });
  if (found.simplex < 0) return found;
  const auto corners = geometry_->corners(*complex_, found.simplex);
  frame.set(corners);
  found.barycentric = barycentric<n>(frame, corners[0], point);
  clamp(found.barycentric);
  return found;
}

template <int n>
BarycentricPoint<n> PointLocator<n>::locate(std::span<const double> point) const {
  require_point(point.size());
  return locate_all(point).front();
}

template <int n>
std::vector<BarycentricPoint<n>> PointLocator<n>::locate_all(std::span<const double> points) const {
  if (geometry_->ambient_dimension() != n)
    throw GeometryError(text("a complex of dimension ", n, " in space of dimension ", geometry_->ambient_dimension(),
                             " holds hardly any point; ask for the nearest point of it"));
  if (points.size() % n != 0) require_point(points.size());
  std::vector<BarycentricPoint<n>> result(points.size() / n);
  parallel_blocks(static_cast<Offset>(result.size()), 256, [&](Offset begin, Offset end) {
    SimplexFrame<n> frame(n);
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      result[i] = locate(points.subspan(i * n, n), frame);
  });
  return result;
}

template <int n>
NearestPoint<n> PointLocator<n>::nearest(std::span<const double> point) const {
  require_point(point.size());
  for (const double x : point)
    if (!std::isfinite(x)) throw InputError(text("a point with the coordinate ", x, "; coordinates must be finite"));
  detail::ClosestPoint<n> best;
  Index simplex = -1;
  tree_.for_each_within(
      point, [&] { return best.square; },
      [&](Index t) {
        const auto corners = geometry_->corners(*complex_, t);
        const auto here = detail::ClosestPointSearch<n>(corners, point)();
        if (here.square > best.square || (here.square == best.square && t > simplex && simplex >= 0)) return;
        best = here;
        simplex = t;
      });
  if (simplex >= 0) clamp(best.barycentric);
  return {{simplex, best.barycentric}, std::sqrt(best.square)};
}

template <int n>
std::vector<NearestPoint<n>> PointLocator<n>::nearest_all(std::span<const double> points) const {
  const auto m = static_cast<std::size_t>(geometry_->ambient_dimension());
  if (points.size() % m != 0) require_point(points.size());
  std::vector<NearestPoint<n>> result(points.size() / m);
  parallel_blocks(static_cast<Offset>(result.size()), 64, [&](Offset begin, Offset end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      result[i] = nearest(points.subspan(i * m, m));
  });
  return result;
}

template class PointLocator<1>;
template class PointLocator<2>;
template class PointLocator<3>;
template class PointLocator<4>;

}  // namespace derham
