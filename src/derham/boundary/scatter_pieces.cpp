#include "derham/boundary/scatter_pieces.hpp"

#include "derham/core/parallel.hpp"

#include <cstddef>
#include <span>

namespace derham::detail {
namespace {

/// Lists of simplices, one per piece.
using Lists = std::vector<std::vector<Index>>;

/// Where part p of `parts` equal ones of [0, total) begins.
Index part_begin(Index total, std::size_t p, std::size_t parts) {
  return static_cast<Index>(static_cast<std::size_t>(total) * p / parts);
}

/// The first row of a table of `width` columns, sorted by the first, whose face 0 is not below `face`.
Index first_row_from(std::span<const Index> faces, std::size_t width, Index face) {
  std::size_t low = 0, high = faces.size() / width;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (faces[middle * width] < face)
      low = middle + 1;
    else
      high = middle;
  }
  return static_cast<Index>(low);
}

std::size_t piece_of(const std::vector<ScatterPiece>& pieces, Index face) {
  const auto after = std::ranges::upper_bound(pieces, face, {}, &ScatterPiece::first_face);
  return static_cast<std::size_t>(after - pieces.begin()) - 1;
}

/// Of the simplices at home in pieces[home]: those that each piece has to list as shared.
Lists shared_from(const std::vector<ScatterPiece>& pieces, std::size_t home, std::span<const Index> faces,
                  std::size_t width) {
  Lists shared(pieces.size());
  const ScatterPiece& piece = pieces[home];
  for (Index i = piece.first; i < piece.last; ++i) {
    const auto row = faces.subspan(static_cast<std::size_t>(i) * width, width);  // increasing
    if (row.front() >= piece.first_face && row.back() < piece.last_face) continue;
    shared[home].push_back(i);
    std::size_t before = home;
    for (const Index face : row) {
      const std::size_t p = piece_of(pieces, face);
      if (p != home && p != before) shared[p].push_back(i);
      before = p;
    }
  }
  return shared;
}

}  // namespace

template <int n>
std::vector<ScatterPiece> scatter_pieces(const SimplicialComplex<n>& K, int k, int count) {
  const auto parts = static_cast<std::size_t>(count), width = static_cast<std::size_t>(k) + 1;
  const auto faces = K.face_table(k);
  const Index face_count = K.size(k - 1), simplices = K.size(k);
  std::vector<ScatterPiece> pieces(parts);
  for (std::size_t p = 0; p < parts; ++p) {
    pieces[p].first_face = part_begin(face_count, p, parts);
    // lists below degree n are sorted, so a simplex is best at home with its first face
    pieces[p].first = k < n ? first_row_from(faces, width, pieces[p].first_face) : part_begin(simplices, p, parts);
  }
  for (std::size_t p = 0; p < parts; ++p) {
    pieces[p].last_face = p + 1 < parts ? pieces[p + 1].first_face : face_count;
    pieces[p].last = p + 1 < parts ? pieces[p + 1].first : simplices;
  }
  if (count == 1) return pieces;

  std::vector<Lists> shared(parts);  // [home][piece]
  parallel_blocks(count, 1, [&](Offset home, Offset) {
    const auto h = static_cast<std::size_t>(home);
    shared[h] = shared_from(pieces, h, faces, width);
  });
  for (std::size_t p = 0; p < parts; ++p)
    for (const Lists& at_home : shared)
      pieces[p].shared.insert(pieces[p].shared.end(), at_home[p].begin(), at_home[p].end());
  return pieces;
}

template <int n>
std::vector<ScatterPiece> local_pieces(const SimplicialComplex<n>& K, int k, int count) {
  if (count == 1) return scatter_pieces(K, k, 1);
  constexpr Index asked = 1000;
  const Index simplices = K.size(k), step = std::max<Index>(simplices / asked, 1);
  const auto parts = static_cast<std::size_t>(count), width = static_cast<std::size_t>(k) + 1;
  const auto faces = K.face_table(k);
  std::vector<Index> begins(parts);
  for (std::size_t p = 0; p < parts; ++p) begins[p] = part_begin(K.size(k - 1), p, parts);
  Index shared = 0, sample = 0;
  for (Index i = 0; i < simplices; i += step, ++sample) {
    const auto row = faces.subspan(static_cast<std::size_t>(i) * width, width);  // increasing
    shared += std::ranges::upper_bound(begins, row.front()) != std::ranges::upper_bound(begins, row.back());
  }
  return scatter_pieces(K, k, 4 * shared > sample ? 1 : count);
}

#define DERHAM_INSTANTIATE(n)                                                               \
  template std::vector<ScatterPiece> scatter_pieces(const SimplicialComplex<n>&, int, int); \
  template std::vector<ScatterPiece> local_pieces(const SimplicialComplex<n>&, int, int);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham::detail
