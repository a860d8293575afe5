#pragma once

#include "derham/boundary/chain_of_rows.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <string>
#include <string_view>

namespace derham {

/// A tagged curve, surface or region of a mesh as a chain: the sum of its simplices, each oriented as the file lists its
/// vertices. `pair(w, chain)` is then the circulation along it (k = 1), the flux through it (k = 2 in space), ….
/// Files often orient a surface at random: see `coherent`.
/// Cost     O(s log s) for s simplices
/// Throws   InputError if the part has another degree, or naming the row that is no simplex of K
template <int k, int n>
[[nodiscard]] Chain<n, k> tagged_chain(const SimplicialComplex<n>& K, const MeshData& mesh, const MeshPart& part) {
  if (part.degree != k)
    throw InputError(text("part ", part.number, " '", part.name, "' has degree ", part.degree, ", the chain ", k));
  if constexpr (k == 0) {
    std::vector<typename Chain<n, 0>::Term> points;
    for (const Index v : part.members) points.push_back({v, 1});
    return Chain<n, 0>(K, std::move(points));
  }
  if (k == mesh.simplices.dimension()) return chain_of_rows<k>(K, mesh.simplices, part.members);
  if (mesh.lower.size() <= k)
    throw InputError(text("part ", part.number, " '", part.name, "' tags simplices of degree ", k,
                          ", of which the mesh lists none"));
  return chain_of_rows<k>(K, mesh.lower[k], part.members);
}

/// The part of degree k with this name.
/// Throws   InputError if there is none, naming those there are, or if there are several
[[nodiscard]] inline const MeshPart& tagged_part(const MeshData& mesh, int k, std::string_view name) {
  const MeshPart* found = nullptr;
  std::string others;
  for (const MeshPart& part : mesh.parts) {
    if (part.degree != k) continue;
    if (part.name == name && found != nullptr)
      throw InputError(text("several parts of degree ", k, " are called '", name, "'; give the part itself"));
    if (part.name == name) found = &part;
    others += text(others.empty() ? "" : ", ", "'", part.name, "' (", part.number, ")");
  }
  if (found == nullptr)
    throw InputError(
        text("no part of degree ", k, " is called '", name, "'; there are ", others.empty() ? "none" : others));
  return *found;
}

/// The chain of the part of degree k with this name. Throws as both.
template <int k, int n>
[[nodiscard]] Chain<n, k> tagged_chain(const SimplicialComplex<n>& K, const MeshData& mesh, std::string_view name) {
  return tagged_chain<k>(K, mesh, tagged_part(mesh, k, name));
}

}  // namespace derham
