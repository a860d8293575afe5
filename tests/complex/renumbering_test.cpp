#include "derham/complex/renumbering.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace derham {
namespace {

using support::Random;

std::vector<Index> sorted(std::vector<Index> values) {
  std::ranges::sort(values);
  return values;
}

std::vector<Index> counted(std::size_t size) {
  std::vector<Index> values(size);
  std::iota(values.begin(), values.end(), Index{0});
  return values;
}

/// Any renumbering, good or bad.
Renumbering random_renumbering(const SimplexList& rows, Random& random) {
  Renumbering result{counted(static_cast<std::size_t>(rows.vertex_bound())),
                     counted(static_cast<std::size_t>(rows.size()))};
  std::ranges::shuffle(result.new_vertex, random);
  std::ranges::shuffle(result.old_row, random);
  return result;
}

/// Both are permutations, rows are ordered by their lowest vertex, and the renumbered rows are the old ones.
void expect_sound(const SimplexList& rows, Index vertex_count, const Renumbering& r) {
  ASSERT_EQ(sorted(r.new_vertex), counted(static_cast<std::size_t>(vertex_count)));
  ASSERT_EQ(sorted(r.old_row), counted(static_cast<std::size_t>(rows.size())));
  const SimplexList result = renumbered(rows, r);
  ASSERT_EQ(result.size(), rows.size());
  ASSERT_EQ(result.is_uniform(), rows.is_uniform());
  Index before = 0;
  for (Offset i = 0; i < result.size(); ++i) {
    const auto old = rows[r.old_row[static_cast<std::size_t>(i)]];
    ASSERT_EQ(result[i].size(), old.size());
    for (std::size_t j = 0; j < old.size(); ++j)
      ASSERT_EQ(result[i][j], r.new_vertex[static_cast<std::size_t>(old[j])]);
    const Index lowest = std::ranges::min(result[i]);
    ASSERT_LE(before, lowest);
    before = lowest;
  }
}

/// The derivative of x, values on the k-simplices, by the definition: entries (-1)^i of faces, times the top sign.
template <int n>
std::vector<double> derivative(const SimplicialComplex<n>& K, int k, const std::vector<double>& x) {
  std::vector<double> y(static_cast<std::size_t>(K.size(k + 1)), 0);
  for (Index i = 0; i < K.size(k + 1); ++i)
    for (int j = 0; j <= k + 1; ++j)
      y[static_cast<std::size_t>(i)] +=
          K.sign(k + 1, i) * face_sign(j) * x[static_cast<std::size_t>(K.face_opposite(k + 1, i, j))];
  return y;
}

/// Maps are bijections that keep vertex sets, commute with d, and lead back.
template <int n>
void expect_isomorphic(const SimplexList& rows, const Renumbering& r, Random& random) {
  const SimplicialComplex<n> K(rows), L(renumbered(rows, r));
  ASSERT_EQ(K.is_orientable(), L.is_orientable());
  std::vector<std::vector<SignedIndex>> maps;
  for (int k = 0; k <= n; ++k) {
    maps.push_back(simplex_map(K, L, r, k));
    std::vector<Index> image;
    for (Index i = 0; i < K.size(k); ++i) {
      const auto [place, sign] = maps.back()[static_cast<std::size_t>(i)];
      image.push_back(place);
      std::vector<Index> vertices;
      for (const Index v : K.simplex(k, i)) vertices.push_back(r.new_vertex[static_cast<std::size_t>(v)]);
      ASSERT_TRUE(std::ranges::equal(sorted(vertices), L.simplex(k, place)));
      ASSERT_EQ(sign * sign, 1);
    }
    ASSERT_EQ(sorted(image), counted(image.size()));
  }
  for (int k = 0; k <= n; ++k) {
    std::vector<double> x(static_cast<std::size_t>(K.size(k)));
    for (double& value : x) value = support::uniform(random, -100, 100);
    const auto moved = carried(x, maps[static_cast<std::size_t>(k)]);
    EXPECT_EQ(carried_back(moved, maps[static_cast<std::size_t>(k)]), x);
    if (k < n) {
      EXPECT_EQ(carried(derivative(K, k, x), maps[static_cast<std::size_t>(k) + 1]), derivative(L, k, moved));
    }
  }
}

template <int n>
void expect_isomorphic_when_renumbered(const SimplexList& rows, Random& random) {
  const Renumbering r = reverse_cuthill_mckee(rows, rows.vertex_bound());
  expect_sound(rows, rows.vertex_bound(), r);
  expect_isomorphic<n>(rows, r, random);
  expect_isomorphic<n>(rows, random_renumbering(rows, random), random);
}

template <int n>
void expect_random_isomorphic() {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "n = " << n << ", seed " << seed);
    Random random(seed);
    expect_isomorphic_when_renumbered<n>(support::simplex_list(support::random_pure(n, random)), random);
    expect_isomorphic_when_renumbered<n>(support::simplex_list(support::random_components(n, 3, random)), random);
    expect_isomorphic_when_renumbered<n>(support::simplex_list(support::random_mixed(n, random)), random);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Renumbering, GivesTheSameComplexWithTheSameDerivative) {
  expect_random_isomorphic<1>();
  expect_random_isomorphic<2>();
  expect_random_isomorphic<3>();
  expect_random_isomorphic<4>();
  expect_random_isomorphic<6>();
}

