#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/parallel.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/operators/field_on_simplex.hpp"
#include "derham/operators/quadrature.hpp"

#include <algorithm>
#include <vector>

// Internal to this room.
namespace derham::detail {

/// What leaves a top simplex in a unit of time, relative to what is there; at least X·∇λ_v at its vertices. The largest of
/// all top simplices.
/// Units    1/time
/// Cost     one pass over the top simplices
template <int n, class Field>
[[nodiscard]] double largest_leaving_rate(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const Field& X,
                                          int order) {
  const auto rule = simplex_rule<n - 1>(order);
  std::vector<double> rate(static_cast<std::size_t>(K.size(n)));
  parallel_blocks(K.size(n), 128, [&](Offset begin, Offset end) {
    SimplexFrame<n> frame(geometry.coordinate_dimension());
    std::vector<double> x(static_cast<std::size_t>(geometry.coordinate_dimension())), value(x.size());
    for (auto t = static_cast<Index>(begin); t < end; ++t) {
      const auto corners = geometry.corners(K, t);
      frame.set(corners);
      const auto towards = [&](std::size_t v, const Barycentric<n>& lambda) {
        evaluate_field<n>(K, t, X, corners, lambda, x, value.data());
        return barycentric_rates<n>(frame, value)[v];
      };
      double leaving = 0, largest = 0;
      for (std::size_t v = 0; v <= n; ++v) {
        Barycentric<n> lambda{};
        lambda[v] = 1;
        largest = std::max(largest, towards(v, lambda));
        for (std::size_t q = 0; q < rule.points.size(); ++q) {
          for (std::size_t i = 0, at = 0; i <= n; ++i) lambda[i] = i == v ? 0 : rule.points[q][at++];
          leaving += n * rule.weights[q] * std::max(0.0, -towards(v, lambda));
        }
      }
      rate[static_cast<std::size_t>(t)] = std::max(leaving, largest);
    }
  });
  return rate.empty() ? 0 : *std::ranges::max_element(rate);
}

}  // namespace derham::detail
