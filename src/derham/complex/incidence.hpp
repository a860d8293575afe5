#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <span>
#include <vector>

namespace derham {

/// A table of variable-length rows of indices (compressed sparse rows without values).
struct Incidence {
  std::vector<Offset> offsets{0};  ///< (rows+1,)
  std::vector<Index> indices;      ///< row after row, increasing within a row

  [[nodiscard]] Index rows() const noexcept { return static_cast<Index>(offsets.size() - 1); }
  [[nodiscard]] std::span<const Index> operator[](Index i) const noexcept {
    const auto begin = offsets[static_cast<std::size_t>(i)];
    return {indices.data() + begin, static_cast<std::size_t>(offsets[static_cast<std::size_t>(i) + 1] - begin)};
  }
};

/// For every k-simplex the m-simplices incident on it: its faces of dimension m when m < k, its cofaces when m > k,
/// itself when m = k. Each once: the unsigned concatenation of boundary matrices without its (m-k)! multiplicities.
/// Shape    |K_k| rows
/// Cost     linear in the size of the result
/// Throws   InputError unless 0 <= k, m <= n
/// Source   Elcott & Schröder, "Building your own DEC at home", §4
template <int n>
[[nodiscard]] Incidence incidence(const SimplicialComplex<n>& K, int k, int m);

/// Number of cofaces of each facet and the first two of them, in one pass: the dual graph of a complex.
struct FacetCofaces {
  std::vector<Index> first, second;  ///< (|K_{n-1}|,) top simplices, -1 where there is none
  std::vector<Index> count;          ///< (|K_{n-1}|,) number of cofaces
};

/// The dual graph of K, for n >= 1 (empty for n = 0).
template <int n>
[[nodiscard]] FacetCofaces facet_cofaces(const SimplicialComplex<n>& K);

}  // namespace derham
