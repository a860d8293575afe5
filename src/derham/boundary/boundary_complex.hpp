#pragma once

#include "derham/complex/simplicial_complex.hpp"

#include <array>
#include <vector>

namespace derham {

/// The boundary of a complex as a complex of its own, with the map that includes it.
template <int n>
struct BoundaryComplex {
  SimplicialComplex<n - 1> complex;

  /// inclusion[k][i] is the index in K of the boundary's k-simplex i. Vertices keep their order, so representatives map
  /// to representatives; the positively oriented top simplex i of the boundary, which carries the orientation that K
  /// induces, is complex.sign(n-1, i) times the (n-1)-simplex inclusion[n-1][i] of K.
  std::array<std::vector<Index>, static_cast<std::size_t>(n)> inclusion;
};

/// The closure of the facets with exactly one coface, oriented as the boundary of K; the empty complex if there is
/// none. A non-orientable K induces no orientation: then the boundary, if orientable, is coherent by itself, each
/// component with the sign that the representative of a top simplex of K induces on its first facet.
/// Law      the image of its fundamental chain is the boundary of the fundamental chain of K (n >= 2, K orientable)
/// Cost     linear
/// Throws   TopologyError if K is not pure
template <int n>
  requires(n >= 1)
[[nodiscard]] BoundaryComplex<n> boundary_complex(const SimplicialComplex<n>& K);

}  // namespace derham
