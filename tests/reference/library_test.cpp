// The library against the reference: matrices bit for bit, volumes of well-shaped meshes to 1e-12, of random Delaunay
// meshes within what their conditioning allows.
#include "derham/boundary/matrix.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/polytopes.hpp"
#include "reference/reference_complex.hpp"
#include "reference/reference_geometry.hpp"
#include "support/delaunay.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace derham {
namespace {

using reference::Complex;

Complex::Matrix entries(const SignMatrix& matrix) {
  Complex::Matrix result;
  for (Index row = 0; row < matrix.rows; ++row)
    for (Offset i = matrix.offsets[static_cast<std::size_t>(row)];
         i < matrix.offsets[static_cast<std::size_t>(row) + 1]; ++i)
      result[{row, matrix.columns[static_cast<std::size_t>(i)]}] += matrix.values[static_cast<std::size_t>(i)];
  return result;
}

template <int n>
void expect_same_matrices(const support::Rows& rows) {
  const SimplicialComplex<n> K(support::simplex_list(rows));
  const Complex R(n, rows);
  for (int k = 1; k <= n; ++k) {
    const SignMatrix boundary = boundary_matrix(K, k);
    EXPECT_EQ(boundary.rows, K.size(k - 1));
    EXPECT_EQ(boundary.cols, K.size(k));
    ASSERT_EQ(entries(boundary), R.boundary(k)) << "degree " << k;
  }
}

template <int n>
void expect_same_matrices_on_random_complexes() {
  for (unsigned seed = 0; seed < 15; ++seed) {
    SCOPED_TRACE(testing::Message() << "n = " << n << ", seed " << seed);
    support::Random random(seed);
    expect_same_matrices<n>(support::random_pure(n, random));
    expect_same_matrices<n>(support::random_mixed(n, random));
  }
}

TEST(LibraryAgainstReference, BoundaryMatrices) {
  expect_same_matrices_on_random_complexes<1>();
  expect_same_matrices_on_random_complexes<2>();
  expect_same_matrices_on_random_complexes<3>();
  expect_same_matrices_on_random_complexes<4>();
  expect_same_matrices_on_random_complexes<5>();
  expect_same_matrices_on_random_complexes<6>();
  expect_same_matrices<3>(reference::tuples(meshes::grid_torus(3)));
  expect_same_matrices<4>(reference::tuples(meshes::complex_projective_plane()));
}

struct Errors {
  double condition = 0;  // of the worst simplex of any degree
  double primal = 0;     // largest relative error of a volume
  double dual = 0;       // largest error of a dual volume relative to its scale
};

template <int n>
Errors volume_errors(const support::PointMesh& mesh) {
  SimplicialComplex<n> K(support::simplex_list(mesh.rows));
  const auto geometry = Geometry<n>::from_points(K, mesh.points, mesh.m);
  const ByDegree<n> primal = primal_volumes(K, geometry), dual = dual_volumes(K, geometry);
  const reference::Geometry exact(Complex(n, mesh.rows), mesh.exact_points());
  Errors errors{.condition = exact.worst_condition.get_d()};
  const auto error = [](double value, const reference::Real& expected, const reference::Real& scale) {
    const reference::Real relative = abs(value - expected) / scale;
    return std::isfinite(value) ? relative.get_d() : std::numeric_limits<double>::infinity();
  };
  for (std::size_t k = 0; k <= n; ++k)
    for (std::size_t i = 0; i < primal[k].size(); ++i) {
      errors.primal = std::max(errors.primal, error(primal[k][i], exact.primal[k][i], exact.primal[k][i]));
      errors.dual = std::max(errors.dual, error(dual[k][i], exact.dual[k][i], exact.dual_scale[k][i]));
    }
  return errors;
}

template <int n>
void expect_well_shaped(const MeshData& mesh, unsigned seed) {
  support::Random random(seed);
  const support::PointMesh shuffled{support::reordered(reference::tuples(mesh.simplices), random), mesh.points,
                                    mesh.ambient_dimension};
  const Errors errors = volume_errors<n>(shuffled);
  std::cout << "well-shaped n = " << n << " in R^" << mesh.ambient_dimension << ": condition " << errors.condition
            << ", error of volumes " << errors.primal << ", of dual volumes " << errors.dual << '\n';
  EXPECT_LT(errors.primal, 1e-12);
  EXPECT_LT(errors.dual, 1e-12);
}

TEST(LibraryAgainstReference, VolumesOfWellShapedMeshes) {
  expect_well_shaped<1>(meshes::box(1, 20, {.jitter = 0.5}), 1);
  expect_well_shaped<2>(meshes::box(2, 6, {.jitter = 0.3}), 2);
  expect_well_shaped<3>(meshes::box(3, 3, {.jitter = 0.2}), 3);
  expect_well_shaped<4>(meshes::box(4, 2, {.jitter = 0.1}), 4);
  expect_well_shaped<2>(meshes::box(2, 4), 5);  // dual volumes that are exactly zero
  expect_well_shaped<2>(meshes::icosphere(2), 6);
  expect_well_shaped<3>(meshes::cell_600(), 7);
}

/// A backward stable computation is wrong by a few roundings times the condition of the worst simplex.
template <int n>
void expect_conditioned(int points) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "n = " << n << ", seed " << seed);
    support::Random random(seed);
    const support::PointMesh mesh = support::random_delaunay(n, points, random);
    const Errors errors = volume_errors<n>(mesh);
    const double bound = 4 * std::numeric_limits<double>::epsilon() * errors.condition;
    std::cout << "Delaunay n = " << n << ", " << mesh.rows.size() << " top simplices: condition " << errors.condition
              << ", error of volumes " << errors.primal << ", of dual volumes " << errors.dual << ", bound " << bound
              << '\n';
    EXPECT_LT(errors.primal, bound);
    EXPECT_LT(errors.dual, bound);
  }
}

TEST(LibraryAgainstReference, VolumesOfRandomDelaunayMeshes) {
  expect_conditioned<2>(40);
  expect_conditioned<3>(24);
  expect_conditioned<4>(14);
}

}  // namespace
}  // namespace derham
