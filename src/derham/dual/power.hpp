#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"

#include <span>

namespace derham {

/// Signed volumes of the power dual: circumcentric_dual with power centres in place of circumcentres. The power centre of a
/// simplex is the point of its plane with |x - p_v|² - w_v the same for all its vertices v; adding a number to all weights changes
/// nothing, and weights 0 give the circumcentric dual up to rounding.
///
/// A material weighs the part of every dual cell in a top simplex with the number of that simplex: D(σ^n) is that number.
/// What rounding could explain is 0, and NaN marks what does not exist, as in CircumcentricDual; `well_centered` says that every
/// simplex contains its power centre.
/// Shape    weights (|V|,), or empty for zeros          Units   length², of the weights
/// Law      Σ |σ^k| D(σ^k) = C(n,k) Σ a_T |T| for every k, on every mesh, for all weights
/// Cost     a few times that of circumcentric_dual; measured on all threads, summed on one: the same bits always
/// Throws   InputError on a wrong shape, a weight that is not finite, or a material of tensors
/// Source   Mullen, Memari, de Goes, Desbrun, "HOT: Hodge-optimized triangulations", 2011, §2
template <int n>
[[nodiscard]] CircumcentricDual<n> power_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                              std::span<const double> weights, const Material& material = {});

/// Throws   InputError unless there is a finite weight for every vertex, or none at all
template <int n>
void require_weights(std::span<const double> weights, const SimplicialComplex<n>& K);

/// Throws   InputError if the material does not fit, or holds tensors: no diagonal star can take them
template <int n>
void require_numbers(const Material& material, const SimplicialComplex<n>& K, const Geometry<n>& geometry);

}  // namespace derham
