#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/write_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace derham {
namespace {

// Whether the numbers are 0, 1, 2… or 1, 2, 3…, which say no more than the order does.
bool is_order(const std::vector<std::int64_t>& tags) noexcept {
  if (tags.empty()) return true;
  if (tags[0] != 0 && tags[0] != 1) return false;
  for (std::size_t i = 1; i < tags.size(); ++i)
    if (tags[i] != tags[0] + static_cast<std::int64_t>(i)) return false;
  return true;
}

}  // namespace

std::vector<std::string> not_carried(const MeshData& mesh, MeshFormat format, const WriteOptions& options) {
  if (format == MeshFormat::npz) return {};
  const auto& traits = format_traits(format);
  std::vector<std::string> out;
  const auto say = [&](const auto&... what) { out.push_back(text("format ", traits.name, ' ', what...)); };
  const int m = mesh.ambient_dimension;
  if (m > 0 && traits.least_ambient == 0) say("does not hold positions");
  if (m == 2 && traits.least_ambient == 3)
    say("holds positions in space: written with z = 0, read back into the plane by --planar (ReadOptions::planar)");
  if (m == 1 && traits.least_ambient > 1)
    say("holds positions in at least ", traits.least_ambient, " dimensions, this mesh has 1: padded with zeros");
  if (mesh.has_corners() && traits.least_ambient > 0)
    say("holds one position per vertex: every corner of this periodic mesh becomes a vertex");
  if (!is_order(mesh.vertex_tags)) say("does not hold the numbers of vertices (vertex_tags), only their order");
  if (!is_order(mesh.row_tags)) say("does not hold the numbers of rows (row_tags), only their order");
  if (!mesh.parts.empty() && !traits.holds_parts) say("does not hold parts (", mesh.parts.size(), ")");
  if (mesh.lower_count() > 0 && !traits.holds_lower)
    say("does not hold simplices of lower dimension (", mesh.lower_count(), ")");
  if (!mesh.fields.empty() && !traits.holds_fields) say("does not hold fields (", mesh.fields.size(), ")");
  if (!mesh.forms.empty()) say("does not hold forms (", mesh.forms.size(), ")");
  if (!mesh.edge_lengths_squared.empty()) say("does not hold edge lengths");
  if (traits.lost != nullptr)
    for (const auto& phrase : traits.lost(mesh, options)) say(phrase);
  return out;
}

}  // namespace derham
