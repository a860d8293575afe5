#include "derham/boundary/scatter_pieces.hpp"

#include "derham/complex/cofaces.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace derham {
namespace {

/// The simplices that a piece treats, in the order in which it does.
std::vector<Index> treated(const detail::ScatterPiece& piece) {
  std::vector<Index> result;
  detail::for_each_in_order(
      piece,
      [&](Index first, Index last) {
        for (Index i = first; i < last; ++i) result.push_back(i);
      },
      [&](Index i) { result.push_back(i); });
  return result;
}

/// Whether every face is owned once, and its piece treats all its cofaces, each once, in their order; and whether what
/// is not shared has no face elsewhere.
template <int n>
void expect_complete(const SimplicialComplex<n>& K, int count) {
  for (int k = 1; k <= n; ++k) {
    const Cofaces cofaces(K, k - 1);
    Index next = 0;
    for (const auto& piece : detail::scatter_pieces(K, k, count)) {
      ASSERT_EQ(piece.first_face, next);
      next = piece.last_face;
      const std::vector<Index> order = treated(piece);
      for (std::size_t i = 1; i < order.size(); ++i) ASSERT_LT(order[i - 1], order[i]);
      for (Index face = piece.first_face; face < piece.last_face; ++face)
        for (const auto [coface, sign] : cofaces[face])
          ASSERT_TRUE(std::ranges::binary_search(order, coface)) << coface << " over " << face;
      detail::for_each_in_order(
          piece,
          [&](Index first, Index last) {
            for (Index i = first; i < last; ++i)
              for (const Index face : K.faces(k, i)) ASSERT_TRUE(face >= piece.first_face && face < piece.last_face);
          },
          [](Index) {});
    }
    ASSERT_EQ(next, K.size(k - 1));
  }
}

TEST(ScatterPieces, TreatEveryCofaceOfEveryFaceOnceAndInOrder) {
  for (unsigned seed = 0; seed < 5; ++seed)
    for (const int count : {1, 2, 3, 7}) {
      SCOPED_TRACE(std::to_string(seed) + ", " + std::to_string(count) + " pieces");
      support::Random random(seed);
      expect_complete(SimplicialComplex<1>(support::simplex_list(support::random_pure(1, random))), count);
      expect_complete(SimplicialComplex<2>(support::simplex_list(support::random_pure(2, random))), count);
      expect_complete(SimplicialComplex<3>(support::simplex_list(support::random_pure(3, random))), count);
      expect_complete(SimplicialComplex<4>(support::simplex_list(support::random_mixed(4, random))), count);
    }
}

TEST(ScatterPieces, OfALocalNumberingShareFewSimplices) {
  const SimplicialComplex<3> K(meshes::box({4, 4, 200}).simplices);
  for (int k = 1; k <= 3; ++k) {
    std::size_t shared = 0;
    for (const auto& piece : detail::scatter_pieces(K, k, 4)) shared += piece.shared.size();
    EXPECT_LT(20 * shared, static_cast<std::size_t>(K.size(k))) << "degree " << k;
    EXPECT_GT(shared, 0u);
    EXPECT_TRUE(detail::scatter_pieces(K, k, 1)[0].shared.empty());
  }
}

TEST(ScatterPieces, AreOneWhereSeveralWouldShareTooMuch) {
  const auto box = meshes::box(3, 15).simplices;
  support::Rows rows;
  for (Offset i = 0; i < box.size(); ++i) rows.emplace_back(box[i].begin(), box[i].end());
  support::Random random(1);
  const SimplicialComplex<3> local(box), shuffled(support::simplex_list(support::shuffled(rows, random)));
  const auto threads = thread_count();
  set_thread_count(2);
  for (int k = 2; k <= 3; ++k) {
    EXPECT_EQ(detail::pieces_for_threads(local, k).size(), 2u);
    EXPECT_EQ(detail::pieces_for_threads(shuffled, k).size(), 1u);
  }
  EXPECT_EQ(detail::pieces_for_threads(local, 1).size(), 1u) << "few faces";
  set_thread_count(threads);
}

}  // namespace
}  // namespace derham
