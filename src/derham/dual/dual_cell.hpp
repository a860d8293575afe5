#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"

#include <vector>

namespace derham {

/// One elementary piece of a dual cell: the simplex of the circumcentres of a chain σ^k ⊂ σ^{k+1} ⊂ … ⊂ σ^n.
struct DualFlag {
  Index top = 0;               ///< σ^n
  std::vector<double> points;  ///< (n-k+1, d): circumcentres of σ^k, …, σ^n
  double signed_volume = 0;  ///< negative where an odd number of circumcentres lie on the far side; units length^(n-k)
};

/// A dual cell of dimension 0 to 3 as it is drawn; at the boundary it is closed by the circumcentres of the boundary
/// simplices. Its outline passes through the circumcentre of every facet it crosses. On a Delaunay mesh the cell is
/// convex, but where a facet's circumcentre lies beyond the dual edge the outline runs there and back: a spike without
/// area.
struct DualCell {
  int dimension = 0;
  std::vector<double> points;                 ///< (number of points, d) circumcentres, without repetition
  std::vector<std::vector<Index>> polylines;  ///< dimension 1: the path of point numbers from one end to the other
  std::vector<std::vector<Index>> polygons;   ///< dimension 2: the cell; 3: its faces. Closed loops of point numbers;
                                              ///< circumcentres of interior facets lie on the sides of flat cells
};

/// The circumcentric dual cells of the k-simplices, made explicit for pictures and export: one at a time, on demand.
/// K and the geometry must outlive it. Coordinates are those of Geometry::simplex_corners; in a periodic mesh all of a
/// cell is brought next to its simplex, for charts that differ by translations.
template <int n>
class DualCells {
 public:
  /// Cost     one incidence table. Throws InputError unless 0 <= k <= n
  DualCells(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k);
  DualCells(SimplicialComplex<n>&&, const Geometry<n>&, int) = delete;
  DualCells(const SimplicialComplex<n>&, Geometry<n>&&, int) = delete;

  /// All flags of the dual cell of k-simplex i, (n-k)! for every top simplex around it.
  /// Law      their signed volumes sum to the dual volume
  /// Throws   InputError unless 0 <= i < |K_k|; GeometryError naming a flat simplex
  [[nodiscard]] std::vector<DualFlag> flags(Index i) const;

  /// The dual cell of k-simplex i as points, polylines and polygons, for n-k <= 3.
  /// Throws   InputError for n-k > 3 and unless 0 <= i < |K_k|; TopologyError naming a facet of more than two top
  ///          simplices; GeometryError naming a flat simplex
  [[nodiscard]] DualCell cell(Index i) const;

 private:
  void require_index(Index i) const;

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  int degree_;
  Incidence tops_;
};

extern template class DualCells<0>;
extern template class DualCells<1>;
extern template class DualCells<2>;
extern template class DualCells<3>;
extern template class DualCells<4>;

}  // namespace derham
