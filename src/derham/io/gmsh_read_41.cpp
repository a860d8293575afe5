#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/gmsh_groups.hpp"
#include "derham/io/gmsh_reading.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();

// The first line of a section of blocks: returns the numbers of blocks and of items.
std::pair<Index, Index> read_block_counts(GmshInput& input, const char* items, std::int64_t text_bytes,
                                          std::int64_t binary_bytes) {
  if (!input.is_binary() && !input.file.next_line()) input.file.fail_token("the number of blocks", nullptr);
  const Index blocks = input.count("the number of blocks", 8, std::int64_t{12} + input.size_width());
  const Index count = input.count(items, text_bytes, binary_bytes);
  // Many writers are careless with these two, and nothing depends on them.
  (void)input.size("the lowest number");
  (void)input.size("the highest number");
  input.end_record();
  return {blocks, count};
}

struct Block {
  int dimension;
  std::int64_t entity;
  std::int64_t kind;  // whether nodes have parameters, or the type of the elements
  Index count;
};

Block read_block_header(GmshReading& reading, const char* kind, const char* items, Index left) {
  auto& input = reading.input;
  Block block{};
  block.dimension = static_cast<int>(input.integer("the dimension of an entity", 0, 3));
  block.entity = input.integer("the number of an entity");
  block.kind = input.integer(kind);
  const auto count = input.size(items);
  if (count > left) input.file.fail(text(items, " is ", count, ", expected at most ", left, ": so many are left"));
  block.count = static_cast<Index>(count);
  input.end_record();
  return block;
}

void read_text_nodes(GmshInput& input, MeshData& mesh, Index count, int parameters) {
  for (Index i = 0; i < count; ++i) {
    input.next_record("nodes of this block", i, count);
    mesh.vertex_tags.push_back(input.file.integer("a node number", 1, any));
    input.file.end_line();
  }
  for (Index i = 0; i < count; ++i) {
    input.next_record("positions of this block", i, count);
    for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(input.file.real("a coordinate"));
    for (int p = 0; p < parameters; ++p) (void)input.file.real("a parameter");
    input.file.end_line();
  }
}

void read_binary_nodes(GmshInput& input, MeshData& mesh, Index count, int parameters) {
  auto& file = input.file;
  const auto refuse = [&](std::int64_t offset, const char* message) {
    file.rewind(offset);
    file.fail(message);
  };
  auto start = file.offset();
  const auto width = std::int64_t{input.size_width()};
  const char* at = file.bytes(width * count, "the node numbers of a block").data();
  for (Index i = 0; i < count; ++i, at += width) {
    const auto tag = input.load_size(at);
    if (tag < 1) refuse(start + width * i, "a node number is 0 or beyond 63 bits, expected at least 1");
    mesh.vertex_tags.push_back(tag);
  }
  start = file.offset();
  const auto record = std::int64_t{8} * (3 + parameters);
  at = file.bytes(record * count, "the positions of a block").data();
  const bool swap = input.swaps();
  for (Index i = 0; i < count; ++i, at += record) {
    const std::array position{load<double>(at, swap), load<double>(at + 8, swap), load<double>(at + 16, swap)};
    if (!std::isfinite(position[0]) || !std::isfinite(position[1]) || !std::isfinite(position[2]))
      refuse(start + record * i, "a coordinate is not a finite number");
    mesh.points.insert(mesh.points.end(), position.begin(), position.end());
  }
}

// With `watched` >= 0: refuses that node, whose number is `repeated`, at its place.
void read_node_blocks(GmshReading& reading, Index blocks, Index count, Index watched, std::int64_t repeated) {
  auto& input = reading.input;
  auto& mesh = reading.mesh;
  Index done = 0;
  for (Index b = 0; b < blocks; ++b) {
    input.next_record("blocks of nodes", b, blocks);
    const auto block =
        read_block_header(reading, "the flag of parameters", "the number of nodes of a block", count - done);
    if (block.kind != 0 && block.kind != 1)
      input.file.fail(text("the flag of parameters is ", block.kind, ", expected 0 or 1"));
    if (watched >= 0 && watched < done + block.count) {
      if (input.is_binary()) (void)input.file.bytes(std::int64_t{input.size_width()} * (watched - done), "nodes");
      for (; !input.is_binary() && done <= watched; ++done) {
        input.file.next_line();
        if (done < watched) input.file.skip_line();
      }
      reading.fail_repeated_node(repeated);
    }
    const int parameters = block.kind == 1 ? block.dimension : 0;
    if (input.is_binary())
      read_binary_nodes(input, mesh, block.count, parameters);
    else
      read_text_nodes(input, mesh, block.count, parameters);
    done += block.count;
  }
  if (done < count) input.file.fail(text("the blocks hold ", done, " nodes, the section said ", count));
}

struct ElementBlock {
  Index count;
  GmshType type;
  const std::vector<std::int64_t>* groups;  // null if none
};

// Puts an element into the mesh; false if its number belongs to another.
bool place(GmshReading& reading, const ElementBlock& block, const std::array<Index, 4>& row, std::int64_t number) {
  const Index position = reading.elements.add(block.type, row, number);
  if (position < 0) return false;
  if (block.groups != nullptr)
    for (const auto group : *block.groups) reading.add_to_group(block.type.degree, group, position);
  return true;
}

