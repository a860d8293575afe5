#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/complex/local_faces.hpp"
#include "derham/core/parallel.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/operators/field_on_simplex.hpp"
#include "derham/operators/quadrature.hpp"
#include "derham/operators/whitney_simplex.hpp"

#include <algorithm>
#include <vector>

// Internal to this room.
namespace derham::detail {

/// The part of the flow through a top simplex below which X counts as parallel to one of its facets. A box of triangles a
/// million times longer than high is still told from one that X crosses.
constexpr double grazing = 1e-3;

/// Whether X comes in through the facet opposite to vertex `apex` of top simplex t, in the mean over that facet.
template <int n, class Field>
[[nodiscard]] bool comes_in(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const Field& X,
                            const SimplexRule<n - 1>& rule, Index t, std::size_t apex) {
  const auto corners = geometry.corners(K, t);
  SimplexFrame<n> frame(geometry.coordinate_dimension());
  frame.set(corners);
  std::vector<double> x(static_cast<std::size_t>(geometry.coordinate_dimension())), value(x.size());
  double in = 0, through = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    Barycentric<n> lambda{};
    for (std::size_t v = 0, at = 0; v <= n; ++v) lambda[v] = v == apex ? 0 : rule.points[q][at++];
    evaluate_field<n>(K, t, X, corners, lambda, x, value.data());
    const auto rates = barycentric_rates<n>(frame, value);
    in += rule.weights[q] * rates[apex];
    through += rule.weights[q] * through_flow<n>(rates);
  }
  return in > grazing * through;
}

/// For every j-simplex 1 if it is in a boundary facet through which X comes in, else 0.
/// Shape    (|K_j|,)
/// Cost     one pass over the facets; X is evaluated on boundary facets only
template <int n, int j, class Field>
[[nodiscard]] std::vector<char> inflow(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const Field& X,
                                       int order) {
  const auto rule = simplex_rule<n - 1>(order);
  const FacetCofaces cofaces = facet_cofaces(K);
  std::vector<char> facet(static_cast<std::size_t>(K.size(n - 1)));
  const auto apex = [&K](Index t, Index f) {
    const auto all = K.template simplex<n>(t);
    const auto own = K.template simplex<n - 1>(f);
    return static_cast<std::size_t>(
        std::ranges::find_if(all, [&](Index v) { return std::ranges::find(own, v) == own.end(); }) - all.begin());
  };
  parallel_blocks(K.size(n - 1), 128, [&](Offset begin, Offset end) {
    for (auto f = static_cast<std::size_t>(begin); f < static_cast<std::size_t>(end); ++f)
      if (const Index t = cofaces.first[f]; cofaces.count[f] == 1)
        facet[f] = comes_in(K, geometry, X, rule, t, apex(t, static_cast<Index>(f)));
  });
  std::vector<char> result(static_cast<std::size_t>(K.size(j)));
  for (std::size_t f = 0; f < facet.size(); ++f) {
    if (!facet[f]) continue;
    const Index t = cofaces.first[f];
    const auto index = face_indices(K, t);
    const unsigned opposite = 1U << apex(t, static_cast<Index>(f));
    for (const unsigned face : masks_of<n, j + 1>())
      if (!(face & opposite)) result[static_cast<std::size_t>(index[face])] = 1;
  }
  return result;
}

}  // namespace derham::detail
