#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/top_volumes.hpp"

// Internal to this room.
namespace derham::detail {

/// Throws GeometryError naming the flat top simplices, if there are any.
template <int n>
void require_not_flat(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  const auto flat = top_volumes(K, geometry).degenerate;
  if (!flat.empty())
    throw GeometryError(text("barycentric coordinates have no gradients on ", flat.size(), " flat top simplices: ",
                             simplices_text<n>(K, n, flat), "; move their vertices or remove them"));
}

}  // namespace derham::detail
