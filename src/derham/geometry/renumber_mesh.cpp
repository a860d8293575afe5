#include "derham/geometry/renumber_mesh.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>

namespace derham {
namespace {

std::size_t index(Offset i) { return static_cast<std::size_t>(i); }

std::vector<Index> inverse(const std::vector<Index>& permutation) {
  std::vector<Index> result(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i) result[index(permutation[i])] = static_cast<Index>(i);
  return result;
}

/// Records of `width` numbers each: record old[i] moves to place i.
template <class T>
void reorder(std::vector<T>& values, const std::vector<Index>& old, std::size_t width, const char* what) {
  if (values.size() != old.size() * width)
    throw InputError(
        text("there are ", values.size(), " values of ", what, " for ", old.size(), " records of ", width));
  std::vector<T> result(values.size());
  for (std::size_t i = 0; i < old.size(); ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(index(old[i]) * width), width,
                result.begin() + static_cast<std::ptrdiff_t>(i * width));
  values = std::move(result);
}

/// The same for tags; where there were none the positions become tags.
void reorder_tags(std::vector<std::int64_t>& tags, const std::vector<Index>& old) {
  if (tags.empty())
    tags.assign(old.begin(), old.end());
  else
    reorder(tags, old, 1, "tags");
}

void renumber_members(MeshPart& part, const std::vector<Index>& new_position) {
  for (Index& member : part.members) member = new_position[index(member)];
  std::ranges::sort(part.members);
}

/// Edge lengths and forms, which belong to the simplices of the complexes of `old_rows` and of the mesh.
template <int n>
void renumber_values(MeshData& mesh, const SimplexList& old_rows, const Renumbering& renumbering) {
  const SimplicialComplex<n> K(old_rows, mesh.vertex_count);
  SimplicialComplex<n> L(mesh.simplices, mesh.vertex_count);
  if (mesh.ambient_dimension == n && (mesh.has_points() || mesh.has_corners())) orient_as(L, K, renumbering);
  if (!mesh.edge_lengths_squared.empty()) {
    auto edges = simplex_map(K, L, renumbering, 1);
    for (SignedIndex& edge : edges) edge.sign = 1;
    mesh.edge_lengths_squared = carried(mesh.edge_lengths_squared, edges);
  }
  const auto tops = simplex_map(K, L, renumbering, n);
  for (MeshForm& form : mesh.forms) {
    const int k = form.is_dual ? n - form.degree : form.degree;
    auto map = simplex_map(K, L, renumbering, k);
    if (form.is_dual) {  // a dual cell turns with its simplex and with the orientation of the complex
      const Incidence cofaces = incidence(K, k, n);
      for (Index i = 0; i < K.size(k); ++i)
        if (!cofaces[i].empty())
          map[index(i)].sign = static_cast<Sign>(map[index(i)].sign * tops[index(cofaces[i].front())].sign);
    }
    form.values = carried(form.values, map);
  }
}

void renumber_values(MeshData& mesh, const SimplexList& old_rows, const Renumbering& renumbering) {
  switch (old_rows.dimension()) {
    case 0:
      return renumber_values<0>(mesh, old_rows, renumbering);
    case 1:
      return renumber_values<1>(mesh, old_rows, renumbering);
    case 2:
      return renumber_values<2>(mesh, old_rows, renumbering);
    case 3:
      return renumber_values<3>(mesh, old_rows, renumbering);
    case 4:
      return renumber_values<4>(mesh, old_rows, renumbering);
    case 5:
      return renumber_values<5>(mesh, old_rows, renumbering);
    case 6:
      return renumber_values<6>(mesh, old_rows, renumbering);
    default:
      return;
  }
}

}  // namespace

void renumber(MeshData& mesh, const Renumbering& renumbering) {
  const auto& [new_vertex, old_row] = renumbering;
  if (new_vertex.size() != index(mesh.vertex_count) || old_row.size() != index(mesh.simplices.size()))
    throw InputError(text("a renumbering of ", new_vertex.size(), " vertices and ", old_row.size(),
                          " rows for a mesh of ", mesh.vertex_count, " vertices and ", mesh.simplices.size(), " rows"));
  const int n = mesh.simplices.dimension();
  const auto old_vertex = inverse(new_vertex), new_row = inverse(old_row);
  const SimplexList old_rows = std::exchange(mesh.simplices, renumbered(mesh.simplices, renumbering));
  for (SimplexList& list : mesh.lower)
    for (Index& v : list.vertices()) v = new_vertex[index(v)];

  const std::size_t m = index(mesh.ambient_dimension);
  if (mesh.has_points()) reorder(mesh.points, old_vertex, m, "points");
  if (mesh.has_corners()) reorder(mesh.corners, old_row, m * index(n + 1), "corners");
  for (MeshField& field : mesh.fields)
    reorder(field.values, field.on == MeshField::On::vertices ? old_vertex : old_row, index(field.components),
            "a field");
  for (MeshPart& part : mesh.parts) {
    if (part.degree == n)
      renumber_members(part, new_row);
    else if (part.degree == 0)
      renumber_members(part, new_vertex);
  }
  reorder_tags(mesh.vertex_tags, old_vertex);
  reorder_tags(mesh.row_tags, old_row);
  if (!mesh.edge_lengths_squared.empty() || !mesh.forms.empty()) renumber_values(mesh, old_rows, renumbering);
}

}  // namespace derham
