#include "derham/core/bulk_array.hpp"
#include "derham/core/disjoint_sets.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/core/types.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <locale>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace derham {
namespace {

TEST(Types, BinomialsFollowPascalsTriangle) {
  for (int n = 0; n <= 30; ++n) {
    EXPECT_EQ(binomial(n, 0), 1);
    EXPECT_EQ(binomial(n, n), 1);
    EXPECT_EQ(binomial(n, -1), 0);
    EXPECT_EQ(binomial(n, n + 1), 0);
    for (int k = 1; k < n; ++k) EXPECT_EQ(binomial(n, k), binomial(n - 1, k - 1) + binomial(n - 1, k));
  }
}

TEST(BulkArrays, AreCopiedMovedAndShortened) {
  const std::vector<int> values{3, 1, 4, 1, 5};
  BulkArray<int> a{std::span<const int>(values)};
  const BulkArray<int> copy = a;
  a[0] = 7;
  EXPECT_EQ(copy[0], 3);
  BulkArray<int> moved = std::move(a);
  EXPECT_EQ(moved.size(), 5U);
  moved.shrink(9);  // never longer
  EXPECT_EQ(moved.size(), 5U);
  moved.shrink(2);
  EXPECT_EQ(std::vector<int>(moved.begin(), moved.end()), (std::vector<int>{7, 1}));
  moved = copy;
  EXPECT_TRUE(std::ranges::equal(moved, values));
  moved.shrink(0);
  EXPECT_TRUE(moved.empty());
  EXPECT_TRUE(BulkArray<int>(0).empty());
  EXPECT_THROW(BulkArray<int>(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

TEST(BulkArrays, KeepTheirFirstElementsWhenLargeOnesShrink) {
  constexpr std::size_t size = std::size_t{1} << 22;
  BulkArray<int> a(size);  // large enough for pages of its own
  for (std::size_t i = 0; i < 100'000; ++i) a[i] = static_cast<int>(i);
  a.shrink(100'000);
  bool same = true;
  for (std::size_t i = 0; i < a.size(); ++i) same = same && a[i] == static_cast<int>(i);
  EXPECT_TRUE(same);
}

TEST(Types, Factorials) {
  EXPECT_EQ(factorial(0), 1);
  for (int k = 1; k <= 20; ++k) EXPECT_EQ(factorial(k), k * factorial(k - 1));
  EXPECT_EQ(factorial(7), 5040);
}

TEST(Text, WritesItsPartsOneAfterTheOther) { EXPECT_EQ(text("row ", Offset{3}, ": ", 0.5, 'x'), "row 3: 0.5x"); }

// A locale that groups digits, as some programs set.
struct Grouping : std::numpunct<char> {
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
  char do_decimal_point() const override { return ','; }
};

TEST(Text, IsTheSameInEveryLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Grouping));
  const std::string written = text(1234567, " ", 0.5);
  std::locale::global(before);
  EXPECT_EQ(written, "1234567 0.5");
}

TEST(DisjointSets, JoinAndCount) {
  DisjointSets sets(6);
  EXPECT_EQ(sets.count(), 6);
  EXPECT_TRUE(sets.unite(4, 2));
  EXPECT_TRUE(sets.unite(5, 4));
  EXPECT_FALSE(sets.unite(2, 5));
  EXPECT_TRUE(sets.unite(0, 1));
  EXPECT_EQ(sets.count(), 3);
  EXPECT_EQ(sets.root(5), 2);
  EXPECT_EQ(sets.root(1), 0);
  EXPECT_EQ(sets.root(3), 3);
  sets.reset(2);
  EXPECT_EQ(sets.count(), 2);
  EXPECT_EQ(sets.root(1), 1);
}

TEST(Text, Tuples) {
  EXPECT_EQ(tuple_text(std::span<const Index>()), "()");
  const std::vector<Index> one{7}, three{3, -1, 9};
  EXPECT_EQ(tuple_text(std::span(one)), "(7)");
  EXPECT_EQ(tuple_text(std::span(three)), "(3, -1, 9)");
}

TEST(Errors, KindsAreStable) {
  EXPECT_STREQ(Error("x").kind(), "error");
  EXPECT_STREQ(InputError("x").kind(), "input");
  EXPECT_STREQ(TopologyError("x").kind(), "topology");
  EXPECT_STREQ(GeometryError("x").kind(), "geometry");
  EXPECT_STREQ(LimitError("x").kind(), "limit");
  EXPECT_STREQ(FileError(FileError::Action::read, "a", 1, "x").kind(), "read");
  EXPECT_STREQ(FileError(FileError::Action::write, "a", 1, "x").kind(), "write");
}

TEST(Errors, AreCaughtByTheirRootWithTheirKind) {
  try {
    throw InputError("row 4 is bad", 4);
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "row 4 is bad");
    EXPECT_STREQ(error.kind(), "input");
    EXPECT_EQ(dynamic_cast<const InputError&>(error).row(), 4);
  }
  EXPECT_EQ(InputError("no row").row(), -1);
}

TEST(Errors, FileErrorsSayWhere) {
  const FileError at_line(FileError::Action::read, "mesh.off", 12, "expected 3 numbers");
  EXPECT_STREQ(at_line.what(), "mesh.off:12: expected 3 numbers");
  EXPECT_EQ(at_line.path(), "mesh.off");
  EXPECT_EQ(at_line.line(), 12);
  EXPECT_EQ(at_line.action(), FileError::Action::read);
  EXPECT_STREQ(FileError(FileError::Action::write, "out.vtu", 0, "disk full").what(), "out.vtu: disk full");
}

}  // namespace
}  // namespace derham
