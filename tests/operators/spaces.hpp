#pragma once

#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"
#include "support/random_values.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

// Complexes with a metric, for the tests of operators.
namespace derham::test {

template <int n>
struct Space {
  explicit Space(const MeshData& mesh) : K(mesh.simplices), g(Geometry<n>::from_mesh(K, mesh)) {}
  Space(const MeshData& mesh, std::vector<double> squares)
      : K(mesh.simplices), g(Geometry<n>::from_squared_lengths(K, squares)) {}
  SimplicialComplex<n> K;
  Geometry<n> g;
};

/// A jittered box with shuffled vertices, so that representatives have both signs.
template <int n>
MeshData random_mesh(std::uint32_t seed, Index cells = n < 4 ? 3 : 2) {
  std::vector<Index> id;
  return shuffled(meshes::box(n, cells, {.jitter = 0.6 / n, .seed = seed}), seed, id);
}

/// The same with no right angle left, at the boundary either: no dual volume is zero.
template <int n>
MeshData generic_mesh(std::uint32_t seed, Index cells = n < 4 ? 3 : 2) {
  MeshData mesh = random_mesh<n>(seed, cells);
  const auto noise = support::random_values(static_cast<Offset>(mesh.points.size()), seed);
  for (std::size_t i = 0; i < noise.size(); ++i) mesh.points[i] += 0.02 * noise[i] / static_cast<double>(cells);
  return mesh;
}

/// The same complex in space of its dimension, in one dimension more, periodic, and with edge lengths only.
template <int n, class Body>
void for_each_space_of(const MeshData& mesh, Body&& body) {
  const Space<n> flat(mesh);
  body(flat);
  body(Space<n>(moved(mesh, n + 1, 1.5, 0.5, 2)));
  std::vector<Index> id;
  body(Space<n>(shuffled(meshes::periodic_box(n, 3, {.jitter = 0.4 / n}), 3, id)));
  body(Space<n>(mesh, squared_lengths(flat.K, flat.g)));
}

template <int n, class Body>
void for_each_space(Body&& body) {
  for_each_space_of<n>(random_mesh<n>(1), body);
}

/// Calls body.template operator()<k>() for k = 0, …, last.
template <int last, class Body>
void for_each_degree(Body&& body) {
  [&]<int... k>(std::integer_sequence<int, k...>) {
    (body.template operator()<k>(), ...);
  }(std::make_integer_sequence<int, last + 1>{});
}

template <int n, int k>
PrimalForm<n, k> random_values_on(const SimplicialComplex<n>& K, std::uint64_t seed) {
  return PrimalForm<n, k>(K, support::random_values(K.size(k), seed));
}

using Dimensions = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                  std::integral_constant<int, 3>, std::integral_constant<int, 4>>;

}  // namespace derham::test
