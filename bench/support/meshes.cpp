#include "bench/support/meshes.hpp"

#include "derham/io/read_mesh.hpp"
#include "derham/io/write_mesh.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/tori.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <utility>

namespace derham::bench {
namespace {

// std::shuffle draws differently with every library.
std::vector<Index> random_permutation(Offset size, std::mt19937_64& random) {
  std::vector<Index> places(static_cast<std::size_t>(size));
  std::iota(places.begin(), places.end(), Index{0});
  for (std::size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random() % i]);
  return places;
}

std::vector<BenchMesh> both_orders(MeshData natural) {
  const std::string kind = natural.simplices.dimension() == 2 ? " triangles" : "";
  MeshData other = shuffled(natural);
  return {{"natural" + kind, std::move(natural)}, {"shuffled" + kind, std::move(other)}};
}

/// The file if its simplices have this dimension.
std::vector<BenchMesh> from_file(const std::string& path, int dimension) {
  MeshData mesh = read_mesh(path);
  if (mesh.simplices.dimension() != dimension || !mesh.simplices.is_uniform()) return {};
  return both_orders(std::move(mesh));
}

}  // namespace

MeshData box_of(std::int64_t simplices) {
  const auto cells = std::lround(std::cbrt(static_cast<double>(simplices) / 6));
  return meshes::box(3, static_cast<Index>(std::max(1L, cells)), {.lengths = {}, .jitter = 0.2, .seed = 1});
}

MeshData torus_of(std::int64_t simplices) {
  const auto sides = static_cast<Index>(std::max(3L, std::lround(std::sqrt(static_cast<double>(simplices) / 4))));
  return meshes::torus(2 * sides, sides);
}

MeshData shuffled(const MeshData& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto new_vertex = random_permutation(mesh.vertex_count, random);
  const auto new_row = random_permutation(mesh.simplices.size(), random);

  MeshData result;
  result.vertex_count = mesh.vertex_count;
  result.ambient_dimension = mesh.ambient_dimension;
  const auto width = static_cast<std::size_t>(mesh.simplices.dimension()) + 1;
  std::vector<Index> rows(new_row.size() * width);
  for (std::size_t i = 0; i < new_row.size(); ++i) {
    const auto row = mesh.simplices[static_cast<Offset>(i)];
    std::ranges::transform(row,
                           rows.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(new_row[i]) * width),
                           [&](Index v) { return new_vertex[static_cast<std::size_t>(v)]; });
  }
  result.simplices = SimplexList(mesh.simplices.dimension(), std::move(rows));

  // Whole rows of an array, each to its new place.
  const auto moved = [](std::span<const double> values, std::span<const Index> places) {
    std::vector<double> target(values.size());
    const std::size_t size = places.empty() ? 0 : values.size() / places.size();
    for (std::size_t i = 0; size > 0 && i < places.size(); ++i)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * size), size,
                  target.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(places[i]) * size));
    return target;
  };
  result.points = moved(mesh.points, new_vertex);
  result.corners = moved(mesh.corners, new_row);
  return result;
}

const std::vector<BenchMesh>& solids(const Options& options) {
  static const auto meshes = options.mesh.empty() ? both_orders(box_of(options.simplices)) : from_file(options.mesh, 3);
  return meshes;
}

const std::vector<BenchMesh>& surfaces(const Options& options) {
  static const auto meshes =
      options.mesh.empty() ? both_orders(torus_of(options.simplices * 13 / 10)) : from_file(options.mesh, 2);
  return meshes;
}

void save_meshes(const Options& options) {
  for (const auto* const meshes : {&solids(options), &surfaces(options)})
    for (const auto& mesh : *meshes) write_mesh(options.save + '/' + mesh.order + ".npz", mesh.data);
}

}  // namespace derham::bench
