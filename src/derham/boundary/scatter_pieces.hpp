#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

// Internal to the operators of boundary and hodge.
namespace derham::detail {

/// One piece of a scatter from the k-simplices to their faces, so that threads can do the pieces at the same time. It
/// owns the faces [first_face, last_face), and writes to no other; to do so it treats, in the order of their indices, all
/// k-simplices with a face there. Hence every face gets the same sum of terms in the same order, however many pieces.
///
/// The k-simplices [first, last) are at home here: no other piece treats them unless they are in `shared`. These have
/// faces in several pieces, or none here, or are at home elsewhere.
struct ScatterPiece {
  Index first_face = 0, last_face = 0;
  Index first = 0, last = 0;
  std::vector<Index> shared;  ///< increasing
};

/// The pieces, `count` >= 1, of the scatter of degree k, 1 <= k <= n, each with as many faces.
/// In a mesh whose numbering is local hardly any simplex is shared; in the worst case each is, by up to k+1 pieces.
/// Cost     one pass over the face table, in parallel; none for one piece
template <int n>
[[nodiscard]] std::vector<ScatterPiece> scatter_pieces(const SimplicialComplex<n>& K, int k, int count);

/// As many pieces, or one if the numbering is so far from local that the pieces would share more than a quarter of the simplices:
/// then several threads gain nothing. Asks some of the simplices, spread evenly.
template <int n>
[[nodiscard]] std::vector<ScatterPiece> local_pieces(const SimplicialComplex<n>& K, int k, int count);

/// The same for the present `thread_count()`; one if there are few faces.
template <int n>
[[nodiscard]] std::vector<ScatterPiece> pieces_for_threads(const SimplicialComplex<n>& K, int k) {
  constexpr Index few = 1 << 14;
  return local_pieces(K, k, K.size(k - 1) < few ? 1 : thread_count());
}

/// Calls run(first, last) for the intervals of simplices that have all their faces in the piece and one(i) for those
/// that are shared, in the order of their indices.
template <class Run, class One>
void for_each_in_order(const ScatterPiece& piece, Run&& run, One&& one) {
  Index next = piece.first;
  for (const Index i : piece.shared) {
    const Index stop = std::clamp(i, next, piece.last);
    run(next, stop);
    one(i);
    next = std::clamp(i + 1, stop, piece.last);
  }
  run(next, piece.last);
}

/// Adds what the simplices of a piece give to its rows of y, (|faces|, columns): visit(i, place) adds the terms of simplex i,
/// `place(face)` is where the row of a face is kept.
template <class Columns, class Visit>
void scatter(const ScatterPiece& piece, double* __restrict y, Columns columns, Visit&& visit) {
  const auto run = [&](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) visit(i, [=](Offset face) { return y + face * columns; });
  };
  std::vector<double> elsewhere(static_cast<std::size_t>(columns));
  const auto one = [&](Offset i) {
    visit(i, [&](Offset face) {
      return face >= piece.first_face && face < piece.last_face ? y + face * columns : elsewhere.data();
    });
  };
  for_each_in_order(piece, run, one);
}

}  // namespace derham::detail
