#include "io/stl_samples.hpp"

#include "derham/io/write_mesh.hpp"
#include "io/io_fixture.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::stl, "mesh"); }
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::stl, line, part);
}

std::string replaced(std::string_view bytes, const std::string& old, const std::string& by) {
  std::string out(bytes);
  return out.replace(out.find(old), old.size(), by);
}

const SimplexList tetrahedron{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 3}};
const std::vector<double> corners{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};

TEST(Stl, WeldsEqualPositionsOfTextAndOfBytes) {
  for (const auto sample : {stl_ascii_sample, stl_binary_sample}) {
    const auto mesh = read(sample);
    EXPECT_EQ(mesh.simplices, tetrahedron);
    EXPECT_EQ(mesh.points, corners);
    EXPECT_EQ(mesh.vertex_count, 4);
    EXPECT_EQ(mesh.ambient_dimension, 3);
    EXPECT_EQ(mesh.notes, std::vector<std::string>{"welded 12 corners of 4 triangles to 4 vertices"});
    EXPECT_EQ(detect_format("stdin", sample), MeshFormat::stl);
  }
}

TEST(Stl, SeveralSolidsAreParts) {
  const auto mesh = read(stl_ascii_sample);
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_EQ(mesh.parts[0], (MeshPart{"lower part", 1, 2, {0, 1}}));
  EXPECT_EQ(mesh.parts[1], (MeshPart{"upper", 2, 2, {2, 3}}));
  EXPECT_TRUE(read("solid alone\nendsolid alone\n").parts.empty());
}

TEST(Stl, ZerosOfEitherSignAreOnePlace) {
  const auto mesh = read(replaced(stl_ascii_sample, "vertex 0 0 0", "vertex -0 0 -0.0"));
  EXPECT_EQ(mesh.simplices, tetrahedron);
  EXPECT_TRUE(std::signbit(mesh.points[0]));  // as the first corner there has it
}

TEST(Stl, NearlyEqualPositionsAreTwo) {
  EXPECT_EQ(read(replaced(stl_ascii_sample, "vertex 0 0 0", "vertex 1e-300 0 0")).vertex_count, 5);
}

// Corners are looked up many at a time in a table that begins with room for a closed surface: here with two triangles
// for every vertex, then with three vertices for every triangle. The last lookup is of fewer.
TEST(Stl, WeldsManyCorners) {
  if constexpr (std::endian::native != std::endian::little)
    GTEST_SKIP() << "the test writes in the order of this machine";
  constexpr Index cells = 31;
  for (const bool is_connected : {true, false}) {
    std::vector<double> positions;
    for (Index cell = 0; cell < cells * cells; ++cell)
      for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
        const auto number = static_cast<Index>(positions.size() / 3);
        for (const Index x : {cell % cells + dx, cell / cells + dy, is_connected ? 0 : number})
          positions.push_back(static_cast<double>(x));
      }
    const auto rows = positions.size() / 9;
    std::string bytes(80, ' ');
    const auto put = [&bytes](auto number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
    put(static_cast<std::uint32_t>(rows));
    for (std::size_t row = 0; row < rows; ++row) {
      bytes.append(12, '\0');
      for (std::size_t i = 0; i < 9; ++i) put(static_cast<float>(positions[9 * row + i]));
      bytes.append(2, '\0');
    }
    const auto mesh = read(bytes);
    ASSERT_EQ(mesh.simplices.size(), static_cast<Offset>(rows));
    EXPECT_EQ(mesh.vertex_count, is_connected ? (cells + 1) * (cells + 1) : static_cast<Index>(3 * rows));
    ASSERT_EQ(mesh.points.size(), 3 * static_cast<std::size_t>(mesh.vertex_count));
    std::vector<double> found;
    for (const Index v : mesh.simplices.vertices())
      found.insert(found.end(), &mesh.points[3 * static_cast<std::size_t>(v)],
                   &mesh.points[3 * static_cast<std::size_t>(v)] + 3);
    EXPECT_EQ(found, positions);
  }
}

TEST(Stl, FlatTrianglesKeepTheirRows) {
  const auto mesh = read(replaced(stl_ascii_sample, "vertex 0 1 0", "vertex 0 0 0"));
  EXPECT_EQ(mesh.simplices.size(), 4);
  EXPECT_EQ(mesh.simplices[0][0], mesh.simplices[0][1]);
}

TEST(Stl, LettersMayBeCapital) {
  EXPECT_EQ(read("SOLID\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\n"
                 "ENDSOLID\n")
                .simplices,
            (SimplexList{{0, 1, 2}}));
}

