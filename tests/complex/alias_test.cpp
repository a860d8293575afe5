// Any alias -> index and sign: S(t) = S(P) S(P(t)).
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace derham {
namespace {

/// Every order of every subset of the vertices, and of one vertex that does not exist: found or absent as the reference
/// says.
template <int n>
void expect_all_aliases(const support::Rows& rows) {
  const SimplicialComplex<n> K(support::simplex_list(rows));
  const reference::Complex R(n, rows);
  reference::Tuple vertices;
  for (Index v = 0; v <= K.size(0); ++v) vertices.push_back(v);
  for (reference::Tuple alias : reference::subsets(vertices)) {
    if (static_cast<int>(alias.size()) > n + 2) continue;
    do {
      const auto [index, sign] = R.find(alias);
      ASSERT_EQ(K.find(alias), (SignedIndex{index, static_cast<Sign>(sign)})) << testing::PrintToString(alias);
    } while (std::ranges::next_permutation(alias).found);
  }
}

TEST(Alias, EveryPermutationOfEverySimplexAndOfEveryAbsentTuple) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    const auto small = [&](int n, int vertices, int count) {
      support::Rows rows;
      for (int i = 0; i < count; ++i) rows.push_back(support::subset(n + 1, 0, vertices, random));
      return support::shuffled(rows, random);
    };
    expect_all_aliases<0>(small(0, 3, 4));
    expect_all_aliases<1>(small(1, 5, 5));
    expect_all_aliases<2>(small(2, 6, 7));
    expect_all_aliases<3>(small(3, 6, 6));
    expect_all_aliases<4>(small(4, 7, 6));
    expect_all_aliases<5>(small(5, 7, 3));
    expect_all_aliases<2>(support::random_mixed(2, random));
  }
  expect_all_aliases<6>({{4, 1, 0, 6, 5, 2, 3}});
}

TEST(Alias, WhatIsNoSimplexIsNotFound) {
  const SimplicialComplex<2> K(SimplexList{{0, 2, 1}, {1, 2, 3}});
  EXPECT_EQ(K.find({0, 3}), SignedIndex{});
  EXPECT_EQ(K.find({1, 1}), SignedIndex{});
  EXPECT_EQ(K.find({-1}), SignedIndex{});
  EXPECT_EQ(K.find({4}), SignedIndex{});
  EXPECT_EQ(K.find({3, 2, 2000000000}), SignedIndex{});
  EXPECT_EQ(K.find({0, 1, 2, 3}), SignedIndex{});
  EXPECT_EQ(K.find(std::span<const Index>()), SignedIndex{});
  EXPECT_FALSE(K.find({0, 3}));
}

TEST(Alias, AtNamesTheTupleThatIsMissing) {
  const SimplicialComplex<2> K(SimplexList{{0, 2, 1}, {1, 2, 3}});
  EXPECT_EQ(K.at({2, 1, 0}),
            (SignedIndex{0, 1}));  // the first input tuple is positive; this is an even reordering of it
  EXPECT_EQ(K.at({0, 1, 2}), (SignedIndex{0, -1}));
  try {
    (void)K.at({3, 0});
    FAIL() << "(3, 0) was found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("(3, 0)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace derham
