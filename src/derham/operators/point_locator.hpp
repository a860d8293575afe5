#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/operators/box_tree.hpp"
#include "derham/operators/simplex_frame.hpp"
#include "derham/operators/whitney_map.hpp"

#include <span>
#include <vector>

namespace derham {

/// The point of K that is nearest to another.
template <int n>
struct NearestPoint {
  BarycentricPoint<n> point;
  double distance = 0;
};

/// Finds the top simplices that points of space lie in. K and the geometry must outlive it. n = 1 to 4.
///
/// In a mesh given by corners every top simplex counts where its own corners are.
/// Cost     N log N for the tree over N top simplices, then about log N a point
template <int n>
class PointLocator {
 public:
  /// Throws   InputError if the geometry does not belong to K; GeometryError if it has no coordinates
  PointLocator(const SimplicialComplex<n>& K, const Geometry<n>& geometry);
  PointLocator(SimplicialComplex<n>&&, const Geometry<n>&) = delete;
  PointLocator(const SimplicialComplex<n>&, Geometry<n>&&) = delete;

  /// The top simplex that holds the point, decided by exact arithmetic: of several, on a common face, the one with the smallest
  /// index; flat ones hold nothing. A point in none belongs to the smallest one from whose facets it is away by no
  /// more than 16 ulp of the largest coordinate and 1e-12 of the altitude; otherwise it is outside, simplex -1.
  /// Barycentric coordinates are not negative and their sum is 1.
  /// Throws   InputError unless the point has m coordinates; GeometryError unless m = n (see `nearest`)
  [[nodiscard]] BarycentricPoint<n> locate(std::span<const double> point) const;

  /// The same for many points, on all threads.
  /// Shape    points (count, m) row-major
  [[nodiscard]] std::vector<BarycentricPoint<n>> locate_all(std::span<const double> points) const;

  /// The nearest point of K, for any m >= n: for points outside, and for surfaces in space. Of several at the same distance, as
  /// it is rounded, one in the top simplex with the smallest index that is found.
  /// Cost     about log N where the mesh is not far away
  /// Throws   InputError unless the point has m finite coordinates
  [[nodiscard]] NearestPoint<n> nearest(std::span<const double> point) const;

  /// The same for many points, on all threads.
  [[nodiscard]] std::vector<NearestPoint<n>> nearest_all(std::span<const double> points) const;

 private:
  [[nodiscard]] BarycentricPoint<n> locate(std::span<const double> point, SimplexFrame<n>& frame) const;
  [[nodiscard]] bool holds(Index t, std::span<const double> point) const;
  void require_point(std::size_t coordinates) const;

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  double roundoff_ = 0;
  BoxTree tree_;
};

extern template class PointLocator<1>;
extern template class PointLocator<2>;
extern template class PointLocator<3>;
extern template class PointLocator<4>;

}  // namespace derham
