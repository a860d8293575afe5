// The wedge product of primal forms on tetrahedra.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/operators.hpp"
#include "bench/support/program.hpp"
#include "bench/support/yardsticks.hpp"
#include "derham/forms/wedge.hpp"

#include <memory>
#include <string>

namespace derham::bench {
namespace {

using Vector = std::vector<double>;

template <int p, int q>
Kernel wedge_with_ones(const BenchMesh& mesh) {
  const auto& K = complex_of<3>(mesh);
  const auto b = std::make_shared<const Vector>(static_cast<std::size_t>(K.size(q)), 1.0);
  const auto apply = [&K, b](const Vector& a, Vector& y) { apply_wedge(K, p, a, q, *b, y); };
  return application(mesh, K.size(p), K.size(p + q), bytes_of_wedge(K, p, q) + 8 * Offset{K.size(q)}, apply);
}

template <int p, int q>
void add_wedge(const Options& options) {
  add("wedge of " + std::to_string(p) + " and " + std::to_string(q), solids(options), wedge_with_ones<p, q>);
}

const Suite suite([](const Options& options) {
  add_copy();
  add_wedge<0, 1>(options);
  add_wedge<1, 1>(options);
  add_wedge<0, 3>(options);
  add_wedge<1, 2>(options);
});

}  // namespace
}  // namespace derham::bench
