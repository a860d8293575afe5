#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"

#include <array>
#include <vector>

namespace derham {

/// One number per simplex of every degree: [k] has shape (|K_k|,).
template <int n>
using ByDegree = std::array<std::vector<double>, n + 1>;

/// Volumes of the simplices of every degree: 1 for a vertex, lengths, areas, …; 0 for flat simplices.
/// Units    [k]: length^k
/// Cost     one pass over the simplices of every degree; the same bits for any number of threads
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.2.1
template <int n>
[[nodiscard]] ByDegree<n> primal_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// Squared edge lengths, as Geometry::from_squared_lengths takes them: shape (|E|,), in the chart of the first
/// top simplex that an edge belongs to.
/// Units    length^2
/// Cost     one pass over the edges
/// Throws   InputError unless the geometry was made for K
template <int n>
  requires(n >= 1)
[[nodiscard]] std::vector<double> squared_lengths(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// |M|: the sum of the volumes of the top simplices. Units length^n.
template <int n>
[[nodiscard]] double total_volume(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// Signed volumes of the representatives of the top simplices, before K.sign(t): shape (|K_n|,). The sign is that of
/// exact arithmetic on the coordinates, 0 for exactly flat simplices.
/// Units    length^n
/// Throws   GeometryError unless geometry.has_signed_volume()
template <int n>
[[nodiscard]] std::vector<double> signed_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// Fixes the free sign of every component of K by its total signed volume where m = n; leaves K alone otherwise, and
/// where that sum is zero. Individual signs stay coherent: inverted simplices are found by quality(), not believed.
template <int n>
void orient_by_volume(SimplicialComplex<n>& K, const Geometry<n>& geometry);

}  // namespace derham