TEST(Stl, RefusesDamage) {
  refused("hello\n", 1, "'hello', expected solid");
  refused("solid a\n", 1, "the end of the file, expected facet or endsolid");
  refused("solid a\nendsolid a\nfacet\n", 3, "expected solid or the end of the file");
  refused(replaced(stl_ascii_sample, "normal 0 0 1e0", "normal 0 0 up"), 2, "'up'");
  refused(replaced(stl_ascii_sample, "normal", "norm"), 2, "'norm', expected normal");
  refused(replaced(stl_ascii_sample, "outer loop", "outer"), 4, "'vertex', expected loop");
  refused(replaced(stl_ascii_sample, "vertex 0 0 0", "vertex 0 0"), 4, "the end of the line");
  refused(replaced(stl_ascii_sample, "vertex 0 0 0", "vertex 0 0 inf"), 4, "finite");
  refused(replaced(stl_ascii_sample, "vertex 0 0 0", "vertex 0 0 0 0"), 4, "the end of the line");
  refused(replaced(stl_ascii_sample, "    endloop", "vertex 0 0 0\nendloop"), 7, "'vertex', expected endloop");
  refused(replaced(stl_ascii_sample, "      vertex 1 0 0\n", ""), 6, "'endloop', expected vertex");
}

TEST(Stl, NamesTheByteOfDamagedBinaryFiles) {
  const std::string sample = replaced(stl_binary_sample, "solid", "hello");
  auto nul = sample;
  nul[40] = '\0';
  refused(nul + "x", 0, "byte 80: the number of triangles is 4, which take 200 bytes, but 201 follow");
  refused(nul.substr(0, 84), 0, "which take 200 bytes, but 0 follow");
  refused(nul.substr(0, 60), 0, "the header takes 80 bytes, but the file ends after 60");
  nul = sample;
  nul[84 + 50 + 12 + 3] = '\x7f';
  nul[84 + 50 + 12 + 2] = '\x80';
  refused(nul, 0, "byte 146: a corner of triangle 1 is at (inf, 0, 0)");
}

TEST(Stl, WritesWhatItReads) {
  const TemporaryDirectory directory;
  auto mesh = read(stl_ascii_sample);
  for (const auto encoding : {WriteOptions::Encoding::ascii, WriteOptions::Encoding::usual}) {
    write_mesh(directory / "a.stl", mesh, MeshFormat::stl, {.encoding = encoding});
    const auto back = read_mesh(directory / "a.stl");
    EXPECT_EQ(back.simplices, mesh.simplices);
    EXPECT_EQ(back.points, mesh.points);
  }
  mesh.points[3] = 1.0 / 3;
  write_mesh(directory / "a.stl", mesh, MeshFormat::stl, {.encoding = WriteOptions::Encoding::ascii});
  EXPECT_EQ(read_mesh(directory / "a.stl").points, mesh.points);
  write_mesh(directory / "a.stl", mesh, MeshFormat::stl);
  EXPECT_EQ(read_mesh(directory / "a.stl").points[3], static_cast<double>(1.0F / 3));
}

TEST(Stl, CountsTheVerticesThatAreLost) {
  const TemporaryDirectory directory;
  const auto lost = [](const MeshData& mesh, WriteOptions::Encoding encoding) {
    auto phrases = not_carried(mesh, MeshFormat::stl, {.encoding = encoding});
    EXPECT_EQ(phrases.back(), "format stl does not hold the order of vertices");
    phrases.pop_back();
    return phrases;
  };
  constexpr auto ascii = WriteOptions::Encoding::ascii, binary = WriteOptions::Encoding::binary;
  auto mesh = read(stl_binary_sample);  // a tetrahedron
  mesh.vertex_count = 6;
  mesh.points.insert(mesh.points.end(), {0, 0, 0, 5, 5, 5});
  const std::vector<std::string> unused{"format stl does not hold vertices that no triangle uses (2)"};
  EXPECT_EQ(lost(mesh, ascii), unused);
  EXPECT_EQ(lost(mesh, binary), unused);

  mesh.vertex_count = 4;
  mesh.points = {0, 0, 0, 1e-300, -0.0, 0, 0, -0.0, 0, 1, 0, 0};
  const std::string one = "format stl makes one vertex of those at the same place: ";
  EXPECT_EQ(lost(mesh, ascii), std::vector{one + "1 fewer"});
  EXPECT_EQ(lost(mesh, binary),
            (std::vector<std::string>{"format stl holds positions as 32-bit numbers: 1 coordinates are rounded",
                                      one + "2 fewer"}));
  write_mesh(directory / "a.stl", mesh, MeshFormat::stl, {.encoding = ascii});
  EXPECT_EQ(read_mesh(directory / "a.stl").vertex_count, 3);
  write_mesh(directory / "a.stl", mesh, MeshFormat::stl);
  EXPECT_EQ(read_mesh(directory / "a.stl").vertex_count, 2);
}

TEST(Stl, SaysWhatIsRounded) {
  auto mesh = read(stl_binary_sample);
  EXPECT_EQ(not_carried(mesh, MeshFormat::stl),
            std::vector<std::string>{"format stl does not hold the order of vertices"});
  mesh.points[3] = 1.0 / 3;
  EXPECT_EQ(not_carried(mesh, MeshFormat::stl)[0],
            "format stl holds positions as 32-bit numbers: 1 coordinates are rounded");
  EXPECT_EQ(not_carried(mesh, MeshFormat::stl, {.encoding = WriteOptions::Encoding::ascii}).size(), 1U);
  mesh.points[3] = 1e39;
  const TemporaryDirectory directory;
  EXPECT_THROW(write_mesh(directory / "a.stl", mesh, MeshFormat::stl), InputError);
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace
}  // namespace derham::io_test
