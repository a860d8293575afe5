#pragma once

#include "derham/complex/simplicial_complex.hpp"

namespace derham {

/// What is taken away before collapsing: nothing (is it a ball?) or the interior of one top simplex (is it a sphere?).
enum class Puncture : unsigned char { none, one_top_simplex };

/// Whether one of `attempts` greedy collapses of K (punctured if asked) ends in a single vertex.
///
/// An elementary collapse removes a simplex together with a face that lies in no other one. K is collapsed degree by
/// degree from the top, in a different order in every attempt (first in first out, then pseudo-random with fixed
/// seeds), so the answer is reproducible. `true` is a proof; `false` proves nothing. A combinatorial manifold with
/// boundary that collapses to a point is a ball; hence a closed one that does so once punctured is a sphere.
/// Cost     linear in the number of simplices, per attempt
/// Throws   InputError if attempts < 1
/// Source   Whitehead, "Simplicial spaces, nuclei and m-groups", 1939; Benedetti & Lutz, "Random discrete Morse theory
///          and a new library of triangulations", 2014
template <int n>
[[nodiscard]] bool collapses_to_point(const SimplicialComplex<n>& K, Puncture puncture, int attempts);

}  // namespace derham
