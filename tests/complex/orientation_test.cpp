#include "derham/complex/orientation.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace derham {
namespace {

/// The same simplices with ids, tuples and rows in random order.
SimplexList shuffled(const SimplexList& rows, unsigned seed) {
  support::Random random(seed);
  return support::simplex_list(support::shuffled(reference::tuples(rows), random));
}

/// For every facet with two cofaces, the two entries of its row of the boundary matrix are opposite.
template <int n>
void expect_coherent(const SimplicialComplex<n>& K) {
  std::vector<int> sum(static_cast<std::size_t>(K.size(n - 1)), 0), count(sum);
  for (Index t = 0; t < K.size(n); ++t)
    for (int i = 0; i <= n; ++i) {
      const auto facet = static_cast<std::size_t>(K.face_opposite(n, t, i));
      sum[facet] += K.sign(n, t) * (i % 2 == 0 ? 1 : -1);
      ++count[facet];
    }
  for (std::size_t facet = 0; facet < sum.size(); ++facet)
    if (count[facet] == 2) {
      ASSERT_EQ(sum[facet], 0) << "facet " << facet;
    }
}

/// The first input row of every component has the positive alias.
template <int n>
void expect_first_rows_positive(const SimplicialComplex<n>& K, const SimplexList& rows) {
  const FacetComponents components = facet_components(K);
  std::vector<char> seen(static_cast<std::size_t>(components.count), 0);
  for (Index t = 0; t < K.size(n); ++t) {
    const auto& component = components.of_top;
    char& first = seen[component.empty() ? 0 : static_cast<std::size_t>(component[static_cast<std::size_t>(t)])];
    if (!first) {
      EXPECT_EQ(K.at(rows[t]), (SignedIndex{t, 1}));
    }
    first = 1;
  }
}

template <int n>
void expect_orientable(const SimplexList& rows, Index components = 1) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    const SimplexList input = shuffled(rows, seed);
    const SimplicialComplex<n> K(input);
    EXPECT_TRUE(K.is_orientable());
    EXPECT_TRUE(K.orientation().one_sided.empty());
    EXPECT_EQ(facet_components(K).count, components);
    EXPECT_EQ(K.component_count(), components);
    EXPECT_EQ(facet_components(K).of_top.empty(), components == 1);
    expect_coherent(K);
    expect_first_rows_positive(K, input);
  }
}

/// Walks along the witness with the reference's rule for neighbours: it must close up, across facets with two cofaces,
/// and bring back the other sign.
template <int n>
void expect_one_sided(const SimplexList& rows) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const SimplexList input = shuffled(rows, seed);
    const SimplicialComplex<n> K(input);
    EXPECT_FALSE(K.is_orientable());
    for (Index t = 0; t < K.size(n); ++t) EXPECT_EQ(K.sign(n, t), 1);

    const std::vector<Index>& walk = K.orientation().one_sided;
    ASSERT_GE(walk.size(), 3u);
    auto distinct = walk;
    std::ranges::sort(distinct);
    EXPECT_EQ(std::ranges::adjacent_find(distinct), distinct.end()) << "a top simplex is visited twice";
    const reference::Complex R(n, reference::tuples(input));
    const auto cofaces = R.facet_cofaces();
    int sign = 1;
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const Index t = walk[i], u = walk[(i + 1) % walk.size()];
      reference::Tuple facet;
      std::ranges::set_intersection(K.simplex(n, t), K.simplex(n, u), std::back_inserter(facet));
      ASSERT_EQ(facet.size(), static_cast<std::size_t>(n)) << "simplices " << t << " and " << u << " share no facet";
      ASSERT_EQ(cofaces.at(facet).size(), 2u);
      sign = R.coherent_sign(t, sign, u, facet);
    }
    EXPECT_EQ(sign, -1) << "the walk is two-sided";
  }
}

TEST(Orientation, IsCoherentOnManifolds) {
  expect_orientable<1>(meshes::cycle(5));
  expect_orientable<2>(meshes::csaszar_torus());
  expect_orientable<2>(meshes::annulus());
  expect_orientable<3>(meshes::grid_torus(3));
  expect_orientable<3>(meshes::box(3, 3).simplices);
  expect_orientable<4>(meshes::complex_projective_plane());
  expect_orientable<5>(meshes::sphere(5));
  expect_orientable<6>(meshes::sphere(6));
  expect_orientable<2>(meshes::disjoint_union(meshes::csaszar_torus(), meshes::sphere(2)), 2);
}

