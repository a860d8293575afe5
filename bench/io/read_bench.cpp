// Reading mesh files, beside reading the same bytes with fread.
#include "bench/io/bench_files.hpp"
#include "bench/support/measures.hpp"
#include "bench/support/program.hpp"
#include "derham/io/read_mesh.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace derham::bench {
namespace {

std::size_t total_size(const std::vector<std::string>& paths) {
  std::size_t bytes = 0;
  for (const auto& path : paths) bytes += std::filesystem::file_size(path);
  return bytes;
}

// Seconds to read the files into new memory and do nothing with them.
double fread_seconds(const std::vector<std::string>& paths) {
  const double start = processor_seconds();
  for (const auto& path : paths) {
    const auto size = std::filesystem::file_size(path);
    const auto bytes = std::make_unique_for_overwrite<char[]>(size);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (file == nullptr || std::fread(bytes.get(), 1, size, file.get()) != size)
      throw std::runtime_error("cannot read " + path);
    benchmark::DoNotOptimize(bytes.get()[size / 2]);
  }
  return processor_seconds() - start;
}

template <class T>
std::size_t size_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

// Bytes of the arrays of a mesh.
std::size_t size_of(const MeshData& mesh) {
  auto bytes = size_of(mesh.points) + size_of(mesh.corners) + size_of(mesh.vertex_tags) + size_of(mesh.row_tags) +
               mesh.simplices.vertices().size_bytes();
  for (const auto& list : mesh.lower) bytes += list.vertices().size_bytes();
  for (const auto& part : mesh.parts) bytes += size_of(part.members);
  for (const auto& field : mesh.fields) bytes += size_of(field.values);
  return bytes;
}

void read(benchmark::State& state, const BenchFile& file, const BenchMeshes& meshes, BenchDirectory& directory) {
  const auto paths = directory.paths(file, meshes);
  const auto expected = (file.is_surface ? meshes.surface : meshes.solid).simplices.size();
  const auto bytes = static_cast<double>(total_size(paths));
  for ([[maybe_unused]] auto iteration : state) {
    const double fread = fread_seconds(paths);
    const PeakMemory peak;
    const double start = processor_seconds();
    const MeshData mesh = read_mesh(paths.front(), file.format);
    const double seconds = processor_seconds() - start;
    const auto peak_bytes = static_cast<double>(peak.bytes());
    if (mesh.simplices.size() != expected) {
      state.SkipWithError("the file was read wrongly");
      return;
    }
    state.SetIterationTime(seconds);
    state.counters["MB"] = bytes / 1e6;
    state.counters["MB/s"] = bytes / 1e6 / seconds;
    state.counters["fread MB/s"] = bytes / 1e6 / fread;
    state.counters["fread"] = seconds / fread;
    state.counters["memory"] = peak_bytes / (bytes + static_cast<double>(size_of(mesh)));
  }
}

const Suite suite([](const Options& options) {
  static const BenchMeshes meshes(options.simplices);
  static BenchDirectory directory;
  for (const auto& file : bench_files())
    benchmark::RegisterBenchmark(file.name.c_str(),
                                 [&file](benchmark::State& state) { read(state, file, meshes, directory); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
});

}  // namespace
}  // namespace derham::bench
