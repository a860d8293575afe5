#include "derham/complex/incidence.hpp"

#include "derham/core/error.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace derham {
namespace {

/// incidence(k, m) for every pair against the search for subsets.
template <int n>
void expect_all_incidences(const support::Rows& rows) {
  const SimplicialComplex<n> K(support::simplex_list(rows));
  const reference::Complex R(n, rows);
  for (int k = 0; k <= n; ++k)
    for (int m = 0; m <= n; ++m) {
      const Incidence table = incidence(K, k, m);
      ASSERT_EQ(table.rows(), K.size(k));
      for (Index i = 0; i < K.size(k); ++i)
        ASSERT_EQ(std::vector<Index>(table[i].begin(), table[i].end()), R.incident(k, i, m))
            << "incidence(" << k << ", " << m << ") of simplex " << i;
    }
}

TEST(Incidence, EveryPairOfDimensionsOnRandomComplexes) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    expect_all_incidences<0>(support::random_pure(0, random));
    expect_all_incidences<1>(support::random_pure(1, random));
    expect_all_incidences<2>(support::random_pure(2, random));
    expect_all_incidences<3>(support::random_pure(3, random));
    expect_all_incidences<4>(support::random_pure(4, random));
    expect_all_incidences<3>(support::random_mixed(3, random));
    expect_all_incidences<6>({support::subset(7, 0, 7, random)});
  }
}

TEST(Incidence, DegreesOutOfRangeAreRefused) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  EXPECT_THROW((void)incidence(K, -1, 0), InputError);
  EXPECT_THROW((void)incidence(K, 0, 3), InputError);
}

}  // namespace
}  // namespace derham