TEST(Orientation, NonOrientableWithAOneSidedWalk) {
  expect_one_sided<2>(meshes::moebius_strip());
  expect_one_sided<2>(meshes::klein_bottle());
  expect_one_sided<2>(meshes::projective_plane());
  expect_one_sided<3>(meshes::product(meshes::projective_plane(), meshes::path(1)));
  expect_one_sided<3>(meshes::product(meshes::klein_bottle(), meshes::path(2)));
  expect_one_sided<3>(meshes::cone(meshes::moebius_strip()));
  expect_one_sided<4>(meshes::product(meshes::moebius_strip(), meshes::csaszar_torus()));
  expect_one_sided<2>(meshes::disjoint_union(meshes::csaszar_torus(), meshes::klein_bottle()));
}

TEST(Orientation, SimplicesThatMeetOnlyInSmallerFacesOrInThreesAreFree) {
  const SimplicialComplex<2> bow_tie(SimplexList{{1, 0, 2}, {0, 3, 4}});
  EXPECT_EQ(facet_components(bow_tie).count, 2);
  EXPECT_EQ(bow_tie.component_count(), 1);
  EXPECT_EQ(bow_tie.sign(2, 0), -1);
  EXPECT_EQ(bow_tie.sign(2, 1), 1);
  const SimplicialComplex<2> book(SimplexList{{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});  // three pages
  EXPECT_EQ(facet_components(book).count, 3);
  EXPECT_TRUE(book.is_orientable());
}

/// The orientation by breadth-first search, top simplex by top simplex: what `coherent_orientation` must agree with.
struct Searched : Orientation {
  FacetComponents components;
};
template <int n>
Searched searched_orientation(const SimplicialComplex<n>& K, const std::vector<Sign>& preferred) {
  const FacetCofaces dual = facet_cofaces(K);
  Searched result;
  result.sign.assign(preferred.size(), 0);
  result.components.of_top.assign(preferred.size(), 0);
  for (Index root = 0; root < K.size(n); ++root) {
    if (result.sign[static_cast<std::size_t>(root)] != 0) continue;
    result.sign[static_cast<std::size_t>(root)] = preferred[static_cast<std::size_t>(root)];
    std::vector<Index> queue{root};
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index t = queue[head];
      result.components.of_top[static_cast<std::size_t>(t)] = result.components.count;
      for (int i = 0; i <= n; ++i) {
        const auto facet = static_cast<std::size_t>(K.face_opposite(n, t, i));
        if (dual.count[facet] != 2) continue;
        const Index u = dual.first[facet] == t ? dual.second[facet] : dual.first[facet];
        int j = 0;
        while (K.face_opposite(n, u, j) != static_cast<Index>(facet)) ++j;
        const Sign needed = static_cast<Sign>(-result.sign[static_cast<std::size_t>(t)] * face_sign(i) * face_sign(j));
        Sign& sign = result.sign[static_cast<std::size_t>(u)];
        if (sign == 0) queue.push_back(u);
        if (sign == -needed) result.orientable = false;
        if (sign == 0) sign = needed;
      }
    }
    ++result.components.count;
  }
  if (!result.orientable) std::ranges::fill(result.sign, Sign{1});
  if (result.components.count <= 1) result.components.of_top.clear();
  return result;
}

template <int n>
void expect_as_searched(const SimplexList& rows, support::Random& random) {
  const SimplicialComplex<n> K(rows);
  std::vector<Sign> preferred(static_cast<std::size_t>(K.size(n)));
  for (Sign& sign : preferred) sign = support::uniform(random, 0, 1) == 0 ? Sign{-1} : Sign{1};
  for (const auto& wish : {preferred, std::vector<Sign>(K.orientation().sign)}) {
    const Orientation found = coherent_orientation(K, wish);
    const Searched expected = searched_orientation(K, wish);
    ASSERT_EQ(found.orientable, expected.orientable);
    ASSERT_EQ(found.sign, expected.sign);
    const FacetComponents components = facet_components(K);
    ASSERT_EQ(components.count, expected.components.count);
    ASSERT_EQ(components.of_top, expected.components.of_top);
    ASSERT_EQ(found.one_sided.empty(), expected.orientable);
  }
}

