#include "derham/complex/subcomplex.hpp"

#include "derham/complex/cofaces.hpp"  // both in one program

#include <gtest/gtest.h>

#include <algorithm>

namespace derham {
namespace {

/// Stars, closures and links straight from their definitions, looking at all simplices.
template <int n>
struct Definition {
  const SimplicialComplex<n>& K;

  [[nodiscard]] bool is_face(int k, Index i, int m, Index j) const {
    return k <= m && std::ranges::includes(K.simplex(m, j), K.simplex(k, i));
  }
  template <class Keep>
  [[nodiscard]] SimplexSet<n> filter(Keep keep) const {
    SimplexSet<n> set;
    for (int k = 0; k <= n; ++k)
      for (Index i = 0; i < K.size(k); ++i)
        if (keep(k, i)) set.indices[static_cast<std::size_t>(k)].push_back(i);
    return set;
  }
  template <class Relation>
  [[nodiscard]] bool any(const SimplexSet<n>& set, Relation relation) const {
    for (int k = 0; k <= n; ++k)
      for (const Index i : set.indices[static_cast<std::size_t>(k)])
        if (relation(k, i)) return true;
    return false;
  }
  [[nodiscard]] SimplexSet<n> closure(const SimplexSet<n>& set) const {
    return filter([&](int k, Index i) { return any(set, [&](int m, Index j) { return is_face(k, i, m, j); }); });
  }
  [[nodiscard]] SimplexSet<n> star(const SimplexSet<n>& set) const {
    return filter([&](int k, Index i) { return any(set, [&](int m, Index j) { return is_face(m, j, k, i); }); });
  }
  [[nodiscard]] SimplexSet<n> link(const SimplexSet<n>& set) const {
    const auto outer = closure(star(set)), inner = star(closure(set));
    return filter([&](int k, Index i) { return outer.contains(k, i) && !inner.contains(k, i); });
  }
};

template <int n>
void expect_definitions(const SimplicialComplex<n>& K) {
  const Definition<n> definition{K};
  const CofaceLists<n> cofaces(K);
  SimplexSet<n> several;
  for (int k = 0; k <= n; ++k) {
    for (Index i = 0; i < K.size(k); ++i) {
      const auto one = simplex_set<n>(k, i);
      EXPECT_EQ(closure(K, one), definition.closure(one));
      EXPECT_EQ(star(cofaces, one), definition.star(one));
      EXPECT_EQ(link(K, cofaces, one), definition.link(one));
    }
    if (K.size(k) > 0) several.indices[static_cast<std::size_t>(k)].push_back(K.size(k) / 2);
  }
  EXPECT_EQ(star(cofaces, several), definition.star(several));
  EXPECT_EQ(link(K, cofaces, several), definition.link(several));
}

TEST(SimplexSet, StarClosureAndLinkFollowTheirDefinitions) {
  expect_definitions(SimplicialComplex<0>(SimplexList{{0}, {1}}));
  expect_definitions(SimplicialComplex<2>(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}}));
  expect_definitions(SimplicialComplex<2>(SimplexList{{0, 1, 2}, {2, 3}, {4}}));
  expect_definitions(SimplicialComplex<3>(SimplexList{{0, 1, 2, 3}, {0, 1, 4, 5}, {1, 2, 3, 4}, {4, 5, 2, 3}}));
}

TEST(SimplexSet, RefusesSimplicesThatAreNotThere) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const CofaceLists<2> cofaces(K);
  EXPECT_THROW((void)simplex_set<2>(3, 0), InputError);
  EXPECT_THROW((void)simplex_set<2>(-1, 0), InputError);
  for (const Index i : {-1, 2, 100000000}) EXPECT_THROW((void)closure(K, simplex_set<2>(2, i)), InputError);
  for (const Index i : {-1, 5}) {
    EXPECT_THROW((void)closure(K, simplex_set<2>(1, i)), InputError);
    EXPECT_THROW((void)star(cofaces, simplex_set<2>(1, i)), InputError);
    EXPECT_THROW((void)link(K, cofaces, simplex_set<2>(1, i)), InputError);
  }
}

TEST(SimplexSet, BoundarySimplicesOfTwoTetrahedra) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}});
  const auto rim = boundary_simplices(K);
  EXPECT_EQ(rim.size(0), 5);
  EXPECT_EQ(rim.size(1), 9);
  EXPECT_EQ(rim.size(2), 6);
  EXPECT_EQ(rim.size(3), 0);
  EXPECT_FALSE(rim.contains(2, K.at({1, 2, 3}).index));
}

}  // namespace
}  // namespace derham
