#include "derham/forms/carried_form.hpp"

#include "derham/forms/exterior_derivative.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace derham {
namespace {

Renumbering random_renumbering(const SimplexList& rows, std::mt19937& random) {
  Renumbering r;
  r.new_vertex.resize(static_cast<std::size_t>(rows.vertex_bound()));
  r.old_row.resize(static_cast<std::size_t>(rows.size()));
  std::iota(r.new_vertex.begin(), r.new_vertex.end(), Index{0});
  std::iota(r.old_row.begin(), r.old_row.end(), Index{0});
  std::shuffle(r.new_vertex.begin(), r.new_vertex.end(), random);
  std::shuffle(r.old_row.begin(), r.old_row.end(), random);
  return r;
}

/// Whole numbers, so that sums are exact in any order.
template <int n, int k, Side side>
Form<n, k, side> random_form(const SimplicialComplex<n>& K, std::mt19937& random) {
  Form<n, k, side> form(K);
  for (double& value : form.values()) value = std::uniform_int_distribution(-50, 50)(random);
  return form;
}

template <int n, int k, Side side>
void expect_law(const SimplicialComplex<n>& K, const SimplicialComplex<n>& L, const Renumbering& r,
                std::mt19937& random) {
  const auto form = random_form<n, k, side>(K, random);
  const auto moved = carried(form, L, r);
  EXPECT_EQ(carried_back(moved, K, r), form);
  if constexpr (k < n) {
    EXPECT_EQ(carried(d(form), L, r), d(moved));
  }
}

template <int n>
void expect_laws(const SimplexList& rows) {
  std::mt19937 random(5);
  for (int round = 0; round < 5; ++round) {
    SCOPED_TRACE(round);
    const Renumbering r = random_renumbering(rows, random);
    const SimplicialComplex<n> K(rows);
    SimplicialComplex<n> L(renumbered(rows, r));
    expect_law<n, 0, Side::primal>(K, L, r, random);
    expect_law<n, 1, Side::primal>(K, L, r, random);
    expect_law<n, n - 1, Side::primal>(K, L, r, random);
    expect_law<n, n, Side::primal>(K, L, r, random);
    if (!K.is_orientable()) continue;
    orient_as(L, K, r);
    expect_law<n, n - 1, Side::primal>(K, L, r, random);
    expect_law<n, 0, Side::dual>(K, L, r, random);
    expect_law<n, 1, Side::dual>(K, L, r, random);
    expect_law<n, n, Side::dual>(K, L, r, random);
  }
}

TEST(CarriedForm, DerivativesCommuteWithRenumbering) {
  expect_laws<2>(meshes::box(2, 4).simplices);
  expect_laws<2>(meshes::klein_bottle());
  expect_laws<3>(meshes::box(3, 2).simplices);
  expect_laws<3>(meshes::disjoint_union(meshes::grid_torus(3), meshes::sphere(3)));
  expect_laws<4>(meshes::complex_projective_plane());
}

}  // namespace
}  // namespace derham
