#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::gmsh, "mesh"); }

constexpr std::array variants{gmsh_22_text,   gmsh_22_binary,     gmsh_22_big_endian, gmsh_41_text,
                              gmsh_41_binary, gmsh_41_big_endian, gmsh_41_binary_32,  gmsh_41_big_endian_32};
constexpr std::array binaries{gmsh_22_binary,     gmsh_22_big_endian, gmsh_41_binary,
                              gmsh_41_big_endian, gmsh_41_binary_32,  gmsh_41_big_endian_32};

TEST(GmshVariants, AreOneMesh) {
  for (const auto bytes : variants) {
    SCOPED_TRACE(bytes.substr(12, 7));
    const auto mesh = read(bytes);
    EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
    EXPECT_EQ(mesh.ambient_dimension, 3);
    EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{10, 12, 11, 40, 41}));
    EXPECT_EQ(mesh.row_tags, (std::vector<std::int64_t>{5, 9}));
    EXPECT_EQ(mesh.lower, (std::vector<SimplexList>{SimplexList{{0}}, SimplexList{}, SimplexList{{0, 1, 2}}}));
    EXPECT_EQ(mesh.parts,
              (std::vector<MeshPart>{{"the \"solid\"", 7, 3, {0, 1}}, {"", 8, 3, {1}}, {"wall", 3, 2, {0}}}));
    EXPECT_EQ(mesh.fields, (std::vector<MeshField>{{"T", MeshField::On::vertices, 1, {0.5, 1e-3, -2, 7, 0}},
                                                   {"flux", MeshField::On::rows, 3, {1, 2, 3, 4, 5, 6}}}));
    std::vector<std::string> notes{"field 'flux': dropped 1 values on simplices of lower dimension",
                                   "skipped the section '$Strange'"};
    if (bytes[12] == '2')
      notes.emplace_back(
          "1 element is listed again, with the same number and nodes: each is kept once, in all the parts it is "
          "listed in");
    EXPECT_EQ(mesh.notes, notes);
  }
}

TEST(GmshVariants, AreReadOnlyUpToTheEndOfASection) {
  for (const auto bytes : variants)
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      auto begun = bytes.substr(0, length);
      while (begun.ends_with('\n')) begun.remove_suffix(1);
      if (begun.ends_with("$EndElements") || begun.ends_with("$EndNodeData") || begun.ends_with("$EndElementData") ||
          begun.ends_with("\n$EndStrange"))
        EXPECT_EQ(read(bytes.substr(0, length)).simplices.size(), 2);
      else
        EXPECT_THROW((void)read(bytes.substr(0, length)), FileError) << length;
    }
}

// Where the bytes of a section begin, behind the line that opens it (and `lines` more).
std::size_t bytes_of(std::string_view file, std::string_view section, int lines) {
  auto at = file.find(section);
  for (int i = 0; i <= lines; ++i) at = file.find('\n', at) + 1;
  return at;
}

// `file` with an int, double or size_t at `at` replaced, in the byte order of the file.
template <class Number>
std::string with(std::string_view file, std::size_t at, Number value) {
  const bool is_big = file[file.find('\n', 12) + 1] == 0;
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (is_big) std::ranges::reverse(bytes);
  std::string out(file);
  std::ranges::copy(bytes, out.begin() + static_cast<std::ptrdiff_t>(at));
  return out;
}

