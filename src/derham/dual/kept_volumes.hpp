#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/parallel.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/dual/dual_recursion.hpp"

#include <array>
#include <cstddef>

// Internal to dual and hodge.
namespace derham::detail {

/// Room for a number per simplex of every degree. One piece fills it from the beginning; for several there are zeros, which
/// all threads write.
template <int n, class... Others>
void make_room(const SimplicialComplex<n>& K, Others&... lists) {
  const std::array<ByDegree<n>*, sizeof...(lists)> all{&lists...};
  const bool several = dual_pieces(K) > 1;
  const Offset count = static_cast<Offset>(all.size()) * (n + 1);
  parallel_blocks(count, several ? 1 : count, [&](Offset first, Offset last) {
    for (Offset number = first; number < last; ++number) {
      const int k = n - static_cast<int>(number / static_cast<Offset>(all.size()));
      auto& list = (*all[static_cast<std::size_t>(number) % all.size()])[static_cast<std::size_t>(k)];
      reserve_large(list, static_cast<std::size_t>(K.size(k)));
      if (several) list.resize(static_cast<std::size_t>(K.size(k)));
    }
  });
}

/// Keeps volumes and dual volumes.
template <int n>
class KeptVolumes {
 public:
  KeptVolumes(const SimplicialComplex<n>& K, CircumcentricDual<n>& result) : result_(result) {
    make_room<n>(K, result.primal, result.dual);
  }

  template <int k>
  void take(std::size_t, const SettledBlock& block) {
    block.store(block.volume, result_.primal[k]);
    block.store(block.dual, result_.dual[k]);
  }

 private:
  CircumcentricDual<n>& result_;
};

/// Runs the recursion for the sink, and keeps what it says of the mesh as a whole.
template <int n, class Sink>
void run_recursion(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Sink& sink,
                   CircumcentricDual<n>& result) {
  DualRecursion recursion(K, geometry, sink);
  recursion.run();
  result.degenerate = recursion.degenerate();
  result.well_centered = recursion.well_centered();
}

}  // namespace derham::detail
