#include "bench/support/kernel.hpp"

#include "bench/support/measures.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <regex>
#include <set>
#include <thread>

#include <malloc.h>

// Known by name to scripts/bench --instructions.
extern "C" [[gnu::noinline]] void derham_bench_measured(const derham::bench::Kernel& kernel) { kernel.run(); }

namespace derham::bench {
namespace {

struct Case {
  std::string name;
  std::function<Kernel()> make;
};

std::vector<Case>& cases() {
  static std::vector<Case> list;
  return list;
}

int cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

double seconds(const Kernel& kernel) {
  const auto start = std::chrono::steady_clock::now();
  kernel.run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void measure_kernel(benchmark::State& state, const Kernel& kernel) {
  double total = 0, peak = 0, resident = 0;
  if (kernel.memory) ::malloc_trim(0);
  for ([[maybe_unused]] auto iteration : state) {
    std::optional<PeakMemory> memory;  // asking the system takes longer than many kernels
    if (kernel.memory) memory.emplace();
    const double time = seconds(kernel);
    if (memory) {
      peak = static_cast<double>(memory->bytes());
      resident = static_cast<double>(memory->held());
    }
    if (kernel.reset) kernel.reset();
    state.SetIterationTime(std::max(time, 1e-5));  // what takes no time at all is not repeated for ever
    total += time;
  }
  const double once = total / static_cast<double>(state.iterations());
  state.counters["items"] = kernel.items;
  state.counters["ns/item"] = once / kernel.items * 1e9;
  if (kernel.bytes > 0) state.counters["GB/s"] = kernel.bytes / once / 1e9;
  if (kernel.memory) {
    state.counters["peak B/item"] = peak / kernel.items;
    state.counters["kept B/item"] = resident / kernel.items;
  }
}

/// A kernel that the mesh does not allow (a star without inverse) is reported as such, and the others go on.
void measure(benchmark::State& state, const std::function<Kernel()>& make, int threads) {
  set_thread_count(threads);
  try {
    const Kernel kernel = make();
    measure_kernel(state, kernel);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

void add_case(const std::string& name, const std::function<Kernel()>& make, Runs runs) {
  cases().push_back({name, make});
  std::set<int> threads{1};
  if (runs == Runs::everywhere) threads.insert(cores());
  for (const int count : threads) {
    auto* benchmark =
        benchmark::RegisterBenchmark((name + "/threads:" + std::to_string(count)).c_str(),
                                     [make, count](benchmark::State& state) { measure(state, make, count); });
    benchmark->UseManualTime()->Unit(benchmark::kMillisecond);
    if (runs == Runs::once)
      benchmark->Iterations(1)->Repetitions(1);
    else
      benchmark->MinTime(0.05);
  }
}

}  // namespace

void add(const std::string& name, const std::vector<BenchMesh>& meshes, const MakeKernel& make, Runs runs) {
  for (const auto& mesh : meshes)
    add_case(
        name + '/' + mesh.order, [make, &mesh] { return make(mesh); }, runs);
}

void add(const std::string& name, const std::function<Kernel()>& make) {
  add_case(name + "/-", make, Runs::everywhere);
}

void run_once(const std::string& regex, std::ostream& out) {
  set_thread_count(1);
  for (const auto& [name, make] : cases()) {
    if (!std::regex_search(name, std::regex(regex))) continue;
    const Kernel kernel = make();
    kernel.run();
    if (kernel.reset) kernel.reset();
    derham_bench_measured(kernel);
    out << name << '\t' << static_cast<std::int64_t>(kernel.items) << '\n';
  }
}

}  // namespace derham::bench
