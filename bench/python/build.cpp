// The C++ half of bench/python_build.py: builds the complex of a tetrahedral mesh that lies in memory, once.
//
//   bench_python_build FOLDER THREADS      prints {"seconds": …, "peak": bytes}
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/parallel.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/mesh_data.hpp"
#include "derham/geometry/volumes.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace derham;

namespace {

template <class T>
std::vector<T> read_array(const std::filesystem::path& path) {
  const auto bytes = std::filesystem::file_size(path);
  std::vector<T> values(bytes / sizeof(T));
  std::ifstream(path, std::ios::binary)
      .read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(bytes));
  return values;
}

long long peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoll(line.substr(6));
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return EXIT_FAILURE;
  const std::filesystem::path folder = arguments[1];
  set_thread_count(std::stoi(arguments[2]));
  MeshData mesh;
  mesh.simplices = SimplexList(3, read_array<Index>(folder / "simplices"));
  mesh.points = read_array<double>(folder / "points");
  mesh.ambient_dimension = 3;
  mesh.vertex_count = static_cast<Index>(mesh.points.size() / 3);

  const auto start = std::chrono::steady_clock::now();
  SimplicialComplex<3> K(mesh.simplices, mesh.vertex_count);
  const auto geometry = Geometry<3>::from_mesh(K, mesh);
  orient_by_volume(K, geometry);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("{\"seconds\": %.6f, \"peak\": %lld}\n", elapsed.count(), peak_bytes());
}
