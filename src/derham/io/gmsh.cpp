#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();

// The position of the node with a given number. Gmsh numbers nodes from 1 up, but gaps and any order are allowed.
class NodePositions {
 public:
  explicit NodePositions(std::span<const std::int64_t> numbers) : numbers_(numbers) {
    std::size_t i = 0;
    while (i < numbers.size() && numbers[i] - numbers[0] == static_cast<std::int64_t>(i)) ++i;
    if (i == numbers.size()) return;

    const auto [lowest, highest] = std::ranges::minmax(numbers);
    first_ = lowest;
    if (highest - lowest < 8 * static_cast<std::int64_t>(numbers.size())) {
      table_.assign(static_cast<std::size_t>(highest - lowest) + 1, -1);
      for (i = 0; i < numbers.size() && repeated_ < 0; ++i) {
        auto& entry = table_[static_cast<std::size_t>(numbers[i] - first_)];
        if (entry >= 0) repeated_ = static_cast<Index>(i);
        entry = static_cast<Index>(i);
      }
    } else {
      sorted_.reserve(numbers.size());
      for (i = 0; i < numbers.size(); ++i) sorted_.emplace_back(numbers[i], static_cast<Index>(i));
      std::ranges::sort(sorted_);
      for (i = 1; i < sorted_.size(); ++i)
        if (sorted_[i - 1].first == sorted_[i].first && (repeated_ < 0 || sorted_[i].second < repeated_))
          repeated_ = sorted_[i].second;
    }
  }

  // The first node whose number an earlier one has; -1 if there is none.
  [[nodiscard]] Index repeated() const noexcept { return repeated_; }

  // -1 if there is no such node.
  [[nodiscard]] Index operator[](std::int64_t number) const noexcept {
    if (!sorted_.empty()) {
      const auto found = std::ranges::lower_bound(sorted_, std::pair<std::int64_t, Index>(number, 0));
      return found == sorted_.end() || found->first != number ? -1 : found->second;
    }
    const auto position = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(first_);  // huge below first_
    if (!table_.empty()) return position < table_.size() ? table_[position] : -1;
    return position < numbers_.size() ? static_cast<Index>(position) : -1;
  }

 private:
  std::span<const std::int64_t> numbers_;
  std::int64_t first_ = numbers_.empty() ? 0 : numbers_[0];
  std::vector<Index> table_;                            // when there are gaps or another order
  std::vector<std::pair<std::int64_t, Index>> sorted_;  // when the gaps are too wide for a table
  Index repeated_ = -1;
};

void read_header(Cursor& file) {
  if (!file.next_line()) file.fail_token("the version of the format", nullptr);
  const auto version = file.word("the version of the format");
  const auto type = file.integer("the file type", 0, 1);
  if (version != "2.2")
    file.fail(text("this is Gmsh format ", quoted_token(version), type == 1 ? " binary" : "",
                   "; expected 2.2 ASCII: convert it with gmsh -save -format msh22"));
  if (type == 1) file.fail("this is Gmsh format 2.2 binary; expected ASCII: convert it with gmsh -save -format msh22");
  (void)file.integer("the size of a real number", 4, 16);
  file.end_line();
}

NodePositions read_nodes(Cursor& file, MeshData& mesh) {
  if (!file.next_line()) file.fail_token("the number of nodes", nullptr);
  mesh.vertex_count = file.count("the number of nodes", 8);
  file.end_line();
  const auto start = file.offset();
  const auto next_node = [&](Index i) {
    if (!file.next_line()) file.fail(text("the file ends after ", i, " of ", mesh.vertex_count, " nodes"));
  };
  mesh.points.reserve(static_cast<std::size_t>(mesh.vertex_count) * 3);
  mesh.vertex_tags.reserve(static_cast<std::size_t>(mesh.vertex_count));
  for (Index i = 0; i < mesh.vertex_count; ++i) {
    next_node(i);
    mesh.vertex_tags.push_back(file.integer("a node number", 1, any));
    for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(file.real("a coordinate"));
    file.end_line();
  }
  NodePositions positions(mesh.vertex_tags);
  if (const Index repeated = positions.repeated(); repeated >= 0) {
    file.rewind(start);
    for (Index i = 0; i < repeated; ++i) {
      next_node(i);
      file.skip_line();
    }
    next_node(repeated);
    file.fail(text("node number ", mesh.vertex_tags[static_cast<std::size_t>(repeated)],
                   " is given twice; expected every node once"));
  }
  return positions;
}

