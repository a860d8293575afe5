#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <string>
#include <vector>

// Internal to check_manifold.
namespace derham::detail {

/// Rows of `degree`+1 vertices with the ids replaced by 0, 1, … in their order.
[[nodiscard]] SimplexList compact_rows(int degree, std::vector<Index> vertices);

/// A compact surface by its name: "a torus", "an annulus", "2 components (a disc, a sphere)". By Euler characteristic,
/// orientability and number of boundary circles of every component.
/// `triangles` must form a 2-manifold with vertices 0, 1, … without gaps.
[[nodiscard]] std::string surface_name(const SimplexList& triangles);

}  // namespace derham::detail
