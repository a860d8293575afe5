#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <vector>

namespace derham {

/// Top simplices about a simplex of codimension 2, each sharing a facet with the next.
struct Ring {
  std::vector<Index> tops;
  bool closed = false;  ///< the last also shares a facet with the first
};

/// The ordered rings of top simplices about the simplices of codimension 2: tets about an edge (n = 3), triangles about
/// a vertex (n = 2). Built once for a complex, which it refers to and which must outlive it; n >= 2.
///
/// A ring is found by walking from top simplex to top simplex across the facets that contain the simplex. An open ring
/// begins at the one of its two boundary top simplices with the smaller index; a closed one at its smallest index and
/// goes on to the smaller of the two neighbours.
/// Memory   one entry per pair of a top simplex and a codimension-2 face of it
/// Source   Elcott & Schröder, "Building your own DEC at home", §2 (corrected: visited = total, open rings from
///          the end)
template <int n>
class Rings {
 public:
  explicit Rings(const SimplicialComplex<n>& K);
  explicit Rings(SimplicialComplex<n>&&) = delete;

  /// The ring about simplex i of degree n-2.
  /// Cost     linear in its length
  /// Throws   InputError if i is out of range; TopologyError if the top simplices form no single ring
  [[nodiscard]] Ring ring(Index i) const;

  /// All rings about simplex i of degree n-2: a partition of the top simplices that contain it, ordered by their
  /// smallest index. One ring exactly when the star is a manifold. Walks stop at facets with more than two cofaces.
  /// Throws   InputError if i is out of range
  [[nodiscard]] std::vector<Ring> rings(Index i) const;

  /// Whether the top simplices about simplex i form one ring; no allocation. `i` is not checked.
  [[nodiscard]] bool is_single_ring(Index i) const;

 private:
  /// A place on a walk: a top simplex and the facet across which the walk goes on.
  struct Place {
    Index top, facet;
  };
  [[nodiscard]] std::array<Index, 2> facets_about(Index simplex, Index top) const;
  [[nodiscard]] bool advance(Index simplex, Place& place) const;
  [[nodiscard]] Ring walk(Index simplex, Index top) const;

  const SimplicialComplex<n>& K_;
  FacetCofaces cofaces_;
  Incidence star_;
};

}  // namespace derham
