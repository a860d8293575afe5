#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"

#include <vector>

namespace derham {

/// Top simplices that a metric cannot believe. Both lists are increasing and disjoint.
struct QualityReport {
  /// Flat top simplices: the smallest altitude is at most max(1e-12 * longest edge, 16 ulp of the largest coordinate)
  /// (1e-7 * longest edge when only lengths are known). Scale-invariant, and a flat simplex is found in any position.
  std::vector<Index> degenerate;
  /// Top simplices whose volume has, by exact arithmetic, the sign opposite to the coherent orientation. Empty unless
  /// m = n and K is orientable. Orient K by volume first.
  std::vector<Index> inverted;
  double smallest_volume = 0, largest_volume = 0, total_volume = 0;  ///< of the top simplices; units length^n
};

/// Looks at every top simplex; never throws on bad ones.
/// Cost     one pass over the top simplices
template <int n>
[[nodiscard]] QualityReport quality(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// orient_by_volume(K, geometry), then quality(K, geometry), for the price of one.
template <int n>
[[nodiscard]] QualityReport oriented_quality(SimplicialComplex<n>& K, const Geometry<n>& geometry);

}  // namespace derham
