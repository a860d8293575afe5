#include "derham/io/gmsh_quadrangles.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace derham {
namespace {

// Every group of `width` values as often as there are triangles in its place.
template <class Value>
void repeat(std::vector<Value>& values, const std::vector<Index>& first, std::size_t width) {
  std::vector<Value> out;
  for (std::size_t i = 0; (i + 1) * width <= values.size(); ++i)
    for (Index copy = first[i]; copy < first[i + 1]; ++copy)
      for (std::size_t v = 0; v < width; ++v) out.push_back(values[i * width + v]);
  values = std::move(out);
}

}  // namespace

void split_quadrangles(MeshData& mesh, std::span<const GmshQuadrangle> quadrangles) {
  if (quadrangles.empty()) return;
  const bool are_rows = mesh.simplices.dimension() == 2;
  auto& list = are_rows ? mesh.simplices : mesh.lower[2];
  if (list.size() + std::ssize(quadrangles) >= Offset{std::numeric_limits<Index>::max()})
    throw LimitError("more triangles than this build's index type can number; build with DERHAM_INDEX64");

  std::vector<Index> ids, first;  // first[i]: where what was triangle i begins
  auto next = quadrangles.begin();
  for (Offset i = 0; i < list.size(); ++i) {
    const auto row = list[i];
    first.push_back(static_cast<Index>(ids.size() / 3));
    ids.insert(ids.end(), row.begin(), row.end());
    if (next == quadrangles.end() || next->position != i) continue;
    ids.insert(ids.end(), {row[0], row[2], next->fourth_corner});
    ++next;
  }
  first.push_back(static_cast<Index>(ids.size() / 3));
  list = SimplexList(2, std::move(ids));

  for (auto& part : mesh.parts) {
    if (part.degree != 2) continue;
    std::vector<Index> members;
    for (const Index member : part.members) {
      const auto m = static_cast<std::size_t>(member);
      for (Index copy = first[m]; copy < first[m + 1]; ++copy) members.push_back(copy);
    }
    part.members = std::move(members);
  }
  if (are_rows) {
    repeat(mesh.row_tags, first, 1);
    for (auto& field : mesh.fields)
      if (field.on == MeshField::On::rows) repeat(field.values, first, static_cast<std::size_t>(field.components));
  }
  mesh.notes.push_back(text("split ", quadrangles.size(), " quadrangles into ", 2 * quadrangles.size(), " triangles"));
}

}  // namespace derham
