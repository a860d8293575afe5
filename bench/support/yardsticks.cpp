#include "bench/support/yardsticks.hpp"

#include "bench/support/set_and_map.hpp"
#include "derham/core/parallel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>

namespace derham::bench {

KeyList::KeyList(const MeshData& mesh) {
  const auto n = static_cast<std::size_t>(mesh.simplices.dimension());
  const auto vertices = static_cast<std::uint64_t>(mesh.vertex_count);
  const double largest = std::pow(static_cast<double>(vertices), static_cast<double>(n));
  if (largest >= std::ldexp(1.0, 64)) return;
  bits = static_cast<int>(std::ceil(std::log2(std::max(2.0, largest))));
  std::vector<Index> row;
  for (Offset t = 0; t < mesh.simplices.size(); ++t) {
    row.assign(mesh.simplices[t].begin(), mesh.simplices[t].end());
    std::ranges::sort(row);
    for (std::size_t omitted = n + 1; omitted-- > 0;) {
      std::uint64_t key = 0;
      for (std::size_t i = 0; i <= n; ++i)
        if (i != omitted) key = key * vertices + static_cast<std::uint64_t>(row[i]);
      payload.push_back(static_cast<std::uint32_t>(keys.size()));
      keys.push_back(key);
    }
  }
}

void KeyList::sort(KeyList& scratch) {
  constexpr int digit = 11;  // bits: counts of all values fit the first-level cache
  const int passes = (bits + digit - 1) / digit;
  const auto value = [](std::uint64_t key, int pass) { return (key >> (pass * digit)) & ((1U << digit) - 1); };
  std::vector<std::array<std::uint32_t, 1 << digit>> begin(static_cast<std::size_t>(passes));
  for (const auto key : keys)
    for (int pass = 0; pass < passes; ++pass) ++begin[static_cast<std::size_t>(pass)][value(key, pass)];
  for (int pass = 0; pass < passes; ++pass) {
    auto& place = begin[static_cast<std::size_t>(pass)];
    std::uint32_t sum = 0;
    for (auto& count : place) sum += std::exchange(count, sum);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const auto to = place[value(keys[i], pass)]++;
      scratch.keys[to] = keys[i];
      scratch.payload[to] = payload[i];
    }
    std::swap(keys, scratch.keys);
    std::swap(payload, scratch.payload);
  }
}

void add_copy() {
  constexpr Offset size = Offset{1} << 25, block = Offset{1} << 18;
  add("copy", [] {
    static const std::vector<double> source(static_cast<std::size_t>(size), 1.0);
    static std::vector<double> target(static_cast<std::size_t>(size));
    return Kernel{.run =
                      [] {
                        parallel_blocks(size, block, [](Offset first, Offset last) {
                          std::copy(source.begin() + first, source.begin() + last, target.begin() + first);
                        });
                        benchmark::ClobberMemory();
                      },
                  .items = static_cast<double>(size),
                  .bytes = 16.0 * static_cast<double>(size),
                  .reset = {}};
  });
}

void add_gather(const std::vector<BenchMesh>& meshes) {
  add("gather", meshes, [](const BenchMesh& mesh) {
    const auto ids = mesh.data.simplices.vertices();
    const auto x = std::make_shared<std::vector<double>>(static_cast<std::size_t>(mesh.data.vertex_count), 1.0);
    const auto y = std::make_shared<std::vector<double>>(ids.size(), 0.0);
    return Kernel{.run =
                      [=] {
                        parallel_blocks(static_cast<Offset>(ids.size()), 1 << 16, [&](Offset first, Offset last) {
                          const double* const from = x->data();
                          double* const to = y->data();
                          for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                            to[i] = from[ids[i]];
                        });
                        benchmark::ClobberMemory();
                      },
                  .items = static_cast<double>(mesh.data.simplices.size()),
                  .bytes = static_cast<double>(ids.size_bytes() + sizeof(double) * (x->size() + y->size())),
                  .reset = {}};
  });
}

void add_radix_sort(const std::vector<BenchMesh>& meshes) {
  static std::map<const BenchMesh*, KeyList> given;
  add(
      "radix sort", meshes,
      [](const BenchMesh& mesh) {
        const auto& keys = given.try_emplace(&mesh, mesh.data).first->second;
        const auto sorted = std::make_shared<KeyList>(keys), scratch = std::make_shared<KeyList>(keys);
        return Kernel{.run = [=] { sorted->sort(*scratch); },
                      .items = static_cast<double>(keys.empty() ? 0 : mesh.data.simplices.size()),
                      .bytes = 0,
                      .reset = [=, &keys] { *sorted = keys; }};
      },
      Runs::one_thread);
}

void add_set_and_map(const std::vector<BenchMesh>& meshes) {
  add(
      "set and map", meshes,
      [](const BenchMesh& mesh) {
        const auto built = std::make_shared<std::optional<SetAndMap<3>>>();
        return Kernel{.run = [built, &mesh] { built->emplace(mesh.data.simplices); },
                      .items = static_cast<double>(mesh.data.simplices.size()),
                      .bytes = 0,
                      .reset = [built] { built->reset(); },
                      .memory = true};
      },
      Runs::once);
}

}  // namespace derham::bench