template <int n>
void expect_random_as_searched() {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "n = " << n << ", seed " << seed);
    support::Random random(seed);
    expect_as_searched<n>(support::simplex_list(support::random_pure(n, random)), random);
    expect_as_searched<n>(support::simplex_list(support::random_components(n, 3, random)), random);
    expect_as_searched<n>(support::simplex_list(support::random_mixed(n, random)), random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Orientation, AgreesWithASearchOnRandomComplexes) {
  expect_random_as_searched<1>();
  expect_random_as_searched<2>();
  expect_random_as_searched<3>();
  expect_random_as_searched<4>();
  expect_random_as_searched<6>();
}

/// Enough simplices in random order that many trees arise and are joined in many batches.
TEST(Orientation, AgreesWithASearchOnLargerComplexes) {
  using namespace meshes;
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    expect_as_searched<2>(shuffled(box(2, 30).simplices, seed), random);
    expect_as_searched<3>(shuffled(box(3, 9).simplices, seed), random);
    expect_as_searched<3>(shuffled(disjoint_union(box(3, 5).simplices, grid_torus(3)), seed), random);
    expect_as_searched<3>(shuffled(product(klein_bottle(), path(20)), seed), random);
    expect_as_searched<4>(shuffled(box(4, 3).simplices, seed), random);
    expect_as_searched<3>(box(3, 9).simplices, random);
  }
}

TEST(Orientation, PointsArePositiveComponents) {
  const SimplicialComplex<0> K(SimplexList{{2}, {0}, {1}});
  EXPECT_EQ(facet_components(K).count, 3);
  EXPECT_EQ(K.at({2}), (SignedIndex{2, 1}));
}

TEST(Orientation, PreferredSignsDecideTheFreeSignOfEachComponent) {
  const SimplicialComplex<1> K(SimplexList{{0, 1}, {1, 2}, {3, 4}});
  EXPECT_EQ(coherent_orientation(K, std::vector<Sign>{-1, 1, 1}).sign, (std::vector<Sign>{-1, -1, 1}));
  EXPECT_EQ(coherent_orientation(K, std::vector<Sign>{1, -1, -1}).sign, (std::vector<Sign>{1, 1, -1}));
  EXPECT_THROW((void)coherent_orientation(K, std::vector<Sign>{1, 1}), InputError);
  EXPECT_THROW((void)coherent_orientation(K, std::vector<Sign>{1, 0, 1}), InputError);
}

TEST(OrientBy, ReversesTheComponentsOfNegativeTotalWeight) {
  SimplicialComplex<1> K(SimplexList{{0, 1}, {1, 2}, {3, 4}, {5, 6}, {6, 7}});
  K.orient_by(std::vector<double>{1, -3, 2, 1, -1});  // sums -2, 2, 0
  EXPECT_EQ(K.orientation().sign, (std::vector<Sign>{-1, -1, 1, 1, 1}));
  EXPECT_EQ(K.find({0, 1}).sign, -1);
  expect_coherent(K);
  K.orient_by(std::vector<double>{1, -3, 2, 1, -1});  // now all sums are positive or zero
  EXPECT_EQ(K.orientation().sign, (std::vector<Sign>{-1, -1, 1, 1, 1}));
  K.orient_by(std::vector<double>{0, 0, 0, 1, -1 - 1e-12});  // zero but for rounding
  EXPECT_EQ(K.orientation().sign, (std::vector<Sign>{-1, -1, 1, 1, 1}));
  EXPECT_THROW(K.orient_by(std::vector<double>{1, 2}), InputError);
}

TEST(OrientBy, LeavesANonOrientableComplexAlone) {
  SimplicialComplex<2> K(meshes::moebius_strip());
  K.orient_by(std::vector<double>(5, -1));
  EXPECT_EQ(K.orientation().sign, std::vector<Sign>(5, 1));
}

}  // namespace
}  // namespace derham
