#pragma once

#include "derham/core/types.hpp"

#include <span>
#include <vector>

namespace derham {

/// A coherent choice of signs of the top simplices, or the proof that there is none.
///
/// `sign[t]` is S(representative of top simplex t). Signs are coherent when for every facet with two cofaces the two
/// entries of the boundary matrix are opposite. The free sign of each component makes its first input tuple positive,
/// until positions say otherwise; see facet_components.
struct Orientation {
  bool orientable = true;
  std::vector<Sign> sign;        ///< (|K_n|,); all +1 when not orientable
  std::vector<Index> one_sided;  ///< when not orientable: a closed walk of top simplices, each sharing a facet with the
                                 ///< next and the last with the first, along which orientation is reversed
};

template <int n>
class SimplicialComplex;

/// The coherent orientation of the top simplices of K: one pass over them, with disjoint sets that know signs.
/// `preferred` (|K_n|,) holds the sign +1 or -1 that each representative would like; the first top simplex of a
/// component gets it.
/// Cost     linear in practice, N log N at worst; fastest when neighbours follow each other
/// Memory   an index per facet and at most two per top simplex beside the result
/// Throws   InputError if `preferred` has another size or value
/// Source   Elcott & Schröder, "Building your own DEC at home", §3.2, made independent of an embedding
template <int n>
[[nodiscard]] Orientation coherent_orientation(const SimplicialComplex<n>& K, std::span<const Sign> preferred);

/// The sets of top simplices that are connected across facets with two cofaces: within each the sign is free once.
struct FacetComponents {
  Index count = 0;
  std::vector<Index> of_top;  ///< (|K_n|,) its number, in the order of their first top simplices; empty when count <= 1
};

/// Cost     as coherent_orientation
template <int n>
[[nodiscard]] FacetComponents facet_components(const SimplicialComplex<n>& K);

}  // namespace derham
