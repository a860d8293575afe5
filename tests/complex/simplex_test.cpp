#include "derham/complex/simplex.hpp"
#include "derham/complex/simplex_list.hpp"
#include "derham/core/error.hpp"

#include <gtest/gtest.h>

namespace derham {
namespace {

TEST(Simplex, SortReturnsTheSignOfThePermutation) {
  Tuple<2> even{2, 0, 1}, odd{1, 0, 2}, repeated{4, 1, 4};
  EXPECT_EQ(sort_with_sign(even), 1);
  EXPECT_EQ(even, (Tuple<2>{0, 1, 2}));
  EXPECT_EQ(sort_with_sign(odd), -1);
  EXPECT_EQ(sort_with_sign(repeated), 0);
}

TEST(SimplexList, KeepsRowsOfMixedDimension) {
  const SimplexList rows{{0, 1, 2}, {3, 4}, {5}};
  EXPECT_EQ(rows.size(), 3);
  EXPECT_EQ(rows.dimension(), 2);
  EXPECT_FALSE(rows.is_uniform());
  EXPECT_EQ(rows[1].size(), 2u);
  EXPECT_EQ(rows[2][0], 5);
  EXPECT_EQ(rows.vertex_bound(), 6);
  EXPECT_THROW(SimplexList(2, {0, 1}), InputError);
}

}  // namespace
}  // namespace derham