// The number of nodes of an element that is a simplex, by Gmsh's type; refuses every other.
std::size_t element_width(const Cursor& file, std::int64_t type) {
  switch (type) {
    case 15:
      return 1;
    case 1:
      return 2;
    case 2:
      return 3;
    case 4:
      return 4;
    default:
      break;
  }
  const char* name = type == 3                 ? "a quadrangle"
                     : type == 5               ? "a hexahedron"
                     : type == 6               ? "a prism"
                     : type == 7               ? "a pyramid"
                     : type >= 8 && type <= 31 ? "an element of higher order"
                                               : "not known";
  file.fail(
      text("element type ", type, " is ", name,
           "; expected points (15), lines (1), triangles (2) or tetrahedra (4): mesh with simplices of first order"));
}

void read_elements(Cursor& file, const NodePositions& nodes, ListedSimplices& rows) {
  if (!file.next_line()) file.fail_token("the number of elements", nullptr);
  const Index count = file.count("the number of elements", 8);
  file.end_line();
  std::array<Index, 4> row{};
  for (Index i = 0; i < count; ++i) {
    if (!file.next_line()) file.fail(text("the file ends after ", i, " of ", count, " elements"));
    const auto number = file.integer("an element number");
    const auto width = element_width(file, file.integer("an element type"));
    const auto tags = file.integer("the number of tags", 0, any);
    for (std::int64_t tag = 0; tag < tags; ++tag) (void)file.integer("a tag");
    for (std::size_t v = 0; v < width; ++v) {
      const auto node = file.integer("a node number");
      row[v] = nodes[node];
      if (row[v] < 0) file.fail(text("node number ", node, " is not among the nodes of this file"));
    }
    file.end_line();
    rows.add(std::span(row).first(width), number);
  }
}

void demand_line(Cursor& file, const std::string& line) {
  if (!file.next_line()) file.fail_token(line.c_str(), nullptr);
  const auto start = file.offset();
  if (file.word(line.c_str()) == line && file.at_line_end()) return;
  file.rewind(start);
  file.fail_token(line.c_str(), nullptr);
}

}  // namespace

MeshData read_gmsh(Cursor& file, const ReadOptions&) {
  MeshData mesh;
  mesh.ambient_dimension = 3;
  std::optional<NodePositions> nodes;
  ListedSimplices rows;
  bool has_header = false, has_elements = false;
  while (file.next_line()) {
    const auto start = file.offset();
    const auto section = file.word("a section");
    const auto refuse = [&](const std::string& message) {
      file.rewind(start);
      file.fail(message);
    };
    if (section.size() < 2 || section[0] != '$' || section.starts_with("$End"))
      refuse(text("found ", quoted_token(section), ", expected the start of a section such as $Nodes"));
    file.end_line();
    if (!has_header && section != "$MeshFormat" && section != "$Comments")
      refuse(text("found ", quoted_token(section), ", expected $MeshFormat: the file is not in Gmsh format 2.2"));

    const std::string end = "$End" + std::string(section.substr(1));
    if (section == "$MeshFormat") {
      if (std::exchange(has_header, true)) refuse("a second section $MeshFormat");
      read_header(file);
    } else if (section == "$Nodes") {
      if (nodes) refuse("a second section $Nodes");
      nodes = read_nodes(file, mesh);
    } else if (section == "$Elements") {
      if (!nodes) refuse("$Elements stand before $Nodes");
      if (std::exchange(has_elements, true)) refuse("a second section $Elements");
      read_elements(file, *nodes, rows);
    } else if (!file.skip_past_line(end)) {
      refuse(text("the section ", quoted_token(section), " is not closed by ", quoted_token(end)));
    } else {
      continue;
    }
    demand_line(file, end);
  }
  if (!nodes) file.fail("the file has no section $Nodes");
  if (!has_elements) file.fail("the file has no section $Elements");
  std::move(rows).move_to(mesh);
  return mesh;
}

void write_gmsh(TextWriter& file, const MeshData& mesh, const WriteOptions&) {
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  file.put("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n").put(mesh.vertex_count).put('\n');
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i) {
    file.put(i + 1);
    for (std::size_t axis = 0; axis < 3; ++axis) file.put(' ').put(axis < m ? mesh.points[i * m + axis] : 0.0);
    file.put('\n');
  }
  file.put("$EndNodes\n$Elements\n").put(mesh.simplices.size()).put('\n');
  constexpr std::array element_types{15, 1, 2, 4};
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    const auto row = mesh.simplices[i];
    // Gmsh wants two tags: the physical and the geometric entity. Everything belongs to entity 1.
    file.put(i + 1).put(' ').put(element_types[row.size() - 1]).put(" 2 1 1");
    for (const Index v : row) file.put(' ').put(std::int64_t{v} + 1);
    file.put('\n');
  }
  file.put("$EndElements\n");
}

}  // namespace derham
