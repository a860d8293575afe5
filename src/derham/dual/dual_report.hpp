#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/dual/circumcentric.hpp"

#include <vector>

namespace derham {

/// What the diagonal star of one degree is like: star[i] = dual volume / volume.
struct StarVerdict {
  double min = 0;               ///< of the defined entries, NaN if there is none; units length^(n-2k)
  std::vector<Index> zero;      ///< simplices whose dual volume is zero: no inverse there
  std::vector<Index> negative;  ///< simplices whose dual volume is negative: not a positive definite mass
  /// Simplices of a degenerate top simplex, which have no dual cell, and entries out of the range of doubles; in no list.
  Index undefined = 0;
};

struct DualReport {
  std::vector<StarVerdict> star;  ///< (n+1,) by degree
  /// Every facet with two top simplices has a non-negative dual length: the mesh is Delaunay in the weak sense
  /// (cospherical neighbours count). Facets whose dual length is undefined, as those of degenerate top simplices, make
  /// it false.
  bool pairwise_delaunay = true;
  /// The same for the facets with one top simplex: no circumcentre lies beyond the boundary. Here, too, facets whose
  /// dual length is undefined make it false.
  bool one_sided = true;
  /// Every simplex of every degree contains its circumcentre in its interior; then all stars are positive.
  bool well_centered = true;
  std::vector<Index> degenerate;  ///< degenerate top simplices
};

/// Judges dual volumes. Pairwise Delaunay and one-sided together imply that no entry is negative.
/// Cost     one pass over all simplices
/// Source   Hirani, Kalyanaraman, VanderZee, "Delaunay Hodge star", 2013
template <int n>
[[nodiscard]] DualReport dual_report(const SimplicialComplex<n>& K, const CircumcentricDual<n>& dual);

/// Dual volumes and what they are like.
template <int n>
struct JudgedDual {
  CircumcentricDual<n> volumes;
  DualReport report;
};

/// circumcentric_dual(K, geometry) and the report on it, for the price of one: entries are judged while they are at hand.
template <int n>
[[nodiscard]] JudgedDual<n> judged_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// The report alone.
template <int n>
[[nodiscard]] DualReport dual_report(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  return judged_dual(K, geometry).report;
}

}  // namespace derham
