#pragma once

#include <cstdint>
#include <string>

namespace derham::bench {

/// What the command line of a benchmark program asks for, beside the options of Google Benchmark.
struct Options {
  std::int64_t simplices = 1'000'000;  ///< --simplices=N: about so many top simplices in the meshes of the generators
  std::string mesh;                    ///< --mesh=FILE: this mesh instead
  std::string save;                    ///< --save=FOLDER: the meshes are written there as .npz, nothing is measured
  std::string once;                    ///< --once=REGEX: the kernels that match run once each, to count instructions
};

/// Registers the benchmarks of a source file: a global object of this type has `add` called once the options are known.
/// What `add` registers may be measured until the program ends, so its data live in static variables. The program itself
/// is bench/support/program.cpp.
struct Suite {
  using Add = void (*)(const Options&);
  explicit Suite(Add add);
};

}  // namespace derham::bench