/// Every top simplex is positive in L as the alias that is positive in K.
TEST(Renumbering, OrientAsTransportsTheOrientation) {
  using namespace meshes;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const SimplexList rows = support::simplex_list(support::shuffled(
        reference::tuples(disjoint_union(disjoint_union(box(3, 2).simplices, grid_torus(3)), sphere(3))), random));
    const Renumbering r = random_renumbering(rows, random);
    const SimplicialComplex<3> K(rows);
    SimplicialComplex<3> L(renumbered(rows, r));
    orient_as(L, K, r);
    for (const auto& [top, sign] : simplex_map(K, L, r, 3)) ASSERT_EQ(sign, 1);
  }
}

TEST(ReverseCuthillMcKee, KnownOrders) {
  // A path is numbered from end to end, and the far end first found is the start: here 5, so 1 comes last, reversed first.
  const SimplexList path{{1, 0}, {0, 4}, {4, 2}, {2, 3}, {3, 5}};
  const Renumbering r = reverse_cuthill_mckee(path, 6);
  const SimplexList result = renumbered(path, r);
  EXPECT_EQ(vertex_gaps(result).largest, 1);
  // vertices in no row come last, in their order
  const Renumbering unused = reverse_cuthill_mckee(SimplexList{{4, 1}, {1, 2}}, 6);
  EXPECT_EQ(unused.new_vertex[0], 3);
  EXPECT_EQ(unused.new_vertex[3], 4);
  EXPECT_EQ(unused.new_vertex[5], 5);
  EXPECT_TRUE(reverse_cuthill_mckee(SimplexList(), 0).new_vertex.empty());
}

/// The bandwidth of a long strip is about its width, however its vertices are numbered.
TEST(ReverseCuthillMcKee, BringsNeighboursTogether) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto shuffled = [&](const SimplexList& rows) {
      return support::simplex_list(support::shuffled(reference::tuples(rows), random));
    };
    const SimplexList strip = shuffled(meshes::box({200, 3}).simplices);
    EXPECT_GT(vertex_gaps(strip).mean, 200);
    EXPECT_LE(vertex_gaps(renumbered(strip, reverse_cuthill_mckee(strip, strip.vertex_bound()))).largest, 9);
    const SimplexList cube = shuffled(meshes::box(3, 12).simplices);  // 2197 vertices, 169 in a layer
    EXPECT_LE(vertex_gaps(renumbered(cube, reverse_cuthill_mckee(cube, cube.vertex_bound()))).mean, 400);
  }
}

TEST(Renumbering, DoesNotDependOnTheNumberOfThreads) {
  Random random(1);
  const SimplexList rows =
      support::simplex_list(support::shuffled(reference::tuples(meshes::box(3, 18).simplices), random));
  const int threads = thread_count();
  std::vector<SimplexList> results;
  for (const int count : {1, 2, 4}) {
    set_thread_count(count);
    results.push_back(renumbered(rows, reverse_cuthill_mckee(rows, rows.vertex_bound())));
  }
  set_thread_count(threads);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST(Renumbering, GapsAreHighestMinusLowest) {
  const VertexGaps gaps = vertex_gaps(SimplexList{{5, 1, 3}, {2, 4}});
  EXPECT_EQ(gaps.mean, 3);
  EXPECT_EQ(gaps.largest, 4);
  EXPECT_EQ(vertex_gaps(SimplexList()).mean, 0);
}

TEST(Renumbering, RefusesWhatDoesNotBelongTogether) {
  EXPECT_THROW((void)reverse_cuthill_mckee(SimplexList{{0, 1, 2}}, 2), InputError);
  EXPECT_THROW((void)reverse_cuthill_mckee(SimplexList{{0, -1, 2}}, 3), InputError);
  const SimplexList rows{{0, 1, 2}, {1, 2, 3}};
  const SimplicialComplex<2> K(rows), triangle(SimplexList{{0, 1, 2}}), other(SimplexList{{0, 1, 2}, {0, 2, 3}});
  const Renumbering same{{0, 1, 2, 3}, {0, 1}};
  EXPECT_THROW((void)simplex_map(K, K, same, 3), InputError);
  EXPECT_THROW((void)simplex_map(K, K, same, -1), InputError);
  EXPECT_THROW((void)simplex_map(K, triangle, same, 1), InputError);
  EXPECT_THROW((void)simplex_map(K, other, same, 2), InputError);
  const auto map = simplex_map(K, K, same, 1);
  EXPECT_THROW((void)carried(std::vector<double>(4), map), InputError);
  EXPECT_THROW((void)carried_back(std::vector<double>(6), map), InputError);
}

}  // namespace
}  // namespace derham
