#include "derham/boundary/rings.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace derham {
namespace {

template <int n>
bool share_a_facet(const SimplicialComplex<n>& K, Index s, Index t) {
  return std::ranges::any_of(K.faces(n, s),
                             [&](Index f) { return std::ranges::find(K.faces(n, t), f) != K.faces(n, t).end(); });
}

/// Every ring of K holds the star, consecutive members share facets, and its ends and closedness are right.
template <int n>
void expect_sound_rings(const SimplicialComplex<n>& K) {
  const Rings<n> rings(K);
  const Incidence star = incidence(K, n - 2, n);
  const FacetCofaces cofaces = facet_cofaces(K);
  std::vector<char> boundary(static_cast<std::size_t>(K.size(n - 2)), 0);
  for (Index f = 0; f < K.size(n - 1); ++f)
    if (cofaces.count[static_cast<std::size_t>(f)] == 1)
      for (const Index face : K.faces(n - 1, f)) boundary[static_cast<std::size_t>(face)] = 1;
  for (Index i = 0; i < K.size(n - 2); ++i) {
    const Ring ring = rings.ring(i);
    EXPECT_TRUE(rings.is_single_ring(i));
    EXPECT_EQ(ring.closed, !boundary[static_cast<std::size_t>(i)]);
    std::vector<Index> sorted = ring.tops;
    std::ranges::sort(sorted);
    EXPECT_TRUE(std::ranges::equal(sorted, star[i]));
    for (std::size_t s = 1; s < ring.tops.size(); ++s) EXPECT_TRUE(share_a_facet(K, ring.tops[s - 1], ring.tops[s]));
    if (ring.closed) {
      EXPECT_TRUE(share_a_facet(K, ring.tops.front(), ring.tops.back()));
      EXPECT_EQ(ring.tops.front(), sorted.front());
      EXPECT_LT(ring.tops[1], ring.tops.back());
    } else {
      EXPECT_LE(ring.tops.front(), ring.tops.back());
    }
  }
}

TEST(Rings, AreOrderedWalksAboutEverySimplex) {
  expect_sound_rings(SimplicialComplex<2>(meshes::box(2, 4).simplices));
  expect_sound_rings(SimplicialComplex<2>(meshes::klein_bottle()));
  expect_sound_rings(SimplicialComplex<3>(meshes::box(3, 3).simplices));
  expect_sound_rings(SimplicialComplex<3>(meshes::lens_space(3, 1)));
  expect_sound_rings(SimplicialComplex<4>(meshes::complex_projective_plane()));
  expect_sound_rings(SimplicialComplex<5>(meshes::sphere(5)));
  expect_sound_rings(SimplicialComplex<6>(meshes::sphere(6)));
}

TEST(Rings, OfOneTetAndOfAFan) {
  const SimplicialComplex<3> tet(SimplexList{{0, 1, 2, 3}});
  EXPECT_EQ(Rings<3>(tet).ring(0).tops, std::vector<Index>{0});
  EXPECT_FALSE(Rings<3>(tet).ring(0).closed);

  // Tets about the edge (0, 1), given out of order: 2-3, 4-5, 3-4. The ends are the tets 0 and 1.
  const SimplicialComplex<3> fan({{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 1, 3, 4}});
  const Ring ring = Rings<3>(fan).ring(fan.at({0, 1}).index);
  EXPECT_EQ(ring.tops, (std::vector<Index>{0, 2, 1}));
  EXPECT_FALSE(ring.closed);
}

TEST(Rings, RefuseWhatIsNoRing) {
  const SimplicialComplex<3> two_tets({{0, 1, 2, 3}, {0, 1, 4, 5}});
  const Rings<3> rings(two_tets);
  const Index edge = two_tets.at({0, 1}).index;
  EXPECT_FALSE(rings.is_single_ring(edge));
  EXPECT_EQ(rings.rings(edge).size(), 2U);
  EXPECT_THROW(static_cast<void>(rings.ring(edge)), TopologyError);
  EXPECT_THROW(static_cast<void>(rings.ring(-1)), InputError);
  EXPECT_THROW(static_cast<void>(rings.ring(two_tets.size(1))), InputError);

  // Two closed rings about one edge: a walk that only comes back to its start would accept them.
  const SimplicialComplex<3> rings_of_three(
      {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 2, 4}, {0, 1, 5, 6}, {0, 1, 6, 7}, {0, 1, 5, 7}});
  const auto both = Rings<3>(rings_of_three).rings(rings_of_three.at({0, 1}).index);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_TRUE(both[0].closed && both[1].closed);

  const SimplicialComplex<2> book({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  EXPECT_THROW(static_cast<void>(Rings<2>(book).ring(0)), TopologyError);
}

}  // namespace
}  // namespace derham
