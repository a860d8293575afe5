#include "derham/io/unused_vertices.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/form_size.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace derham {
namespace {

void require_ids_in_range(const MeshData& mesh) {
  for (const Index v : mesh.simplices.vertices())
    if (v < 0 || v >= mesh.vertex_count)
      throw InputError(text("vertex id ", v, " in a mesh of ", mesh.vertex_count, " vertices; expected 0 to ",
                            mesh.vertex_count - 1));
}

// All used vertices in increasing order.
std::vector<Index> used_vertices(const MeshData& mesh) {
  const auto ids = mesh.simplices.vertices();
  std::vector<Index> used;
  // A list of facets may have few, but huge ids: then a table over all ids would be out of proportion.
  if (static_cast<std::size_t>(mesh.vertex_count) / 8 > ids.size()) {
    used.assign(ids.begin(), ids.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }
  std::vector<char> is_used(static_cast<std::size_t>(mesh.vertex_count), 0);
  for (const Index v : ids) is_used[static_cast<std::size_t>(v)] = 1;
  for (Index v = 0; v < mesh.vertex_count; ++v)
    if (is_used[static_cast<std::size_t>(v)]) used.push_back(v);
  return used;
}

std::size_t member_count(const MeshData& mesh) {
  std::size_t count = 0;
  for (const auto& part : mesh.parts) count += part.members.size();
  return count;
}

// Keeps the simplices of lower dimension that `keep` accepts, and renumbers the members of parts.
template <class Keep>
void keep_lower(MeshData& mesh, Keep keep) {
  for (int k = 0; k < static_cast<int>(mesh.lower.size()); ++k) {
    auto& list = mesh.lower[static_cast<std::size_t>(k)];
    SimplexList rest;
    std::vector<Index> position(static_cast<std::size_t>(list.size()), -1);
    for (Offset i = 0; i < list.size(); ++i) {
      if (!keep(list[i])) continue;
      position[static_cast<std::size_t>(i)] = static_cast<Index>(rest.size());
      rest.push_back(list[i]);
    }
    if (rest.size() == list.size()) continue;
    list = std::move(rest);
    if (k == 0) continue;  // parts of degree 0 name vertices
    for (auto& part : mesh.parts) {
      if (part.degree != k) continue;
      for (Index& member : part.members) member = position[static_cast<std::size_t>(member)];
      std::erase(part.members, -1);
    }
  }
}

}  // namespace

Index first_unused_vertex(const MeshData& mesh) {
  require_ids_in_range(mesh);
  // More vertices than ids: one of the first ids.size()+1 is unused already.
  const auto ids = mesh.simplices.vertices();
  const auto bound = std::min(static_cast<std::size_t>(mesh.vertex_count), ids.size() + 1);
  std::vector<char> is_used(bound, 0);
  for (const Index v : ids)
    if (static_cast<std::size_t>(v) < bound) is_used[static_cast<std::size_t>(v)] = 1;
  const auto unused = std::ranges::find(is_used, 0);
  return unused == is_used.end() ? -1 : static_cast<Index>(unused - is_used.begin());
}

Index drop_unused_vertices(MeshData& mesh) {
  require_ids_in_range(mesh);
  const auto used = used_vertices(mesh);
  const auto count = static_cast<Index>(used.size());
  const Index dropped = mesh.vertex_count - count;
  if (dropped == 0) return 0;

  const Offset lower = mesh.lower_count();
  const std::size_t members = member_count(mesh);
  const auto position = [&](Index v) { return static_cast<Index>(std::ranges::lower_bound(used, v) - used.begin()); };
  const auto is_used = [&](Index v) { return std::ranges::binary_search(used, v); };
  keep_lower(mesh, [&](std::span<const Index> simplex) { return std::ranges::all_of(simplex, is_used); });
  for (auto& part : mesh.parts) {
    if (part.degree != 0 || mesh.simplices.dimension() == 0) continue;
    std::erase_if(part.members, [&](Index v) { return !is_used(v); });
    for (Index& v : part.members) v = position(v);
  }
  if (mesh.lower_count() < lower || member_count(mesh) < members)
    mesh.notes.push_back(text("with the unused vertices went ", lower - mesh.lower_count(),
                              " simplices of lower dimension and ", members - member_count(mesh), " members of parts"));
  for (Index& v : mesh.simplices.vertices()) v = position(v);
  for (auto& list : mesh.lower)
    for (Index& v : list.vertices()) v = position(v);

  const auto kept = [&](const std::vector<double>& values, int width) {
    std::vector<double> out;
    out.reserve(used.size() * static_cast<std::size_t>(width));
    for (const Index v : used) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(v) * width;
      out.insert(out.end(), first, first + width);
    }
    return out;
  };
  if (mesh.has_points()) mesh.points = kept(mesh.points, mesh.ambient_dimension);
  for (auto& field : mesh.fields)
    if (field.on == MeshField::On::vertices) field.values = kept(field.values, field.components);
  for (auto& form : mesh.forms)
    if (simplex_degree(mesh, form) == 0 && static_cast<Offset>(form.values.size()) == Offset{mesh.vertex_count})
      form.values = kept(form.values, 1);
  std::vector<std::int64_t> tags;
  tags.reserve(used.size());
  for (const Index v : used)
    tags.push_back(mesh.vertex_tags.empty() ? v : mesh.vertex_tags[static_cast<std::size_t>(v)]);
  mesh.vertex_tags = std::move(tags);
  mesh.vertex_count = count;
  return dropped;
}

void drop_mid_nodes(MeshData& mesh, Offset count, const char* cells) {
  if (count == 0) return;
  const Index dropped = drop_unused_vertices(mesh);
  auto note = text("kept the corner nodes of ", count, " ", cells, " of higher order");
  if (dropped > 0) note += text("; dropped ", dropped, " nodes that no simplex uses");
  mesh.notes.push_back(std::move(note));
}

}  // namespace derham
