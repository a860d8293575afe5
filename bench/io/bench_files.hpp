#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/mesh_format.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace derham::bench {

/// A file to be read: what it is called in the report, its format, and what writes it.
struct BenchFile {
  std::string name, extension;
  MeshFormat format;
  bool is_surface;
  void (*write)(const std::string& path, const MeshData& mesh);
};

/// One file of every format and encoding.
[[nodiscard]] const std::vector<BenchFile>& bench_files();

/// About `simplices` tetrahedra of a box, and as many triangles of a torus; coordinates have all the digits of a double.
struct BenchMeshes {
  explicit BenchMeshes(std::int64_t simplices);
  MeshData solid, surface;
};

/// A new directory that holds one file at a time and is removed in the end.
class BenchDirectory {
 public:
  BenchDirectory();
  BenchDirectory(const BenchDirectory&) = delete;
  BenchDirectory& operator=(const BenchDirectory&) = delete;
  ~BenchDirectory();

  /// The paths of the file (tetgen: of the pair), which is written if it is not the one that is there.
  [[nodiscard]] std::vector<std::string> paths(const BenchFile& file, const BenchMeshes& meshes);

 private:
  void clear();
  std::filesystem::path path_;
  std::string present_;
};

}  // namespace derham::bench
