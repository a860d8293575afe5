#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "reference/reference_complex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace derham::support {

/// Whether the library's complex of `rows` is the reference's: lists, faces, signs, rows, purity, components, cofaces.
template <int n>
void expect_same_as_reference(const std::vector<std::vector<Index>>& rows) {
  SimplexList list;
  for (const auto& row : rows) list.push_back(row);
  const SimplicialComplex<n> K(list);
  const reference::Complex R(n, rows);

  Offset chi = 0;
  for (int k = 0; k <= n; ++k) {
    const auto& expected = R.list[static_cast<std::size_t>(k)];
    chi += (k % 2 == 0 ? 1 : -1) * static_cast<Offset>(expected.size());
    ASSERT_EQ(K.size(k), static_cast<Index>(expected.size())) << "degree " << k;
    for (Index i = 0; i < K.size(k); ++i) {
      const auto simplex = K.simplex(k, i);
      ASSERT_EQ(reference::Tuple(simplex.begin(), simplex.end()), expected[static_cast<std::size_t>(i)]);
      ASSERT_EQ(K.sign(k, i), R.sign(k, i)) << "degree " << k << ", simplex " << i;
      for (int j = 0; k >= 1 && j <= k; ++j) {  // position j of the face table omits vertex k-j
        const auto face = reference::without(expected[static_cast<std::size_t>(i)], static_cast<std::size_t>(k - j));
        ASSERT_EQ(K.faces(k, i)[static_cast<std::size_t>(j)], R.position[static_cast<std::size_t>(k) - 1].at(face));
        ASSERT_EQ(K.face_opposite(k, i, k - j), K.faces(k, i)[static_cast<std::size_t>(j)]);
      }
      ASSERT_TRUE(k == 0 || std::ranges::is_sorted(K.faces(k, i)) || n == 1);
    }
  }
  EXPECT_EQ(K.euler_characteristic(), chi);
  EXPECT_EQ(K.component_count(), R.components());

  for (std::size_t row = 0; row < rows.size(); ++row) {
    const RowTarget target = K.row_target(static_cast<Offset>(row));
    ASSERT_EQ(target.degree, static_cast<int>(rows[row].size()) - 1);
    ASSERT_EQ(target.index, R.find(rows[row]).first);
    ASSERT_EQ(K.at(rows[row]), (SignedIndex{R.find(rows[row]).first, static_cast<Sign>(R.find(rows[row]).second)}));
  }
  std::set<reference::Tuple> maximal;
  for (const RowTarget& m : K.maximal_lower()) {
    const auto simplex = K.simplex(m.degree, m.index);
    maximal.emplace(simplex.begin(), simplex.end());
  }
  EXPECT_EQ(maximal, R.maximal_lower());
  EXPECT_EQ(K.maximal_lower().size(), maximal.size());
  EXPECT_EQ(K.is_pure(), maximal.empty());

  EXPECT_EQ(K.is_orientable(), R.orientable);
  EXPECT_EQ(facet_components(K).count, R.sheets);
  const FacetCofaces dual = facet_cofaces(K);
  for (const auto& [facet, tops] : R.facet_cofaces()) {
    const auto f = static_cast<std::size_t>(R.find(facet).first);
    ASSERT_EQ(dual.count[f], static_cast<Index>(tops.size()));
    ASSERT_EQ(dual.first[f], tops[0]);
    ASSERT_EQ(dual.second[f], tops.size() > 1 ? tops[1] : -1);
  }
}

}  // namespace derham::support
