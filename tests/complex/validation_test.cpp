// Every refusal names the first offending row and value.
#include "derham/complex/validation.hpp"

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <string>

namespace derham {
namespace {

constexpr Index largest = std::numeric_limits<Index>::max();

/// The complex of `rows` is refused at `row`, with a message that contains every one of `words`.
template <int n>
void expect_refused(const SimplexList& rows, Offset row, std::initializer_list<const char*> words,
                    Index vertex_count = -1) {
  try {
    const SimplicialComplex<n> K(rows, vertex_count);
    ADD_FAILURE() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.row(), row) << error.what();
    for (const char* word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " is not in: " << error.what();
  }
}

TEST(Validation, RepeatedVertex) {
  expect_refused<3>({{0, 1, 2, 3}, {4, 2, 4, 1}, {1, 1, 2, 0}}, 1, {"row 1", "(4, 2, 4, 1)", "vertex 4"});
  expect_refused<1>({{0, 0}}, 0, {"row 0", "vertex 0"});
  expect_refused<2>({{0, 1, 2}, {3, 3}}, 1, {"row 1", "(3, 3)", "vertex 3"});  // mixed dimensions
}

TEST(Validation, SameVertexSetTwiceInAnyOrder) {
  expect_refused<3>({{0, 1, 2, 3}, {1, 2, 3, 4}, {1, 0, 3, 2}}, 2, {"row 2", "(1, 0, 3, 2)", "row 0", "(0, 1, 2, 3)"});
  expect_refused<2>({{0, 1, 2}, {0, 1, 2}}, 1, {"row 1", "row 0"});
  expect_refused<1>({{0, 1}, {1, 2}, {2, 1}}, 2, {"row 2", "(2, 1)", "row 1"});
  expect_refused<0>({{0}, {1}, {0}}, 2, {"row 2", "(0)", "row 0"});
  expect_refused<6>({{0, 1, 2, 3, 4, 5, 6}, {6, 5, 4, 3, 2, 1, 0}}, 1, {"row 1", "row 0"});
  expect_refused<2>({{0, 1, 2}, {3, 1}, {1, 3}}, 2, {"row 2", "(1, 3)", "row 1"});  // mixed dimensions
  // far apart in a list that is otherwise sound
  SimplexList strip;
  for (Index v = 0; v < 5000; ++v) strip.push_back({v, v + 1, v + 2});
  strip.push_back({4002, 4000, 4001});
  expect_refused<2>(strip, 5000, {"row 5000", "(4002, 4000, 4001)", "row 4000"});
}

TEST(Validation, OfSeveralKindsTheFirstRow) {
  expect_refused<3>({{0, 1, 2, 3}, {1, 0, 3, 2}, {0, 0, 1, 2}}, 1, {"row 1", "row 0"});
  expect_refused<2>({{0, 1, 2}, {1, 1, 2}, {2, 1, 0}, {0, 1, -2}}, 1, {"row 1", "repeats vertex 1"});
  expect_refused<2>({{0, 1, 1}, {0, 1, -2}}, 0, {"row 0", "repeats vertex 1"});
  expect_refused<2>({{0, 1, -2}, {0, 1, 1}}, 0, {"row 0", "vertex -2"});
}

// A set would hide that the 8 triangles have only 4 vertex sets, and make a sphere of it.
TEST(Validation, PeriodicTorusOfTwoByTwoSquaresIsNoComplex) {
  SimplexList rows;
  const auto vertex = [](Index x, Index y) { return x % 2 + 2 * (y % 2); };
  for (Index y = 0; y < 2; ++y)
    for (Index x = 0; x < 2; ++x) {
      rows.push_back({vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1)});
      rows.push_back({vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
    }
  const InputReport report = check_input(rows);
  EXPECT_EQ(report.duplicates.size(), 4u);
  EXPECT_TRUE(report.repeats.empty());
  ASSERT_FALSE(report.duplicates.empty());
  expect_refused<2>(rows, report.duplicates[0].row, {"same vertices"});
}

TEST(Validation, IdsOutOfRange) {
  expect_refused<2>({{0, 1, 2}, {1, -7, 2}, {-1, 0, 1}}, 1, {"row 1", "(1, -7, 2)", "vertex -7"});
  expect_refused<2>({{-3, -1, -2}}, 0, {"row 0", "vertex -3"});
  expect_refused<0>({{-1}}, 0, {"vertex -1"});
  expect_refused<2>({{0, 1, 2}, {1, 2, 3}}, 1, {"row 1", "vertex 3", "less than 3"}, 3);
  expect_refused<2>({{0, 1, 2}}, 0, {"vertex 0", "less than 0"}, 0);
  expect_refused<1>({{0, 1}, {1, largest}}, 1, {"row 1", "vertex"});  // 1 + the id does not fit the index type
  expect_refused<1>({{0, std::numeric_limits<Index>::min()}}, 0, {"row 0"});
}

TEST(Validation, EveryVertexMustBeUsed) {
  expect_refused<2>({{0, 1, 3}, {1, 3, 4}}, 0, {"vertex 2", "row 0 is (0, 1, 3)"});
  expect_refused<2>({{1, 2, 3}}, 0, {"vertex 0"});  // a 1-based list
  expect_refused<2>({{0, 1, 2}, {1, 2, 3}}, -1, {"vertex 4", "2 are not"}, 6);
  expect_refused<2>({}, -1, {"vertices but no simplices"}, 5);
  // huge ids and counts must not be allocated for
  expect_refused<2>({{0, 1, 2}, {1, 2, 2000000000}}, 1, {"vertex 3", "row 1", "2000000000", "1999999997 are not"});
  expect_refused<2>({{0, 1, 2}}, -1, {"vertex 3", "1999999997 are not"}, 2000000000);
  expect_refused<2>({{0, 1, 2}, {5, 2000000000}}, 1, {"vertex 3"});  // mixed dimensions
}

TEST(Validation, WrongDimension) {
  expect_refused<2>({{0, 1, 2}, {0, 1, 2, 3}}, 1, {"row 1", "(0, 1, 2, 3)", "dimension 3", "dimension 2"});
  expect_refused<3>({{0, 1}, {0, 1, 2}, {1, 2, 3}}, 1, {"row 1", "(0, 1, 2)", "dimension 2", "dimension 3"});
  expect_refused<0>({{0}, {1, 2}}, 1, {"row 1"});
}

TEST(Validation, ReportListsEveryDefect) {
  const SimplexList rows{{0, 1, 2}, {2, 2, 1}, {2, 1, 0}, {-1, 3, 9}, {4, 5, 4}, {1, 0, 2}, {9, 9, 0}};
  const InputReport report = check_input(rows, 8);
  EXPECT_FALSE(report.ok());
  ASSERT_EQ(report.repeats.size(), 3u);
  EXPECT_EQ(report.repeats[0].row, 1);
  EXPECT_EQ(report.repeats[0].vertex, 2);
  EXPECT_EQ(report.repeats[1].row, 4);
  EXPECT_EQ(report.repeats[1].vertex, 4);
  EXPECT_EQ(report.repeats[2].row, 6);
  ASSERT_EQ(report.duplicates.size(), 2u);
  EXPECT_EQ(report.duplicates[0].row, 2);
  EXPECT_EQ(report.duplicates[0].first_row, 0);
  EXPECT_EQ(report.duplicates[1].row, 5);
  EXPECT_EQ(report.duplicates[1].first_row, 0);
  ASSERT_EQ(report.out_of_range.size(), 2u);
  EXPECT_EQ(report.out_of_range[0].row, 3);
  EXPECT_EQ(report.out_of_range[0].vertex, -1);
  EXPECT_EQ(report.out_of_range[1].row, 6);
  EXPECT_EQ(report.out_of_range[1].vertex, 9);
  EXPECT_EQ(report.first_unused, 6);
  EXPECT_EQ(report.unused, 2);

  EXPECT_TRUE(check_input({{0, 1, 2}, {1, 2, 3}}).ok());
  EXPECT_TRUE(check_input({}).ok());
  EXPECT_EQ(check_input({{0, 1}, {1, 4}}).first_unused, 2);
  EXPECT_EQ(check_input({{0, 1}}, 5).unused, 3);
  EXPECT_EQ(check_input({{-4, -2}}).unused, 0);
}

}  // namespace
}  // namespace derham
