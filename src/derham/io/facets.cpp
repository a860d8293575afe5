#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace derham {

MeshData read_facets(Cursor& file, const ReadOptions&) {
  constexpr std::int64_t largest_id =
      std::numeric_limits<Index>::max() - 1;  // so that the number of vertices fits, too
  MeshData mesh;
  std::array<Index, max_dimension + 1> row{};
  while (file.next_line()) {
    std::size_t width = 0;
    for (; !file.at_line_end(); ++width) {
      if (width == row.size())
        file.fail(text("more than ", row.size(), " vertices; expected a simplex of dimension at most ", max_dimension));
      const auto id = file.integer("a vertex id", 0, std::numeric_limits<std::int64_t>::max());
      if (id > largest_id)
        throw LimitError(text(file.name(), ": vertex id ", id,
                              " is more than this build's index type can number; build with DERHAM_INDEX64"));
      row[width] = static_cast<Index>(id);
    }
    mesh.simplices.push_back(std::span<const Index>(row).first(width));
  }
  mesh.vertex_count = mesh.simplices.vertex_bound();
  return mesh;
}

std::vector<std::string> lost_in_facets(const MeshData& mesh, const WriteOptions&) {
  const auto beyond = mesh.vertex_count - mesh.simplices.vertex_bound();
  if (beyond <= 0) return {};
  return {text("does not hold vertices beyond the last one used (", beyond, ")")};
}

void write_facets(TextWriter& file, const MeshData& mesh, const WriteOptions&) {
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    char separator = '\0';
    for (const Index v : mesh.simplices[i]) {
      if (separator != '\0') file.put(separator);
      file.put(v);
      separator = ' ';
    }
    file.put('\n');
  }
}

}  // namespace derham
