#include "derham/boundary/matrix.hpp"
#include "derham/meshes/boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace derham {
namespace {

/// What a signed permutation does to every simplex of degree k: its index in the other complex and its sign there.
struct SignedPermutation {
  std::vector<Index> to;
  std::vector<Sign> sign;
};

template <int n>
SignedPermutation induced(const SimplicialComplex<n>& K, const SimplicialComplex<n>& L, const std::vector<Index>& name,
                          int k) {
  SignedPermutation result;
  std::vector<Index> image;
  std::vector<int> hits(static_cast<std::size_t>(L.size(k)), 0);
  for (Index i = 0; i < K.size(k); ++i) {
    image.clear();
    for (const Index v : K.simplex(k, i)) image.push_back(name[static_cast<std::size_t>(v)]);
    const SignedIndex found = L.at(image);
    result.to.push_back(found.index);
    result.sign.push_back(static_cast<Sign>(K.sign(k, i) * found.sign));
    ++hits[static_cast<std::size_t>(found.index)];
  }
  EXPECT_TRUE(std::ranges::all_of(hits, [](int count) { return count == 1; })) << "degree " << k;
  return result;
}

/// The number of rows of `a` that the signed permutations of rows and columns do not turn into rows of `b`.
Offset differing_rows(const SignMatrix& a, const SignMatrix& b, const SignedPermutation& rows,
                      const SignedPermutation& columns) {
  using Entry = std::pair<Index, int>;
  std::vector<Entry> moved, there;
  Offset differing = 0;
  for (std::size_t row = 0; row < rows.to.size(); ++row) {
    moved.clear();
    there.clear();
    for (auto e = static_cast<std::size_t>(a.offsets[row]); e < static_cast<std::size_t>(a.offsets[row + 1]); ++e) {
      const auto column = static_cast<std::size_t>(a.columns[e]);
      moved.emplace_back(columns.to[column], rows.sign[row] * columns.sign[column] * a.values[e]);
    }
    const auto other = static_cast<std::size_t>(rows.to[row]);
    for (auto e = static_cast<std::size_t>(b.offsets[other]); e < static_cast<std::size_t>(b.offsets[other + 1]); ++e)
      there.emplace_back(b.columns[e], b.values[e]);
    std::ranges::sort(moved);
    differing += moved != there;
  }
  return differing;
}

/// New names for the vertices, another order of the rows and of the vertices in each: the matrices are conjugated by
/// the signed permutations that this induces on simplices, in the top degree up to one sign for the component.
template <int n>
void expect_conjugated(const SimplexList& original, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Index> name(static_cast<std::size_t>(original.vertex_bound()));
  std::iota(name.begin(), name.end(), Index{0});
  std::ranges::shuffle(name, random);
  std::vector<Offset> order(static_cast<std::size_t>(original.size()));
  std::iota(order.begin(), order.end(), Offset{0});
  std::ranges::shuffle(order, random);
  SimplexList relabelled;
  std::vector<Index> row;
  for (const Offset i : order) {
    row.clear();
    for (const Index v : original[i]) row.push_back(name[static_cast<std::size_t>(v)]);
    std::ranges::shuffle(row, random);
    relabelled.push_back(row);
  }

  const SimplicialComplex<n> K(original), L(relabelled);
  SignedPermutation columns = induced(K, L, name, 0);
  for (int k = 0; k < n; ++k) {
    ASSERT_EQ(K.size(k + 1), L.size(k + 1));
    SignedPermutation rows = induced(K, L, name, k + 1);
    EXPECT_EQ(differing_rows(coboundary_matrix(K, k), coboundary_matrix(L, k), rows, columns), 0) << "degree " << k;
    columns = std::move(rows);
  }
  EXPECT_EQ(std::ranges::count(columns.sign, columns.sign.front()), static_cast<Offset>(K.size(n)));
}

TEST(Relabelling, ConjugatesTheMatricesBySignedPermutations) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    expect_conjugated<1>(meshes::box(1, 50).simplices, seed);
    expect_conjugated<2>(meshes::box(2, 10).simplices, seed);
    expect_conjugated<4>(meshes::box(4, 3).simplices, seed);
    expect_conjugated<5>(meshes::box(5, 2).simplices, seed);
    expect_conjugated<6>(meshes::box(6, 1).simplices, seed);
  }
}

TEST(Relabelling, OfAMillionVertices) {
  expect_conjugated<2>(meshes::box(2, 999).simplices, 1);
  expect_conjugated<3>(meshes::box(3, 45).simplices, 1);
}

}  // namespace
}  // namespace derham
