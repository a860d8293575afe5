// Construction of the whole oriented complex: lists of every degree, boundary tables, signs.
#include "bench/support/construction.hpp"
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/program.hpp"
#include "bench/support/yardsticks.hpp"
#include "derham/complex/cofaces.hpp"
#include "derham/complex/simplicial_complex.hpp"

#include <memory>

namespace derham::bench {
namespace {

/// The cofaces of every simplex: every boundary table transposed.
template <int n>
Kernel cofaces(const BenchMesh& mesh) {
  const auto tables = std::make_shared<std::vector<Cofaces>>();
  return {.run =
              [tables, &K = complex_of<n>(mesh)] {
                for (int k = 0; k < n; ++k) tables->emplace_back(K, k);
              },
          .items = static_cast<double>(mesh.data.simplices.size()),
          .bytes = 0,
          .reset = [tables] { std::vector<Cofaces>().swap(*tables); },
          .memory = true};
}

const Suite suite([](const Options& options) {
  add("construction", solids(options), construction<3>);
  add("cofaces", solids(options), cofaces<3>);
  add("construction", surfaces(options), construction<2>);
  add_radix_sort(solids(options));
  add_set_and_map(solids(options));
});

}  // namespace
}  // namespace derham::bench
