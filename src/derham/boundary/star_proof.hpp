#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

namespace derham::detail {

/// What `prove_by_stars` found out. Internal to the room: `check_manifold` asks it first.
struct StarProof {
  bool is_manifold = false;  ///< proven; false says nothing but that
  bool closed = false;       ///< when proven: without boundary
};

/// Whether K is certainly a combinatorial manifold (n = 2 or 3). It never says no to one.
///
/// Let K be pure and no facet have more than two cofaces; let v be a vertex, L its link, and L~ the top simplices at v
/// glued across their common facets at v only. L comes from L~ by identifying vertices (n = 3: an edge at v is one
/// vertex of L, but as many of L~ as there are rings about it). L~ is a curve or a surface, because its edges have at
/// most two triangles each. n = 2: if L~ is connected, it is a path or a circle, and L = L~. n = 3: if L~ is connected,
/// its Euler characteristic is at most 2, and at most 1 if it has a boundary; only spheres and discs reach that. Every
/// identification lowers it by one. So if that of L, edges minus facets plus tets at v, is 2, or 1 and some facet at v
/// has one coface, then L = L~ is a sphere or a disc, and there is one ring about every edge at v.
/// Conversely stars in a manifold have all these properties.
///
/// L~ is connected for every v: the top simplices are visited in order. Each corner (a vertex of one of them) takes the
/// number of a tree at its vertex from a neighbour that was visited before, or a new number if there is none; where it
/// finds two numbers, those trees are one. A facet remembers the numbers of its first coface, a vertex which of its
/// trees are one: neither stars nor neighbours are ever looked up.
/// Cost     one pass over the top simplices, one over edges and facets
/// Memory   2 bytes per facet, 16 (24 with 64-bit indices) per vertex; more for vertices where 16 trees meet
template <int n>
  requires(n == 2 || n == 3)
[[nodiscard]] StarProof prove_by_stars(const SimplicialComplex<n>& K);

}  // namespace derham::detail