void read_text_elements(GmshReading& reading, const ElementBlock& block) {
  auto& file = reading.input.file;
  std::array<Index, 4> row{};
  for (Index i = 0; i < block.count; ++i) {
    reading.input.next_record("elements of this block", i, block.count);
    const auto number = file.integer("an element number", 0, any);
    for (std::size_t v = 0; v < static_cast<std::size_t>(block.type.nodes); ++v) {
      const Index node = reading.node(file.integer("a node number"));
      if (v < 4) row[v] = node;
    }
    file.end_line();
    if (!place(reading, block, row, number)) reading.fail_repeated_element(number);
  }
}

void read_binary_elements(GmshReading& reading, const ElementBlock& block) {
  auto& input = reading.input;
  auto& file = input.file;
  const auto start = file.offset();
  const auto width = input.size_width();
  const auto record = std::int64_t{width} * (1 + block.type.nodes);
  const char* at = file.bytes(record * block.count, "a block of elements").data();
  std::array<Index, 4> row{};
  for (Index i = 0; i < block.count; ++i, at += record) {
    const auto go_back = [&] { file.rewind(start + record * i); };
    const auto number = input.load_size(at);
    if (number < 0) {
      go_back();
      file.fail("an element number is beyond 63 bits");
    }
    const char* node = at + width;
    for (std::size_t v = 0; v < static_cast<std::size_t>(block.type.nodes); ++v, node += width) {
      const auto tag = input.load_size(node);
      const Index position = (*reading.nodes)[tag];
      if (position < 0) {
        go_back();
        reading.fail_node(tag);
      }
      if (v < 4) row[v] = position;
    }
    if (!place(reading, block, row, number)) {
      go_back();
      reading.fail_repeated_element(number);
    }
  }
}

void read_element_blocks(GmshReading& reading, Index blocks, Index count) {
  auto& input = reading.input;
  const auto most_memberships = gmsh_memberships_per_byte * (input.file.offset() + input.file.remaining());
  std::int64_t memberships = 0;
  Index done = 0;
  for (Index b = 0; b < blocks; ++b) {
    input.next_record("blocks of elements", b, blocks);
    const auto start = input.file.offset();
    const auto header =
        read_block_header(reading, "the type of elements", "the number of elements of a block", count - done);
    const auto type = gmsh_type(header.kind, reading.options);
    if (type.degree != header.dimension) {
      input.file.rewind(start);
      if (type.degree < 0) fail_gmsh_type(input.file, header.kind);
      input.file.fail(text("elements of type ", header.kind, ", which has dimension ", static_cast<int>(type.degree),
                           ", on an entity of dimension ", header.dimension));
    }
    const auto entity = reading.groups.find({header.dimension, header.entity});
    const ElementBlock block{header.count, type, entity == reading.groups.end() ? nullptr : &entity->second};
    memberships += block.groups == nullptr ? 0 : std::int64_t{block.count} * std::ssize(*block.groups);
    if (memberships > most_memberships) {
      input.file.rewind(start);
      input.file.fail(text("with this block the elements are in ", memberships,
                           " physical groups in all; expected at most ", most_memberships, ", ",
                           gmsh_memberships_per_byte, " per byte of the file"));
    }
    reading.elements.count_higher_order(type.is_higher_order() ? block.count : 0);
    reading.elements.expect(type.degree, count - done);
    if (input.is_binary())
      read_binary_elements(reading, block);
    else
      read_text_elements(reading, block);
    done += block.count;
  }
  if (done < count) input.file.fail(text("the blocks hold ", done, " elements, the section said ", count));
}

}  // namespace

void read_gmsh_nodes_41(GmshReading& reading) {
  auto& input = reading.input;
  auto& mesh = reading.mesh;
  const auto start = input.file.offset();
  const auto [blocks, count] =
      read_block_counts(input, "the number of nodes", 8, std::int64_t{24} + input.size_width());
  mesh.vertex_count = count;
  reserve_large(mesh.points, static_cast<std::size_t>(count) * 3);
  reserve_large(mesh.vertex_tags, static_cast<std::size_t>(count));
  read_node_blocks(reading, blocks, count, -1, 0);
  if (const Index repeated = reading.number_nodes(); repeated >= 0) {
    const auto tag = mesh.vertex_tags[static_cast<std::size_t>(repeated)];
    mesh.vertex_tags.clear();
    mesh.points.clear();
    input.file.rewind(start);
    (void)read_block_counts(input, "the number of nodes", 8, std::int64_t{24} + input.size_width());
    read_node_blocks(reading, blocks, count, repeated, tag);
  }
}

void read_gmsh_elements_41(GmshReading& reading) {
  auto& input = reading.input;
  const auto [blocks, count] =
      read_block_counts(input, "the number of elements", 4, std::int64_t{2} * input.size_width());
  const auto start = input.file.offset();
  do {
    input.file.rewind(start);
    read_element_blocks(reading, blocks, count);
  } while (reading.elements.must_read_again());
}

}  // namespace derham
