#pragma once

#include "bench/support/meshes.hpp"

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace derham::bench {

/// What is measured, ready to run on one mesh.
struct Kernel {
  std::function<void()> run;    ///< timed, many times
  double items = 0;             ///< how many simplices it treats: times are reported per item
  double bytes = 0;             ///< every table and vector of every pass once; 0 when it is not bound by memory
  std::function<void()> reset;  ///< undoes `run`, not timed; may be empty
  bool memory = false;          ///< report the memory that `run` takes at its peak and, until `reset`, keeps
};

/// Makes the kernel for a mesh, not timed; called before every repetition.
using MakeKernel = std::function<Kernel(const BenchMesh&)>;

enum class Runs {
  everywhere,  ///< on one thread and on all cores, as often as the command line asks
  one_thread,
  once  ///< on one thread, one repetition: for what takes minutes
};

/// Registers "name/order/threads:t" for every mesh.
void add(const std::string& name, const std::vector<BenchMesh>& meshes, const MakeKernel& make,
         Runs runs = Runs::everywhere);

/// The same for what belongs to no mesh: "name/-/threads:t".
void add(const std::string& name, const std::function<Kernel()>& make);

/// Runs every registered kernel whose name matches `regex` on one thread, first to warm up, then once within the function
/// `derham_bench_measured`, where a profiler can count; prints "name <tab> items" for each.
void run_once(const std::string& regex, std::ostream& out);

}  // namespace derham::bench
