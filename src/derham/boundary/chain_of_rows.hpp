#pragma once

#include "derham/boundary/chain.hpp"
#include "derham/complex/simplex_list.hpp"

#include <span>

namespace derham {

/// The sum of the rows `members` of a list, each oriented as it is written there: (2, 1) counts as minus (1, 2), and a
/// row that is listed twice counts twice. Rows of degree 0 are positive points.
/// Cost     O(s log s) for s members
/// Throws   InputError naming the row if it is outside of the list, has not k+1 vertices or is no simplex of K
template <int k, int n>
[[nodiscard]] Chain<n, k> chain_of_rows(const SimplicialComplex<n>& K, const SimplexList& rows,
                                        std::span<const Index> members);

/// The same simplices, each with coefficient +1 or -1 so that they cancel on every common face of two of them: the
/// orientation of each component is that of its first simplex. For the many files whose tagged surfaces are not oriented.
/// Law      on a k-manifold S, boundary(coherent(S)) is the sum of its rim, each face once
/// Cost     that of the complex of the simplices
/// Throws   TopologyError if they are not orientable (a Möbius strip), or more than two meet in a face
template <int n, int k>
  requires(k >= 1)
[[nodiscard]] Chain<n, k> coherent(const Chain<n, k>& chain);

}  // namespace derham
