#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <vector>

namespace derham {

/// A closed walk of distinct top simplices across facets with two cofaces that reverses orientation, found by
/// breadth-first search from the first top simplex of each component; empty if K is orientable. Internal to the room:
/// see `Orientation::one_sided`.
/// Cost     linear
template <int n>
[[nodiscard]] std::vector<Index> one_sided_walk(const SimplicialComplex<n>& K);

}  // namespace derham
