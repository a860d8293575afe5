#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <initializer_list>
#include <string_view>
#include <vector>

namespace derham {

/// The facets of K that a part of its mesh tags, on the boundary all of them: a part Γ of it, for FormSpace and
/// boundary_material. Increasing, each once, however the file orients or repeats it. For a sheet inside of K, a thin
/// conductor or a crack, give FormSpace the simplices of `tagged_chain<n - 1>`.
/// Cost     O(s log s) for s facets, and a pass over the top simplices
/// Throws   InputError if the part has another degree than n-1, or naming the row that is no facet of K, or that is not on the
///          boundary
template <int n>
  requires(n >= 1)
[[nodiscard]] std::vector<Index> tagged_facets(const SimplicialComplex<n>& K, const MeshData& mesh,
                                               const MeshPart& part);

/// Those of the parts of degree n-1 with these names, together.
/// Throws   as above; InputError for a name that no part has, naming those there are, or that several have
template <int n>
  requires(n >= 1)
[[nodiscard]] std::vector<Index> tagged_facets(const SimplicialComplex<n>& K, const MeshData& mesh,
                                               std::initializer_list<std::string_view> names);

}  // namespace derham
