#pragma once

#include "derham/boundary/boundary_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"

#include <initializer_list>
#include <vector>

namespace derham {

/// The metric of ∂K, made of what that of K is made of: for its own volumes, stars and masses.
/// Throws   InputError if B is not the boundary of K, or the geometry not that of K
template <int n>
  requires(n >= 1)
[[nodiscard]] Geometry<n - 1> boundary_geometry(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                                const BoundaryComplex<n>& B);

/// A number on some facets of K.
struct FacetValue {
  std::vector<Index> facets;
  double value = 0;
};

/// A material on ∂K: the numbers of the parts, 0 elsewhere. A star or mass with it is that of these parts alone, weighed: Robin
/// numbers, prescribed fluxes, impedances.
/// Throws   InputError naming a facet that is not on the boundary, or that two parts have
template <int n>
  requires(n >= 1)
[[nodiscard]] Material boundary_material(const BoundaryComplex<n>& B, std::initializer_list<FacetValue> parts);

}  // namespace derham
