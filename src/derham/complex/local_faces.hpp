#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <utility>

namespace derham {

/// The faces of one simplex are numbered by bit masks: bit j says that vertex j of its representative belongs to
/// the face. Everything below is unrolled at compile time, for the loops over all simplices.
template <int n>
inline constexpr unsigned full_mask = (1U << (n + 1)) - 1;

constexpr int mask_degree(unsigned mask) noexcept { return std::popcount(mask) - 1; }

/// The local vertices in `mask`, increasing.
template <unsigned mask>
constexpr auto mask_vertices() noexcept {
  std::array<int, static_cast<std::size_t>(std::popcount(mask))> vertices{};
  for (int v = 0, i = 0; (mask >> v) != 0; ++v)
    if ((mask >> v) & 1U) vertices[static_cast<std::size_t>(i++)] = v;
  return vertices;
}

/// Calls body.template operator()<mask>() for every face of an n-simplex, every face after the faces it belongs to.
template <int n, class Body>
constexpr void for_each_mask(Body&& body) {
  [&]<unsigned... i>(std::integer_sequence<unsigned, i...>) {
    (body.template operator()<full_mask<n> - i>(), ...);
  }(std::make_integer_sequence<unsigned, full_mask<n>>{});
}

/// Calls body.template operator()<v>() for v = 0, …, count-1.
template <int count, class Body>
constexpr void unrolled(Body&& body) {
  [&]<int... v>(std::integer_sequence<int, v...>) {
    (body.template operator()<v>(), ...);
  }(std::make_integer_sequence<int, count>{});
}

/// One value per face of a simplex, indexed by mask (entry 0 is unused).
template <int n, class T>
using FaceArray = std::array<T, std::size_t{full_mask<n>} + 1>;

/// The index, in the list of its degree, of every face of an m-simplex. `row.template operator()<k>(i)` is the row of
/// k-simplex i in the face table, for 1 <= k <= m; rows that only unused faces need are not read.
template <int m, class Row>
[[nodiscard, gnu::always_inline]] inline FaceArray<m, Index> local_faces(Index simplex, Row&& row) noexcept {
  FaceArray<m, Index> index;
  index[0] = -1;
  index[full_mask<m>] = simplex;
  for_each_mask<m>([&]<unsigned mask>() {
    constexpr int k = mask_degree(mask);
    if constexpr (k < m) {
      // The coface with the lowest vertex that is missing here; as that vertex comes after `position` others in it,
      // the face table lists us at k+1-position.
      constexpr int missing = std::countr_one(mask);
      constexpr unsigned coface = mask | (1U << missing);
      constexpr int position = missing;
      index[mask] = row.template operator()<k + 1>(index[coface])[static_cast<std::size_t>(k + 1 - position)];
    }
  });
  return index;
}

/// The same of top simplex t of K.
template <int n>
[[nodiscard]] FaceArray<n, Index> face_indices(const SimplicialComplex<n>& K, Index t) noexcept {
  return local_faces<n>(t, [&]<int k>(Index i) { return K.template faces<k>(i); });
}

}  // namespace derham
