#pragma once

#include "derham/boundary/rings.hpp"
#include "derham/core/types.hpp"

#include <span>
#include <string>

// The words of the manifold report, internal to check_manifold.
namespace derham::detail {

/// "vertex", "edge", "triangle", "tet", "4-simplex", …
[[nodiscard]] std::string noun(int k);

/// "1 tet", "2 tets".
[[nodiscard]] std::string counted(Offset count, int k);

/// "tets 3, 5, 8, …"
[[nodiscard]] std::string numbered(std::span<const Index> indices, int k);

/// "no n-simplex contains it, …": a maximal simplex of degree k < n.
[[nodiscard]] std::string impurity_text(int n);

/// "it is a face of 3 tets, …"
[[nodiscard]] std::string facet_text(std::span<const Index> cofaces, int n);

/// "the 7 tets about it form 2 rings (a closed one of 5, an open one of 2), …"; about a vertex (n = 2) its link.
[[nodiscard]] std::string rings_text(std::span<const Ring> rings, int n);

/// "its link is a torus, …" for a k-simplex; `split` when giving each component its own copy mends it.
[[nodiscard]] std::string link_text(const std::string& link, int link_dimension, int k, bool split);

}  // namespace derham::detail
