#include "derham/io/unused_vertices.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cstdint>
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

  for (Index& v : mesh.simplices.vertices()) v = static_cast<Index>(std::ranges::lower_bound(used, v) - used.begin());

  std::vector<std::int64_t> tags;
  std::vector<double> points;
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  for (const Index v : used) {
    const auto old = static_cast<std::size_t>(v);
    tags.push_back(mesh.vertex_tags.empty() ? v : mesh.vertex_tags[old]);
    if (mesh.has_points()) points.insert(points.end(), &mesh.points[old * m], &mesh.points[old * m] + m);
  }
  mesh.vertex_tags = std::move(tags);
  mesh.points = std::move(points);
  mesh.vertex_count = count;
  return dropped;
}

}  // namespace derham
