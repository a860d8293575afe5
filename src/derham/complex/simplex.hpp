#pragma once

#include "derham/core/types.hpp"

#include <array>
#include <span>

namespace derham {

/// A k-simplex as the tuple of its k+1 vertices. The sorted tuple is its representative; every other order is an alias.
template <int k>
using Tuple = std::array<Index, k + 1>;

/// Position of a simplex in its list together with the sign of the alias it was asked by.
struct SignedIndex {
  Index index = -1;  ///< -1: not in the complex
  Sign sign = 0;     ///< S(alias); 0: not in the complex
  explicit operator bool() const noexcept { return index >= 0; }
  friend bool operator==(const SignedIndex&, const SignedIndex&) = default;
};

/// Sorts `t` in place and returns S(P), the sign of the permutation P that sorts it; 0 if a vertex is repeated.
/// Insertion sort: the shortest way for the handful of vertices of a simplex.
/// Source   Elcott & Schröder, "Building your own DEC at home", §3.2
constexpr Sign sort_with_sign(std::span<Index> t) noexcept {
  Sign sign = 1;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const Index v = t[i];
    std::size_t j = i;
    for (; j > 0 && t[j - 1] > v; --j) {
      t[j] = t[j - 1];
      sign = static_cast<Sign>(-sign);
    }
    t[j] = v;
  }
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i - 1] == t[i]) return 0;
  return sign;
}

/// The relative orientation (-1)^i of the face of a sorted simplex that omits its vertex number i.
constexpr Sign face_sign(int i) noexcept { return i % 2 == 0 ? Sign{1} : Sign{-1}; }

}  // namespace derham
