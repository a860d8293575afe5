#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"

#include <array>
#include <string>
#include <vector>

namespace derham {

/// Weights for PowerCircumcentric, and what they do.
template <int n>
struct HotWeights {
  std::vector<double> weights;  ///< (|V|,); units length²; their mean is 0 in every component

  /// Σ_T |T| |c_T - b_T|², c_T power centres and b_T barycentres, for weights 0 and for these; units length^(n+2).
  double energy_before = 0, energy = 0;

  /// [k]: the k-simplices whose dual volume is not positive, for weights 0 and for these.
  std::array<std::vector<Index>, n + 1> not_positive_before, not_positive;

  /// If there are no good weights: none keep the dual lengths of all facets above the margin unless the largest
  /// and the smallest of them differ by this much; very large where the proof is complete up to rounding. Else 0. Units length².
  double excluded_range = 0;

  std::string advice;  ///< empty if every dual volume is positive
};

/// Weights that make the power star positive and accurate: they minimise Σ_T |T| |c_T - b_T|², which says how well a value at the
/// dual vertex stands for the mean over its simplex, as far as the dual lengths of all facets can be kept above `margin` of those of
/// barycentres (the margin); where they cannot, the minimum without that condition. The energy is quadratic and dual lengths are linear in the
/// weights: the problem is convex, with one answer.
///
/// Least squares first; then, if a facet needs it, Newton's method with line search on the energy plus growing squares of what
/// is missing. If something stays missing, that is itself the proof that no weights do better (Farkas), which `excluded_range`
/// puts into a number. Facets of a flat mesh in its own dimension with positive dual lengths make it a regular triangulation;
/// dual volumes of all degrees are judged at the end whatever the mesh.
/// Positive is not accurate by itself: an energy far above `energy_before` says that the mesh had to be bent far, and then the
/// curvature of the weights acts like a material.
/// Cost     some sparse factorisations of a |V| × |V| matrix
/// Throws   InputError unless 0 < margin < 1; GeometryError naming flat top simplices
/// Source   Mullen, Memari, de Goes, Desbrun, "HOT: Hodge-optimized triangulations", 2011 (the energy of n-forms)
template <int n>
[[nodiscard]] HotWeights<n> hot_weights(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                        double margin = 0.02);

}  // namespace derham
