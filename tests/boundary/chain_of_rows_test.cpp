#include "derham/boundary/chain_of_rows.hpp"

#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace derham {
namespace {

std::vector<Index> all_of(const SimplexList& rows) {
  std::vector<Index> members(static_cast<std::size_t>(rows.size()));
  std::iota(members.begin(), members.end(), Index{0});
  return members;
}

TEST(ChainOfRows, IsOrientedAsWritten) {
  const SimplicialComplex<2> K(SimplexList{{0, 2, 1}, {1, 2, 3}});
  const SimplexList edges{{2, 1}, {0, 1}, {3, 2}};
  const auto c = chain_of_rows<1>(K, edges, all_of(edges));
  EXPECT_EQ(c({1, 2}), -1);
  EXPECT_EQ(c({0, 1}), 1);
  EXPECT_EQ(c({2, 3}), -1);
  EXPECT_EQ(c({0, 2}), 0);

  const std::array<Index, 3> twice{0, 0, 1};
  EXPECT_EQ(chain_of_rows<1>(K, edges, twice)({2, 1}), 2);

  const SimplexList tops{{0, 1, 2}, {1, 2, 3}};
  const auto top = chain_of_rows<2>(K, tops, all_of(tops));
  EXPECT_EQ(top.terms()[0].coefficient, -1) << "against the orientation of K, whose first row is (0, 2, 1)";
  EXPECT_EQ(top({1, 2, 3}), 1);

  const SimplexList vertices{{3}, {1}};
  EXPECT_EQ(chain_of_rows<0>(K, vertices, all_of(vertices))({3}), 1);
}

TEST(ChainOfRows, NamesTheRowThatIsWrong) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const auto row_of = [&](const SimplexList& rows, std::vector<Index> members) -> std::int64_t {
    try {
      (void)chain_of_rows<1>(K, rows, members);
    } catch (const InputError& error) {
      return error.row();
    }
    return -1;
  };
  const SimplexList rows{{0, 1}, {0, 3}, {0, 1, 2}};
  EXPECT_EQ(row_of(rows, {0, 1}), 1) << "no simplex of K";
  EXPECT_EQ(row_of(rows, {2, 0}), 2) << "a triangle";
  EXPECT_EQ(row_of(rows, {0, 7}), 7);
}

/// The triangles of a hemisphere of the boundary of a cube, oriented at random, made coherent.
TEST(Coherent, CancelsInsideAndLeavesTheRim) {
  const SimplicialComplex<3> K(meshes::box(3, 3).simplices);
  std::vector<Chain<3, 2>::Term> terms;
  for (Index f = 0; f < K.size(2); ++f) {
    bool bottom = true;
    for (const Index v : K.simplex(2, f)) bottom = bottom && v < 16;  // the 4 x 4 vertices with z = 0
    if (bottom) terms.push_back({f, f % 3 == 0 ? -2 : 5});
  }
  ASSERT_EQ(terms.size(), 18u);
  const auto surface = coherent(Chain<3, 2>(K, terms));
  EXPECT_EQ(surface.terms()[0].coefficient, terms[0].coefficient > 0 ? 1 : -1);
  const auto rim = boundary(surface);
  EXPECT_EQ(rim.terms().size(), 12u);
  for (const auto& term : rim.terms()) EXPECT_EQ(std::abs(term.coefficient), 1);
  EXPECT_EQ(coherent(surface), surface);
  EXPECT_EQ(coherent(rim).terms().size(), 12u);
  EXPECT_TRUE(boundary(coherent(rim)).is_zero());
  EXPECT_TRUE(coherent(Chain<3, 2>(K)).is_zero());
}

TEST(Coherent, RefusesWhatHasNoOrientation) {
  const SimplexList moebius = meshes::moebius_strip();
  const SimplicialComplex<2> K(moebius);
  EXPECT_THROW((void)coherent(chain_of_rows<2>(K, moebius, all_of(moebius))), TopologyError);
  const SimplexList book{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const SimplicialComplex<2> L(book);
  EXPECT_THROW((void)coherent(chain_of_rows<2>(L, book, all_of(book))), TopologyError);
}

TEST(Coherent, OfTopSimplicesIsTheFundamentalChain) {
  const SimplexList rows = meshes::sphere(3);
  const SimplicialComplex<3> K(rows);
  std::vector<Chain<3, 3>::Term> terms;
  for (Index t = 0; t < K.size(3); ++t) terms.push_back({t, t == 0 || t == 3 ? 1 : -1});
  EXPECT_EQ(coherent(Chain<3, 3>(K, terms)), fundamental_chain(K));
}

}  // namespace
}  // namespace derham
