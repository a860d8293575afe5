#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/gmsh_reading.hpp"
#include "derham/io/unused_vertices.hpp"

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr std::size_t longest_section_name = 64;

void demand_line(Cursor& file, const std::string& line) {
  if (!file.next_line()) file.fail_token(line.c_str(), nullptr);
  const auto start = file.offset();
  if (file.word(line.c_str()) == line && file.at_line_end()) return;
  file.rewind(start);
  file.fail_token(line.c_str(), nullptr);
}

// Moves behind the line `end`. Bytes of a binary file may look like anything, so there only the whole word behind the
// end of a line counts.
bool skip_section(GmshInput& input, const std::string& end) {
  if (!input.is_binary()) return input.file.skip_past_line(end);
  auto& file = input.file;
  const auto start = file.offset();
  const auto rest = file.bytes(file.remaining(), "a section");
  const std::string line = "\n" + end;
  for (auto at = rest.find(line); at != std::string_view::npos; at = rest.find(line, at + 1)) {
    file.rewind(start + static_cast<std::int64_t>(at + line.size()));
    if (file.at_line_end()) return true;
  }
  return false;
}

MeshData finished(GmshReading reading) {
  auto& mesh = reading.mesh;
  for (const auto& [key, field] : reading.fields)
    if (field.second > 1)
      mesh.notes.push_back(
          text("field ", quoted_token(key.second), " is given ", field.second, " times (time steps): kept the last"));
  if (reading.elements.merged() > 0)
    mesh.notes.push_back(text(reading.elements.merged(),
                              reading.elements.merged() == 1 ? " element is" : " elements are",
                              " listed again, with the same number and nodes: each is kept once, in all the parts "
                              "it is listed in"));
  std::move(reading.elements.simplices()).move_to(mesh);
  for (const auto& part : mesh.parts)
    if (part.degree > mesh.simplices.dimension())
      mesh.notes.push_back(text("dropped physical group ", part.number, " of dimension ", part.degree, " (",
                                quoted_token(part.name), "): it has no elements"));
  std::erase_if(mesh.parts, [&](const MeshPart& part) { return part.degree > mesh.simplices.dimension(); });
  split_quadrangles(mesh, reading.elements.quadrangles());
  drop_mid_nodes(mesh, reading.elements.higher_order(), "elements");
  return std::move(mesh);
}

}  // namespace

void GmshReading::fail_node(std::int64_t tag) const {
  input.file.fail(text("node number ", tag, " is not among the nodes of this file"));
}
void GmshReading::fail_repeated_node(std::int64_t tag) const {
  input.file.fail(text("node number ", tag, " is given twice; expected every node once"));
}
void GmshReading::fail_repeated_element(std::int64_t tag) const {
  input.file.fail(text("element number ", tag,
                       " is given twice with other nodes; expected every number once, or again with the same nodes in "
                       "the same order"));
}

Index GmshReading::number_nodes() {
  nodes.emplace(mesh.vertex_tags);
  return nodes->repeated();
}

MeshData read_gmsh(Cursor& file, const ReadOptions& options) {
  GmshReading reading(file, options);
  auto& input = reading.input;
  reading.mesh.ambient_dimension = 3;
  bool has_header = false, has_names = false, has_elements = false;
  std::set<std::string, std::less<>> skipped;
  while (file.next_line()) {
    const auto start = file.offset();
    const auto section = file.word("a section");
    const auto refuse = [&](const std::string& message) {
      file.rewind(start);
      file.fail(message);
    };
    const auto demand = [&](bool condition, const char* message) {
      if (!condition) refuse(message);
    };
    if (section == "$NOD")
      refuse(
          "this is Gmsh format 1.0; expected 2.2 or 4.1: convert it with gmsh -save -save_all -format msh41 -o "
          "NEW.msh OLD.msh");
    if (section.size() < 2 || section.size() > longest_section_name || section[0] != '$' || section.starts_with("$End"))
      refuse(text("found ", quoted_token(section), ", expected the start of a section such as $Nodes"));
    if (!has_header && section != "$MeshFormat" && section != "$Comments")
      refuse(
          text("found ", quoted_token(section), ", expected $MeshFormat: the file is not in Gmsh format 2.2 or 4.1"));
    file.end_line();

    const std::string name(section), end = "$End" + name.substr(1);
    // Behind its first line a section of a binary file may be bytes.
    const auto enter = [&] {
      if (input.is_41()) input.end_line_before_bytes();
    };
    if (name == "$MeshFormat") {
      demand(!std::exchange(has_header, true), "a second section $MeshFormat");
      input.read_header();
    } else if (name == "$PhysicalNames") {
      demand(!std::exchange(has_names, true), "a second section $PhysicalNames");
      read_gmsh_names(reading);
    } else if (name == "$Nodes") {
      demand(!reading.nodes, "a second section $Nodes");
      enter();
      input.is_41() ? read_gmsh_nodes_41(reading) : read_gmsh_nodes_22(reading);
    } else if (name == "$Elements") {
      demand(reading.nodes.has_value(), "$Elements stand before $Nodes");
      demand(!std::exchange(has_elements, true), "a second section $Elements");
      enter();
      input.is_41() ? read_gmsh_elements_41(reading) : read_gmsh_elements_22(reading);
    } else if (input.is_41() && (name == "$Entities" || name == "$PartitionedEntities")) {
      demand(!has_elements, "entities stand behind $Elements, expected before");
      enter();
      read_gmsh_entities(reading, name == "$PartitionedEntities");
    } else if (name == "$NodeData" || name == "$ElementData") {
      demand(has_elements, "data stand before $Elements, expected behind");
      read_gmsh_field(reading, name == "$NodeData" ? MeshField::On::vertices : MeshField::On::rows);
    } else if (skip_section(input, end)) {
      if (name != "$Comments" && skipped.insert(name).second)
        reading.mesh.notes.push_back(text("skipped the section ", quoted_token(name)));
      continue;
    } else {
      refuse(text("the section ", quoted_token(name), " is not closed by ", quoted_token(end)));
    }
    demand_line(file, end);
  }
  if (!reading.nodes) file.fail("the file has no section $Nodes");
  if (!has_elements) file.fail("the file has no section $Elements");
  return finished(std::move(reading));
}

}  // namespace derham
