#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

// What may be done to a mesh without changing its metric but for scale; for the tests of geometry, dual and hodge.
namespace derham::test {

/// One simplex with the given points of R^m.
inline MeshData single(std::vector<double> points, int m) {
  MeshData mesh;
  mesh.vertex_count = static_cast<Index>(points.size()) / m;
  mesh.ambient_dimension = m;
  mesh.points = std::move(points);
  std::vector<Index> row(static_cast<std::size_t>(mesh.vertex_count));
  std::iota(row.begin(), row.end(), 0);
  mesh.simplices.push_back(row);
  return mesh;
}

/// x -> scale * Q x + shift with random Q: R^m -> R^M, Q^T Q = 1, and a random shift of that size.
inline MeshData moved(MeshData mesh, int M, double scale, double shift, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const int m = mesh.ambient_dimension;
  std::vector<std::vector<double>> q(m, std::vector<double>(M));
  for (int i = 0; i < m; ++i) {
    for (double& x : q[i]) x = normal(random);
    for (int pass = 0; pass < 2; ++pass)
      for (int j = 0; j < i; ++j) {
        const double dot = std::inner_product(q[i].begin(), q[i].end(), q[j].begin(), 0.0);
        for (int c = 0; c < M; ++c) q[i][c] -= dot * q[j][c];
      }
    const double length = std::sqrt(std::inner_product(q[i].begin(), q[i].end(), q[i].begin(), 0.0));
    for (double& x : q[i]) x /= length;
  }
  std::vector<double> offset(M);
  for (double& x : offset) x = shift * normal(random);
  const auto apply = [&](std::vector<double>& x) {
    std::vector<double> y;
    for (std::size_t p = 0; p < x.size(); p += m)
      for (int c = 0; c < M; ++c) {
        double sum = offset[c];
        for (int i = 0; i < m; ++i) sum += scale * x[p + i] * q[i][c];
        y.push_back(sum);
      }
    x = std::move(y);
  };
  apply(mesh.points);
  apply(mesh.corners);
  mesh.ambient_dimension = M;
  return mesh;
}

/// The same mesh with vertex ids permuted and the vertices of every row shuffled; `id` receives the new id of each.
inline MeshData shuffled(const MeshData& mesh, std::uint32_t seed, std::vector<Index>& id) {
  std::mt19937 random(seed);
  const std::size_t m = mesh.ambient_dimension;
  id.resize(mesh.vertex_count);
  std::iota(id.begin(), id.end(), 0);
  std::shuffle(id.begin(), id.end(), random);
  MeshData result;
  result.vertex_count = mesh.vertex_count;
  result.ambient_dimension = mesh.ambient_dimension;
  result.points.resize(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) result.points[id[i / m] * m + i % m] = mesh.points[i];
  for (Offset row = 0; row < mesh.simplices.size(); ++row) {
    const auto old = mesh.simplices[row];
    std::vector<std::size_t> order(old.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Index> fresh;
    for (const std::size_t i : order) {
      fresh.push_back(id[old[i]]);
      if (mesh.has_corners())
        for (std::size_t c = 0; c < m; ++c) result.corners.push_back(mesh.corners[(row * old.size() + i) * m + c]);
    }
    result.simplices.push_back(fresh);
  }
  return result;
}

}  // namespace derham::test