void refused(const std::string& bytes, std::size_t at, const std::string& part) {
  expect_refused(bytes, MeshFormat::gmsh, 0, std::string("byte ").append(std::to_string(at)).append(": "));
  expect_refused(bytes, MeshFormat::gmsh, 0, part);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(GmshBinary, RefusesTheWrongByteOrderNumber) {
  for (const auto file : binaries) refused(with(file, 20, std::int32_t{2}), 20, "expected 1");
  expect_refused("$MeshFormat\n2.2 1 4\n", MeshFormat::gmsh, 2, "the data size is 4, expected 8");
}

TEST(GmshBinary, RefusesDamage22) {
  for (const auto file : {gmsh_22_binary, gmsh_22_big_endian}) {
    const auto nodes = bytes_of(file, "$Nodes", 1);
    refused(with(file, nodes, 0), nodes, "a node number is 0");
    refused(with(file, nodes + 28 + 4, infinity), nodes + 28, "a coordinate of node 12 is not a finite number");
    refused(with(file, nodes + 56, 10), nodes + 56, "node number 10 is given twice");
    const auto elements = bytes_of(file, "$Elements", 1);
    refused(with(file, elements, 5), elements, "a hexahedron");
    refused(with(file, elements, 11), elements, "higher order");
    refused(with(file, elements + 4, 6), elements, "a block of 6 elements, expected 1 to 5");
    refused(with(file, elements + 4, 0), elements, "a block of 0 elements, expected 1 to 5");
    refused(with(file, elements + 8, -1), elements, "the number of tags is -1");
    refused(with(file, elements + 8, 2000000000), elements + 12, "takes 8000000008 bytes");
    refused(with(file, elements + 12, -1), elements + 12, "an element number is -1");
    refused(with(file, elements + 24, 13), elements + 12, "node number 13 is not among");
    // The last element, which is given twice.
    const auto last = file.find("\n$EndElements") - 32;
    refused(with(file, last + 28, 10), last, "element number 9 is given twice");
  }
}

TEST(GmshBinary, RefusesDamage41) {
  for (const auto file : {gmsh_41_binary, gmsh_41_big_endian}) {
    using Size = std::uint64_t;
    const auto nodes = bytes_of(file, "$Nodes", 0);
    refused(with(file, nodes, Size{1} << 40), nodes + 8, "cannot hold so many");
    refused(with(file, nodes, Size{1} << 63), nodes + 8, "the number of blocks is 9223372036854775808");
    refused(with(file, nodes + 8, Size{6}), file.find("\n$EndNodes"), "the blocks hold 5 nodes, the section said 6");
    const auto block = nodes + 32;
    refused(with(file, block, 4), block + 4, "the dimension of an entity is 4, expected 0 to 3");
    refused(with(file, block + 8, 2), block + 20, "the flag of parameters is 2");
    refused(with(file, block + 12, Size{6}), block + 20, "the number of nodes of a block is 6, expected at most 5");
    refused(with(file, block + 28, Size{0}), block + 28, "a node number is 0");
    refused(with(file, block + 28, Size{10}), block + 28, "node number 10 is given twice");
    refused(with(file, block + 20 + 24 + 40, infinity), block + 20 + 24 + 40, "not a finite number");
    const auto elements = bytes_of(file, "$Elements", 0) + 32;
    refused(with(file, elements, 1), elements,
            "elements of type 15, which has dimension 0, on an entity of dimension 1");
    refused(with(file, elements + 8, 3), elements, "a quadrangle");
    refused(with(file, elements + 12, Size{5}), elements + 20,
            "the number of elements of a block is 5, expected at most 4");
    refused(with(file, elements + 20, Size{1} << 63), elements + 20, "beyond 63 bits");
    refused(with(file, elements + 28, Size{13}), elements + 20, "node number 13 is not among");
    refused(with(file, elements + 20, Size{9}), file.find("\n$EndElements") - 40, "element number 9 is given twice");
    const auto entities = bytes_of(file, "$Entities", 0);
    refused(with(file, entities + 8, Size{1} << 33), entities + 16, "cannot hold so many");
  }
}

TEST(GmshBinary, RefusesDamagedFields) {
  for (const auto file : binaries) {
    const auto values = bytes_of(file, "$NodeData", 8);
    refused(with(file, values, 13), values + 4, "node number 13 is not among");
    refused(with(file, values + 12, 10), values + 12, "number 10 has two values in field 'T'");
    refused(with(file, values + 4, infinity), values, "a value of field 'T' is not a finite number");
    const auto rows = bytes_of(file, "$ElementData", 8);
    refused(with(file, rows, 6), rows + 4, "element number 6 is not among");
  }
}

}  // namespace
}  // namespace derham::io_test
