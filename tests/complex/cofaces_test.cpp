#include "derham/complex/cofaces.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace derham {
namespace {

/// The sign of coface c over face i, read from the vertices: (-1)^v for the vertex number v of c that i lacks.
template <int n>
Sign relative_orientation(const SimplicialComplex<n>& K, int k, Index i, Index c) {
  const auto face = K.simplex(k, i), coface = K.simplex(k + 1, c);
  int v = 0;
  while (v <= k && face[static_cast<std::size_t>(v)] == coface[static_cast<std::size_t>(v)]) ++v;
  return face_sign(v);
}

template <int n>
void expect_cofaces_of(const support::Rows& rows) {
  const SimplicialComplex<n> K(support::simplex_list(rows));
  const reference::Complex R(n, rows);
  for (int k = 0; k < n; ++k) {
    const Cofaces cofaces(K, k);
    const Incidence table = incidence(K, k, k + 1);
    EXPECT_EQ(cofaces.degree(), k);
    ASSERT_EQ(cofaces.rows(), K.size(k));
    for (Index i = 0; i < K.size(k); ++i) {
      std::vector<Index> found;
      for (const auto [coface, sign] : cofaces[i]) {
        found.push_back(coface);
        ASSERT_EQ(sign, relative_orientation(K, k, i, coface))
            << "coface " << coface << " of " << k << "-simplex " << i;
      }
      ASSERT_EQ(found, R.incident(k, i, k + 1)) << k << "-simplex " << i;
      ASSERT_EQ(found, std::vector<Index>(table[i].begin(), table[i].end()));
      ASSERT_EQ(cofaces[i].size(), found.size());
    }
  }
}

TEST(Cofaces, OfEveryDegreeOnRandomComplexes) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    support::Random random(seed);
    expect_cofaces_of<1>(support::random_pure(1, random));
    expect_cofaces_of<2>(support::random_pure(2, random));
    expect_cofaces_of<3>(support::random_pure(3, random));
    expect_cofaces_of<4>(support::random_pure(4, random));
    expect_cofaces_of<3>(support::random_mixed(3, random));
    expect_cofaces_of<2>(support::random_rips(2, random));
    expect_cofaces_of<6>({support::subset(7, 0, 7, random)});
  }
}

TEST(Cofaces, StayWhenTheOrientationIsReversed) {
  SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  const Cofaces before(K, 1);
  K.orient_by(std::vector<double>{-1, K.sign(2, 1) * K.sign(2, 0) > 0 ? -1.0 : 1.0});
  ASSERT_LT(K.sign(2, 0), 0);
  const Cofaces after(K, 1);
  EXPECT_TRUE(std::ranges::equal(before.packed(), after.packed()));
}

TEST(Cofaces, OfTetrahedraAddLessThanSeventyBytesEach) {
  const SimplicialComplex<3> K(meshes::box(3, 10).simplices);
  std::size_t entries = 0;
  for (int k = 0; k < 3; ++k) {
    const Cofaces cofaces(K, k);
    entries += cofaces.offsets().size() + cofaces.packed().size();
  }
  EXPECT_LE(4 * entries, 70 * static_cast<std::size_t>(K.size(3)));
}

TEST(Cofaces, RefuseDegreesAndNumbersOutOfRange) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  EXPECT_THROW(Cofaces(K, -1), InputError);
  EXPECT_THROW(Cofaces(K, 2), InputError);
  EXPECT_THROW(Cofaces(SimplicialComplex<0>(SimplexList{{0}}), 0), InputError);
  EXPECT_NO_THROW(detail::require_cofaces_fit(100, 1, 100));
  EXPECT_THROW(detail::require_cofaces_fit(101, 1, 100), LimitError);
}

}  // namespace
}  // namespace derham
