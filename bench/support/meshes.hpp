#pragma once

#include "bench/support/program.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace derham::bench {

/// A mesh and the order it is in: "natural" (of the generator or the file) or "shuffled", of surfaces "natural triangles" or
/// "shuffled triangles".
struct BenchMesh {
  std::string order;
  MeshData data;
};

/// A box of about `simplices` jittered tetrahedra in the order of the generator.
[[nodiscard]] MeshData box_of(std::int64_t simplices);

/// A torus of about `simplices` triangles in the order of the generator.
[[nodiscard]] MeshData torus_of(std::int64_t simplices);

/// The same simplices and positions with vertices renumbered and rows reordered at random; the order of the vertices in
/// a row stays. What belongs to the vertices and rows beside positions is left out. The same seed gives the same mesh.
[[nodiscard]] MeshData shuffled(const MeshData& mesh, std::uint64_t seed = 1);

/// The tetrahedra that the options ask for, natural and shuffled; none if the file they name holds something else. Made
/// at the first call.
[[nodiscard]] const std::vector<BenchMesh>& solids(const Options& options);

/// The same for triangles: 1.3 times as many, so 1.3M where solids have 1M.
[[nodiscard]] const std::vector<BenchMesh>& surfaces(const Options& options);

/// Writes them all to the folder options.save as "natural.npz", "shuffled triangles.npz" …
void save_meshes(const Options& options);

/// The complex of one of these meshes, built at the first call.
template <int n>
[[nodiscard]] const SimplicialComplex<n>& complex_of(const BenchMesh& mesh) {
  static std::map<const BenchMesh*, SimplicialComplex<n>> built;
  const auto place = built.find(&mesh);
  if (place != built.end()) return place->second;
  return built.emplace(&mesh, SimplicialComplex<n>(mesh.data.simplices, mesh.data.vertex_count)).first->second;
}

}  // namespace derham::bench
