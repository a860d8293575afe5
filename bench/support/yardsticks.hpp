#pragma once

#include "bench/support/kernel.hpp"

#include <cstdint>
#include <vector>

namespace derham::bench {

// What times are compared with, measured in the same run. Each is registered under its own name, from which
// bench/support/table.py makes the columns of ratios.

/// "copy": 256 MiB to another place, on as many threads; counted are the bytes read and the bytes written.
void add_copy();

/// "gather": the value of every vertex of every top simplex, y[i] = x[vertex i]; ids, values and results counted once.
void add_gather(const std::vector<BenchMesh>& meshes);

/// "radix sort": of the facets of every top simplex (4 per tetrahedron), as KeyList. One thread.
void add_radix_sort(const std::vector<BenchMesh>& meshes);

/// "set and map": the construction of tetrahedral complexes with ordered maps (SetAndMap), once. One thread.
void add_set_and_map(const std::vector<BenchMesh>& meshes);

/// Facets as numbers, (v0 |V| + v1) |V| + … of the sorted facet, with a payload that says where each came from.
struct KeyList {
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> payload;
  int bits = 0;  ///< of the largest key

  KeyList() = default;
  /// Empty if a key would need more than 64 bits.
  explicit KeyList(const MeshData& mesh);

  [[nodiscard]] bool empty() const noexcept { return keys.empty(); }
  /// Sorts by key, stably, digit by digit from the lowest; `scratch` has the same size and is overwritten.
  void sort(KeyList& scratch);
};

}  // namespace derham::bench
