#pragma once

#include <benchmark/benchmark.h>

#include <charconv>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include <malloc.h>

namespace derham::bench {

/// The model of the processor, as Linux names it.
inline std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// Begins a benchmark program: takes --simplices=N, the size of the meshes, out of the arguments, and adds to the report
/// what the times depend on. Returns N; 0 after a message if the arguments are wrong.
///
/// Every large array will be fresh memory, and what is freed goes back: otherwise a run would depend on those before it.
inline std::int64_t begin(int argc, char** argv) {
  ::mallopt(M_MMAP_THRESHOLD, 1 << 17);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 17);
  std::int64_t simplices = 1'000'000;
  constexpr std::string_view option = "--simplices=";
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.starts_with(option))
      std::from_chars(argument.data() + option.size(), argument.data() + argument.size(), simplices);
    else
      argv[kept++] = argv[i];
  }
  benchmark::Initialize(&kept, argv);
  if (benchmark::ReportUnrecognizedArguments(kept, argv)) return 0;
  benchmark::AddCustomContext("compiler", DERHAM_BENCH_COMPILER);
  benchmark::AddCustomContext("flags", DERHAM_BENCH_FLAGS);
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("simplices", std::to_string(simplices));
  return simplices;
}

}  // namespace derham::bench
