#pragma once

#include "derham/geometry/mesh_data.hpp"
#include "derham/io/gmsh_elements.hpp"
#include "derham/io/gmsh_input.hpp"
#include "derham/io/gmsh_tags.hpp"
#include "derham/io/options.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The sections of a .msh file. Each function begins behind the line that opens the section and ends where the one that
// closes it is expected. Not installed.
namespace derham {

/// A .msh file while it is read.
struct GmshReading {
  GmshReading(Cursor& file, const ReadOptions& read_options) : input(file), options(read_options) {}

  /// The position of a node; refuses, at the cursor, one that the file has not.
  [[nodiscard]] Index node(std::int64_t tag) const {
    const Index position = (*nodes)[tag];
    if (position < 0) fail_node(tag);
    return position;
  }
  [[noreturn]] void fail_node(std::int64_t tag) const;
  /// After the nodes are read: makes them known; returns the first whose number an earlier one has, -1 if none has.
  Index number_nodes();
  [[noreturn]] void fail_repeated_node(std::int64_t tag) const;
  [[noreturn]] void fail_repeated_element(std::int64_t tag) const;
  /// Puts element `position` of `degree` into the physical group with this number, 0 for none. A negative number is
  /// that of the group in which the element is turned over.
  void add_to_group(int degree, std::int64_t number, Index position) {
    if (number != 0) elements.simplices().add_to_part(degree, number < 0 ? -number : number, position);
  }

  GmshInput input;
  ReadOptions options;
  MeshData mesh;
  std::optional<TagPositions> nodes;
  GmshElements elements;
  /// The physical groups of an entity of format 4.1, by its dimension and number.
  std::map<std::pair<int, std::int64_t>, std::vector<std::int64_t>> groups;
  /// Where to find the elements of each degree by number, once a field needs it.
  std::array<std::optional<TagPositions>, 4> element_positions{};
  /// For every field its number among mesh.fields and how often the file gives it.
  std::map<std::pair<MeshField::On, std::string>, std::pair<std::size_t, Index>> fields;
};

void read_gmsh_names(GmshReading& reading);
void read_gmsh_nodes_22(GmshReading& reading);
void read_gmsh_elements_22(GmshReading& reading);
void read_gmsh_entities(GmshReading& reading, bool partitioned);
void read_gmsh_nodes_41(GmshReading& reading);
void read_gmsh_elements_41(GmshReading& reading);
void read_gmsh_field(GmshReading& reading, MeshField::On on);

}  // namespace derham
