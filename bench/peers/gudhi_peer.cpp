// GUDHI: Simplex_tree with a number for every simplex, and the boundary tables of all degrees.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"

#include <gudhi/Simplex_tree.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace derham::bench {
namespace {

struct TreeOptions : Gudhi::Simplex_tree_options_fast_persistence {
  static const bool store_filtration = false;
};

/// The tree, and for every k-simplex the numbers of its k+1 faces.
struct Complex {
  Gudhi::Simplex_tree<TreeOptions> tree;
  std::vector<std::vector<std::uint32_t>> faces;

  explicit Complex(const MeshData& mesh) : faces(static_cast<std::size_t>(mesh.simplices.dimension()) + 1) {
    for (Index v = 0; v < mesh.vertex_count; ++v) tree.insert_simplex(std::array<int, 1>{static_cast<int>(v)});
    for (Offset t = 0; t < mesh.simplices.size(); ++t) tree.insert_simplex_and_subfaces(mesh.simplices[t]);
    std::vector<std::uint32_t> count(faces.size(), 0);
    for (const auto& simplex : tree.complex_simplex_range())
      tree.assign_key(simplex, count[static_cast<std::size_t>(tree.dimension(simplex))]++);
    for (std::size_t k = 1; k < faces.size(); ++k) faces[k].reserve(count[k] * (k + 1));
    for (const auto& simplex : tree.complex_simplex_range()) {
      auto& table = faces[static_cast<std::size_t>(tree.dimension(simplex))];
      for (const auto& face : tree.boundary_simplex_range(simplex)) table.push_back(tree.key(face));
    }
  }
};

Kernel construction(const BenchMesh& mesh) {
  const auto built = std::make_shared<std::optional<Complex>>();
  return {.run = [built, &mesh] { built->emplace(mesh.data); },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [built] { built->reset(); },
          .memory = true};
}

const Suite suite([](const Options& options) {
  add("construction: GUDHI", solids(options), construction, Runs::one_thread);
  add("construction: GUDHI", surfaces(options), construction, Runs::one_thread);
});

}  // namespace
}  // namespace derham::bench
