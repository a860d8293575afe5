#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <array>
#include <vector>

namespace derham {

/// A set of simplices of an n-complex: for each degree the increasing indices. Not necessarily closed under faces.
template <int n>
struct SimplexSet {
  std::array<std::vector<Index>, n + 1> indices;

  [[nodiscard]] Index size(int k) const noexcept {
    return static_cast<Index>(indices[static_cast<std::size_t>(k)].size());
  }
  [[nodiscard]] bool contains(int k, Index i) const noexcept;
  friend bool operator==(const SimplexSet&, const SimplexSet&) = default;
};

/// The set that holds one simplex. Throws InputError unless 0 <= k <= n.
template <int n>
[[nodiscard]] SimplexSet<n> simplex_set(int k, Index i) {
  if (k < 0 || k > n) throw InputError(text("a ", k, "-simplex in a complex of dimension ", n));
  SimplexSet<n> set;
  set.indices[static_cast<std::size_t>(k)].push_back(i);
  return set;
}

/// The cofaces, one degree higher, of every simplex: the transposed boundary tables, built once for many queries.
/// Shape    table[k] has |K_k| rows, 0 <= k < n
template <int n>
struct CofaceLists {
  explicit CofaceLists(const SimplicialComplex<n>& K) {
    for (int k = 0; k < n; ++k) table[static_cast<std::size_t>(k)] = incidence(K, k, k + 1);
  }
  std::array<Incidence, n + 1> table;
};

/// All faces of the simplices of `set`, and they themselves: the smallest subcomplex that holds the set.
/// Cost     O(s log s) in the size s of the result
/// Throws   InputError if an index is outside [0, |K_k|)
template <int n>
[[nodiscard]] SimplexSet<n> closure(const SimplicialComplex<n>& K, SimplexSet<n> set);

/// All simplices that have a simplex of `set` as a face, and they themselves (open star).
/// Cost     O(s log s) in the size s of the result
/// Throws   InputError if an index is outside [0, |K_k|) for a degree k < n
template <int n>
[[nodiscard]] SimplexSet<n> star(const CofaceLists<n>& cofaces, SimplexSet<n> set);

/// Closure of the star without the star of the closure: for one simplex s, all t disjoint from s with s*t in K.
/// Throws   InputError if an index is outside [0, |K_k|)
template <int n>
[[nodiscard]] SimplexSet<n> link(const SimplicialComplex<n>& K, const CofaceLists<n>& cofaces,
                                 const SimplexSet<n>& set);

/// The simplices on the boundary: the closure of the facets with exactly one coface. Empty for n = 0.
/// Cost     linear
template <int n>
[[nodiscard]] SimplexSet<n> boundary_simplices(const SimplicialComplex<n>& K);

}  // namespace derham
