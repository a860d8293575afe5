// The program of every room: reads the options, lets the suites register their benchmarks, runs them.
#include "bench/support/program.hpp"

#include "bench/support/kernel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <fstream>
#include <iostream>
#include <string_view>
#include <vector>

#include <malloc.h>

namespace derham::bench {
namespace {

std::vector<Suite::Add>& suites() {
  static std::vector<Suite::Add> list;
  return list;
}

/// The model of the processor, as Linux names it.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// Takes the options of this program out of the arguments; false if one is wrong.
bool take_options(int& argc, char** argv, Options& options) {
  int kept = 1;
  bool sound = true;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const auto value = argument.substr(std::min(argument.size(), argument.find('=') + 1));
    if (argument.starts_with("--simplices=")) {
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), options.simplices);
      sound = sound && error == std::errc() && end == value.data() + value.size() && options.simplices > 0;
    } else if (argument.starts_with("--mesh=")) {
      options.mesh = value;
    } else if (argument.starts_with("--save=")) {
      options.save = value;
    } else if (argument.starts_with("--once=")) {
      options.once = value;
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  if (!sound) std::cerr << "--simplices=N needs a number N > 0\n";
  return sound;
}

int run(int argc, char** argv) {
  // Every large array is fresh memory, and what is freed goes back: otherwise a run would depend on those before it.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 17);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 17);
  Options options;
  if (!take_options(argc, argv, options)) return 2;
  if (!options.save.empty()) {
    save_meshes(options);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("compiler", DERHAM_BENCH_COMPILER);
  benchmark::AddCustomContext("flags", DERHAM_BENCH_FLAGS);
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("simplices", options.mesh.empty() ? std::to_string(options.simplices) : options.mesh);
  for (const auto add : suites()) add(options);
  if (!options.once.empty()) {
    run_once(options.once, std::cout);
  } else {
    benchmark::RunSpecifiedBenchmarks();
  }
  benchmark::Shutdown();
  return 0;
}

}  // namespace

Suite::Suite(Add add) { suites().push_back(add); }

}  // namespace derham::bench

int main(int argc, char** argv) {
  try {
    return derham::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
