#include "derham/boundary/boundary_map.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "support/random_rows.hpp"
#include "support/random_values.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace derham {
namespace {

using support::random_values;
using Values = std::vector<double>;

std::size_t length(Index simplices, Index columns) {
  return static_cast<std::size_t>(simplices) * static_cast<std::size_t>(columns);
}

/// ∂_k by simplices one after the other is the specification, bit for bit.
template <int n>
void expect_same_bits(const SimplicialComplex<n>& K, Index columns) {
  for (int k = 1; k <= n; ++k) {
    SCOPED_TRACE(testing::Message() << "n = " << n << ", k = " << k);
    const Values x = random_values(static_cast<Index>(length(K.size(k), columns)), 1);
    Values expected(length(K.size(k - 1), columns)), y(expected.size(), -1);
    apply_boundary(K, k, x, expected, columns);
    BoundaryMap<n>(K, k).apply(x, y, columns);
    EXPECT_EQ(y, expected);
  }
}

TEST(BoundaryMap, IsTheBoundaryOnRandomComplexes) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    const auto of = [](const support::Rows& rows) { return support::simplex_list(rows); };
    for (const Index columns : {1, 3, 4, 5}) {
      expect_same_bits(SimplicialComplex<1>(of(support::random_pure(1, random))), columns);
      expect_same_bits(SimplicialComplex<2>(of(support::random_pure(2, random))), columns);
      expect_same_bits(SimplicialComplex<3>(of(support::random_mixed(3, random))), columns);
      expect_same_bits(SimplicialComplex<4>(of(support::random_pure(4, random))), columns);
      expect_same_bits(SimplicialComplex<6>(of(support::random_pure(6, random))), columns);
    }
  }
}

TEST(BoundaryMap, HasTheSameBitsOnAnyNumberOfThreads) {
  support::Random random(7);
  const auto box = meshes::box(3, 15).simplices;  // more faces of each degree than one thread takes
  support::Rows rows;
  for (Offset i = 0; i < box.size(); ++i) rows.emplace_back(box[i].begin(), box[i].end());
  const auto threads = thread_count();
  for (const int count : {1, 2, 4}) {
    SCOPED_TRACE(count);
    set_thread_count(count);
    expect_same_bits(SimplicialComplex<3>(box), 1);
    expect_same_bits(SimplicialComplex<3>(support::simplex_list(support::shuffled(rows, random))), 4);
  }
  set_thread_count(threads);
}

TEST(BoundaryMap, RefusesWrongDegreesAndLengths) {
  const SimplicialComplex<2> K(meshes::box(2, 2).simplices);
  EXPECT_THROW(BoundaryMap<2>(K, 0), InputError);
  EXPECT_THROW(BoundaryMap<2>(K, 3), InputError);
  const BoundaryMap<2> map(K, 1);
  EXPECT_EQ(map.degree(), 1);
  Values edges(length(K.size(1), 1)), vertices(length(K.size(0), 1));
  EXPECT_NO_THROW(map.apply(edges, vertices));
  EXPECT_THROW(map.apply(vertices, edges), InputError);
  EXPECT_THROW(map.apply(edges, vertices, 2), InputError);
  EXPECT_THROW(map.apply(edges, vertices, 0), InputError);
}

}  // namespace
}  // namespace derham
