#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/gmsh_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t lowest_group = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t highest_group = std::numeric_limits<std::int32_t>::max();

void read_binary_nodes(GmshInput& input, MeshData& mesh) {
  constexpr std::int64_t record = 4 + 3 * 8;
  auto& file = input.file;
  const auto start = file.offset();
  const char* at = file.bytes(record * mesh.vertex_count, "the list of nodes").data();
  const bool swap = input.swaps();
  for (Index i = 0; i < mesh.vertex_count; ++i, at += record) {
    const auto tag = load<std::int32_t>(at, swap);
    const std::array position{load<double>(at + 4, swap), load<double>(at + 12, swap), load<double>(at + 20, swap)};
    const bool is_finite = std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
    if (tag < 1 || !is_finite) {
      file.rewind(start + record * i);
      file.fail(is_finite ? text("a node number is ", tag, ", expected at least 1")
                          : text("a coordinate of node ", tag, " is not a finite number"));
    }
    mesh.vertex_tags.push_back(tag);
    mesh.points.insert(mesh.points.end(), position.begin(), position.end());
  }
}

void read_text_elements(GmshReading& reading, Index count) {
  auto& file = reading.input.file;
  auto& elements = reading.elements;
  std::array<Index, 4> row{};
  for (Index i = 0; i < count; ++i) {
    reading.input.next_record("elements", i, count);
    const auto number = file.integer("an element number", 0, any);
    const auto type_number = file.integer("an element type");
    const auto type = gmsh_type(type_number, reading.options);
    if (type.degree < 0) fail_gmsh_type(file, type_number);
    const auto tags = file.integer("the number of tags", 0, any);
    const auto group = tags > 0 ? file.integer("a physical group", lowest_group, highest_group) : 0;
    for (std::int64_t tag = 1; tag < tags; ++tag) (void)file.integer("a tag");
    for (int v = 0; v < type.nodes; ++v) {
      const Index node = reading.node(file.integer("a node number"));
      if (v < 4) row[static_cast<std::size_t>(v)] = node;
    }
    file.end_line();
    elements.count_higher_order(type.is_higher_order() ? 1 : 0);
    elements.expect(type.degree, count - i);
    const Index position = elements.add(type, row, number);
    if (position < 0) reading.fail_repeated_element(number);
    reading.add_to_group(type.degree, group, position);
  }
}

// One block: elements of one type with the same number of tags. Returns how many.
Index read_block(GmshReading& reading, Index left) {
  auto& file = reading.input.file;
  auto& elements = reading.elements;
  const bool swap = reading.input.swaps();
  const auto start = file.offset();
  const char* at = file.bytes(12, "the header of a block of elements").data();
  const auto type_number = load<std::int32_t>(at, swap);
  const auto count = load<std::int32_t>(at + 4, swap);
  const auto tags = load<std::int32_t>(at + 8, swap);
  const auto refuse = [&](const std::string& message) {
    file.rewind(start);
    file.fail(message);
  };
  const auto type = gmsh_type(type_number, reading.options);
  if (type.degree < 0) {
    file.rewind(start);
    fail_gmsh_type(file, type_number);
  }
  if (count < 1 || count > left) refuse(text("a block of ", count, " elements, expected 1 to ", left));
  if (tags < 0) refuse(text("the number of tags is ", tags, ", expected at least 0"));
  const std::int64_t record = 4 * (std::int64_t{1} + tags + type.nodes);
  const auto first = file.offset();
  at = file.bytes(record * count, "a block of elements").data();

  elements.count_higher_order(type.is_higher_order() ? count : 0);
  elements.expect(type.degree, std::min(left, static_cast<Index>(count + file.remaining() / record)));
  std::array<Index, 4> row{};
  for (Index i = 0; i < count; ++i, at += record) {
    const auto refuse_element = [&](auto fail) {
      file.rewind(first + record * i);
      fail();
    };
    const auto number = load<std::int32_t>(at, swap);
    if (number < 0) refuse_element([&] { file.fail(text("an element number is ", number, ", expected at least 0")); });
    const char* node = at + 4 + std::int64_t{4} * tags;
    for (int v = 0; v < type.nodes; ++v, node += 4) {
      const auto tag = load<std::int32_t>(node, swap);
      const Index position = (*reading.nodes)[tag];
      if (position < 0) refuse_element([&] { reading.fail_node(tag); });
      if (v < 4) row[static_cast<std::size_t>(v)] = position;
    }
    const Index position = elements.add(type, row, number);
    if (position < 0) refuse_element([&] { reading.fail_repeated_element(number); });
    reading.add_to_group(type.degree, tags > 0 ? load<std::int32_t>(at + 4, swap) : 0, position);
  }
  return count;
}

}  // namespace

void read_gmsh_nodes_22(GmshReading& reading) {
  auto& input = reading.input;
  auto& mesh = reading.mesh;
  if (!input.file.next_line()) input.file.fail_token("the number of nodes", nullptr);
  mesh.vertex_count = input.count("the number of nodes", 8, 28);
  input.end_line_before_bytes();
  reserve_large(mesh.points, static_cast<std::size_t>(mesh.vertex_count) * 3);
  reserve_large(mesh.vertex_tags, static_cast<std::size_t>(mesh.vertex_count));
  const auto start = input.file.offset();
  if (input.is_binary()) {
    read_binary_nodes(input, mesh);
  } else {
    for (Index i = 0; i < mesh.vertex_count; ++i) {
      input.next_record("nodes", i, mesh.vertex_count);
      mesh.vertex_tags.push_back(input.file.integer("a node number", 1, any));
      for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(input.file.real("a coordinate"));
      input.file.end_line();
    }
  }
  const Index repeated = reading.number_nodes();
  if (repeated < 0) return;
  input.file.rewind(start);
  if (input.is_binary()) (void)input.file.bytes(std::int64_t{28} * repeated, "nodes");
  for (Index i = 0; i <= repeated && !input.is_binary(); ++i) {
    input.file.next_line();
    if (i < repeated) input.file.skip_line();
  }
  reading.fail_repeated_node(mesh.vertex_tags[static_cast<std::size_t>(repeated)]);
}

void read_gmsh_elements_22(GmshReading& reading) {
  auto& input = reading.input;
  if (!input.file.next_line()) input.file.fail_token("the number of elements", nullptr);
  const Index count = input.count("the number of elements", 8, 8);
  input.end_line_before_bytes();
  const auto start = input.file.offset();
  do {
    input.file.rewind(start);
    if (!input.is_binary()) {
      read_text_elements(reading, count);
      continue;
    }
    for (Index done = 0; done < count;) done += read_block(reading, count - done);
  } while (reading.elements.must_read_again());
}

}  // namespace derham
