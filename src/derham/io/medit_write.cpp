#include "derham/io/formats.hpp"
#include "derham/io/part_numbers.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace derham {
namespace {

void write_simplices(TextWriter& file, const SimplexList& list, const std::vector<std::int64_t>& references) {
  constexpr std::array keywords{"", "Edges", "Triangles", "Tetrahedra"};
  if (list.empty()) return;
  file.put(keywords[static_cast<std::size_t>(list.dimension())]).put('\n').put(list.size()).put('\n');
  for (Offset i = 0; i < list.size(); ++i) {
    for (const Index v : list[i]) file.put(std::int64_t{v} + 1).put(' ');
    file.put(references.empty() ? 0 : references[static_cast<std::size_t>(i)]).put('\n');
  }
}

}  // namespace

std::vector<std::string> lost_in_medit(const MeshData& mesh, const WriteOptions&) { return lost_in_part_numbers(mesh); }

void write_medit(TextWriter& file, const MeshData& mesh, const WriteOptions&) {
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  const std::size_t width = std::max<std::size_t>(m, 2);
  // Version 2 is doubles and 32-bit integers; 4 is 64-bit integers, which fewer programs know.
  const auto is_short = [](std::int64_t number) {
    return number >= std::numeric_limits<std::int32_t>::min() && number <= std::numeric_limits<std::int32_t>::max();
  };
  const bool is_long = !is_short(mesh.vertex_count) || !is_short(mesh.simplices.size()) ||
                       !std::ranges::all_of(mesh.parts, [&](const MeshPart& part) { return is_short(part.number); });
  file.put("MeshVersionFormatted ").put(is_long ? 4 : 2).put("\nDimension ").put(width).put("\nVertices\n");
  file.put(mesh.vertex_count).put('\n');
  const auto vertex_references = part_numbers(mesh, 0, mesh.vertex_count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i) {
    for (std::size_t axis = 0; axis < width; ++axis) file.put(axis < m ? mesh.points[i * m + axis] : 0.0).put(' ');
    file.put(vertex_references.empty() ? 0 : vertex_references[i]).put('\n');
  }
  for (int k = 1; k < static_cast<int>(mesh.lower.size()); ++k) {
    const auto& list = mesh.lower[static_cast<std::size_t>(k)];
    write_simplices(file, list, part_numbers(mesh, k, list.size()));
  }
  write_simplices(file, mesh.simplices, part_numbers(mesh, mesh.simplices.dimension(), mesh.simplices.size()));
  file.put("End\n");
}

}  // namespace derham
