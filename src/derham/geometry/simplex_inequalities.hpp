#pragma once

#include "derham/complex/simplicial_complex.hpp"

#include <span>
#include <vector>

namespace derham {

/// A simplex that no Euclidean simplex has the edge lengths of, though all its faces have theirs.
struct ImpossibleSimplex {
  int degree = 0;
  Index index = 0;
  /// Of its last vertex over the face of the others: negative. Of an edge the squared length, which is not positive and
  /// finite. Units length^2.
  double squared_altitude = 0;
};

/// Where squared edge lengths violate the simplex inequalities, in every degree: for triangles the triangle inequality,
/// above that the Gram matrix of the edges would not be positive. Sorted by degree, then index; empty if all is well.
/// Simplices with an impossible face are not listed again; flat ones are possible.
/// Shape    squares (|E|,), units length^2
/// Cost     a search for every edge of every simplex
/// Throws   InputError on a wrong shape
/// Source   Schoenberg, "Remarks to Maurice Fréchet's article …", Annals of Mathematics, 1935
template <int n>
[[nodiscard]] std::vector<ImpossibleSimplex> impossible_simplices(const SimplicialComplex<n>& K,
                                                                  std::span<const double> squares);

/// Throws   GeometryError if there are impossible simplices: names the first, by how much it fails and how to mend it, and
///          counts the others; InputError as above
template <int n>
void require_simplex_inequalities(const SimplicialComplex<n>& K, std::span<const double> squares);

}  // namespace derham
