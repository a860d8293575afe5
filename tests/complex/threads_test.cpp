// The same bits for any number of threads; run under ThreadSanitizer as well.
#include "derham/complex/cofaces.hpp"
#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace derham {
namespace {

class Threads : public testing::Test {
 protected:
  void TearDown() override { set_thread_count(before_); }

 private:
  int before_ = thread_count();
};

template <int n>
void expect_same(const SimplicialComplex<n>& A, const SimplicialComplex<n>& B, const SimplexList& rows) {
  for (int k = 0; k <= n; ++k) {
    ASSERT_TRUE(std::ranges::equal(A.simplices(k), B.simplices(k))) << "degree " << k;
    ASSERT_TRUE(k == 0 || std::ranges::equal(A.face_table(k), B.face_table(k))) << "degree " << k;
  }
  ASSERT_EQ(A.orientation().sign, B.orientation().sign);
  for (Offset row = 0; row < rows.size(); ++row) ASSERT_EQ(A.find(rows[row]), B.find(rows[row]));
}

template <int n>
void expect_same_for_any_number_of_threads(const SimplexList& rows) {
  support::Random random(1);
  const SimplexList input = support::simplex_list(support::shuffled(reference::tuples(rows), random));
  set_thread_count(1);
  const SimplicialComplex<n> serial(input);
  for (const int threads : {2, 4, 7}) {
    set_thread_count(threads);
    expect_same(serial, SimplicialComplex<n>(input), input);
  }
}

TEST_F(Threads, DoNotChangeTheComplex) {
  expect_same_for_any_number_of_threads<1>(meshes::box(1, 20000).simplices);
  expect_same_for_any_number_of_threads<2>(meshes::box(2, 90).simplices);
  expect_same_for_any_number_of_threads<3>(meshes::box(3, 18).simplices);
  expect_same_for_any_number_of_threads<4>(meshes::box(4, 6).simplices);
}

TEST_F(Threads, DoNotChangeTheTransposedTables) {
  support::Random random(1);
  const SimplicialComplex<3> K(
      support::simplex_list(support::shuffled(reference::tuples(meshes::box(3, 18).simplices), random)));
  for (int k = 0; k < 3; ++k) {
    set_thread_count(1);
    const Cofaces serial(K, k);
    const Incidence stars = incidence(K, k, 3);
    for (const int threads : {2, 4, 7, 20}) {
      set_thread_count(threads);
      const Cofaces parallel(K, k);
      ASSERT_TRUE(std::ranges::equal(parallel.offsets(), serial.offsets()));
      ASSERT_TRUE(std::ranges::equal(parallel.packed(), serial.packed()));
      ASSERT_EQ(incidence(K, k, 3).offsets, stars.offsets);
      ASSERT_EQ(incidence(K, k, 3).indices, stars.indices);
    }
  }
}

TEST_F(Threads, ADuplicateIsFoundWhicheverThreadMeetsIt) {
  SimplexList rows = meshes::box(3, 14).simplices;
  const auto row = rows[10000];
  rows.push_back({row[2], row[1], row[0], row[3]});
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    try {
      const SimplicialComplex<3> K(rows);
      ADD_FAILURE() << "was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.row(), rows.size() - 1) << error.what();
    }
  }
}

}  // namespace
}  // namespace derham
