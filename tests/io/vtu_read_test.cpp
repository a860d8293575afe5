#include "derham/io/pvd_file.hpp"
#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"
#include "io/vtk_checks.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes, const ReadOptions& options = {}) {
  return read_mesh_from_memory(bytes, MeshFormat::vtu, "mesh", options);
}
void refused(std::string_view bytes, std::int64_t line, const std::string& part) {
  expect_refused(bytes, MeshFormat::vtu, line, part);
}

void expect_sample(const MeshData& mesh) {
  expect_two_tetrahedra(mesh);
  ASSERT_EQ(mesh.fields.size(), 2u);
  expect_field(mesh.fields[0], "u", MeshField::On::vertices, 1, {0, 1, 2, nan, 4});
  expect_field(mesh.fields[1], "r", MeshField::On::rows, 2, {1, 2, 3, 4});
}

TEST(VtuRead, ReadsEveryEncoding) {
  for (const auto sample : {vtu_ascii_sample, vtu_inline_sample, vtu_inline_zlib_sample, vtu_raw_sample,
                            vtu_raw_zlib_sample, vtu_base64_sample, vtu_base64_zlib_sample})
    expect_sample(read(sample));
  EXPECT_EQ(read(vtu_raw_sample).notes,
            (std::vector<std::string>{"field 'r': 2 values on cells of lower dimension are not kept"}));
}

TEST(VtuRead, ElementsInsideArraysAndStringsAreNoNumbers) {
  const auto mesh = read(replaced(vtu_ascii_sample, "0 1 2 nan 4</DataArray>",
                                  "0 1 2 nan 4 <InformationKey name=\"a\">7</InformationKey></DataArray>"
                                  "<Array type=\"String\" Name=\"s\">1 2</Array>"
                                  "<DataArray type=\"Bit\" Name=\"b\" format=\"ascii\">1 0 1 1 0</DataArray>"));
  expect_sample(mesh);
  EXPECT_EQ(mesh.notes[0], "'Array' 's' is not kept");
  EXPECT_EQ(mesh.notes[1], "'DataArray' 'b' is not kept");
}

TEST(VtuRead, IntegersOfTextAreIntegersOfTheirType) {
  const auto with = [](const char* numbers) { return replaced(vtu_ascii_sample, "1 2 3 4 5 6", numbers); };
  refused(with("1 2 0.5 4 5 6"), 9, "'0.5'");
  refused(with("1 2 nan 4 5 6"), 9, "'nan'");
  refused(replaced(with("1 2 -129 4 5 6"), "Int64", "Int8"), 9, "a value is -129, expected -128 to 127");
  const auto notes = read(with("9007199254740993 2 3 -9007199254740993 5 6")).notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes[0], "array 'r': rounded 2 integers that no double holds");
  refused(replaced(vtu_ascii_sample, "10 10 5", "10 10.0 5"), 17, "'10.0'");
}

TEST(VtuRead, OfHigherOrderTheCornersAreKept) {
  auto bytes = replaced(vtu_ascii_sample, "NumberOfCells=\"3\"", "NumberOfCells=\"1\"");
  bytes = replaced(replaced(bytes, "0 1 2 3 1 2 3 4 0 1 2<", "0 1 3<"), ">4 8 11<", ">3<");
  bytes = replaced(replaced(bytes, ">10 10 5<", ">21<"), ">1 2 3 4 5 6<", ">1 2<");
  refused(bytes, 14, "of first order, or keep only the corner nodes (--corner-nodes");
  ReadOptions options;
  options.corner_nodes = true;
  const auto mesh = read(bytes, options);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0}));
  ASSERT_EQ(mesh.fields.size(), 2u);
  expect_field(mesh.fields[0], "u", MeshField::On::vertices, 1, {0, 1});
  expect_field(mesh.fields[1], "r", MeshField::On::rows, 2, {1, 2});
}

TEST(VtuRead, WritesWhatItReads) {
  const TemporaryDirectory directory;
  auto mesh = read(vtu_raw_sample);
  mesh.fields[0].name = "<u> & \"w\"\n\t\xc3\xbc";
  for (const auto encoding : {WriteOptions::Encoding::usual, WriteOptions::Encoding::ascii}) {
    WriteOptions options;
    options.encoding = encoding;
    write_mesh(directory / "a.vtu", mesh, MeshFormat::vtu, options);
    auto back = read_mesh(directory / "a.vtu");
    EXPECT_EQ(back.fields[0].name, mesh.fields[0].name);
    back.fields[0].name = "u";
    expect_sample(back);
    EXPECT_TRUE(back.notes.empty());
  }
  EXPECT_TRUE(not_carried(mesh, MeshFormat::vtu).empty());
  mesh.fields[0].name = "a\x01";
  mesh.fields[1].name = "";
  EXPECT_EQ(not_carried(mesh, MeshFormat::vtu),
            (std::vector<std::string>{"format vtu does not hold the name of the field 'a\\x01': it becomes 'a '",
                                      "format vtu does not hold the name of the field '': it becomes 'unnamed'"}));
  write_mesh(directory / "a.vtu", mesh);
  EXPECT_EQ(read_mesh(directory / "a.vtu").fields[0].name, "a ");
  EXPECT_EQ(read_mesh(directory / "a.vtu").fields[1].name, "unnamed");
  mesh.fields[1].values.pop_back();
  EXPECT_THROW(write_mesh(directory / "b.vtu", mesh, MeshFormat::vtu), InputError);
}

// VTK 9.7 drops an array of text with a NaN.
TEST(VtuRead, InTextOnlyFiniteNumbersAreText) {
  const TemporaryDirectory directory;
  auto mesh = read(vtu_raw_sample);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const std::size_t size : {1U, 2U, 3U, 4U}) {  // 16, 24, 32, 40 bytes: every length of the padding
    mesh.simplices = SimplexList{{0}};
    mesh.lower.clear();
    mesh.vertex_count = static_cast<Index>(size);
    mesh.points.resize(3 * size);
    mesh.fields = {{"u", MeshField::On::vertices, 1, std::vector<double>(size, -infinity)},
                   {"v", MeshField::On::vertices, 1, std::vector<double>(size, 0.1)}};
    mesh.fields[0].values.back() = nan;
    write_mesh(directory / "a.vtu", mesh, MeshFormat::vtu, {.encoding = WriteOptions::Encoding::ascii});
    const auto bytes = read_bytes(directory / "a.vtu");
    EXPECT_NE(bytes.find("Name=\"u\" format=\"binary\""), std::string::npos);
    EXPECT_NE(bytes.find("Name=\"v\" format=\"ascii\""), std::string::npos);
    const auto back = read_mesh(directory / "a.vtu");
    ASSERT_EQ(back.fields.size(), 2u);
    expect_field(back.fields[0], "u", MeshField::On::vertices, 1, mesh.fields[0].values);
    EXPECT_EQ(back.fields[1], mesh.fields[1]);
  }
}

TEST(VtuRead, MarkupMayHoldAnything) {
  const auto bytes =
      replaced(replaced(vtu_ascii_sample, "<Points>\n", "<Points a='> \"'><!-- 1 > <a> 'x -->\n<?p \"> ?>\n"),
               "<Cells>\n", "<Cells><![CDATA[ <a> > \" ]]> some text &amp; more\n");
  expect_sample(read(bytes));
  refused(replaced(bytes, "1 1 1 1<", "1 1 1 nan<"), 13, "finite");
  refused(replaced(bytes, "10 10 5", "10 10 300"), 18, "a cell type is 300");
  refused(replaced(bytes, "<Cells>", "<Cells b=>"), 15, "not well-formed XML");
  refused(replaced(bytes, "a='> ", "a=> '"), 11, "not well-formed XML");
}

TEST(VtuRead, TheLastBytesOfTheDataMayLookLikeBlanks) {
  const TemporaryDirectory directory;
  auto mesh = read(vtu_raw_sample);
  mesh.lower.clear();
  mesh.fields.clear();
  write_mesh(directory / "a.vtu", mesh);  // ends with the types of the cells, 10 is a line end
  const auto bytes = read_bytes(directory / "a.vtu");
  EXPECT_NE(bytes.find("\n\n\n  </AppendedData>"), std::string::npos);
  EXPECT_EQ(read_mesh(directory / "a.vtu").simplices, mesh.simplices);
}

TEST(VtuRead, RefusesDamageInXml) {
  const auto refused_with = [](std::string_view what, std::string_view with, std::int64_t line, const char* part) {
    refused(replaced(vtu_ascii_sample, what, with), line, part);
  };
  refused("<VTKFile>", 1, "does not end with </VTKFile>");
  refused("<a></VTKFile>", 1, "not well-formed XML");
  refused("<a><VTKFile></VTKFile></a></VTKFile>", 1, "not well-formed");
  refused_with("type=\"UnstructuredGrid\"", "type=\"ImageData\"", 2, "of type 'ImageData'; expected UnstructuredGrid");
  refused_with("LittleEndian", "MiddleEndian", 2, "byte_order is 'MiddleEndian'");
  refused_with("UInt32", "UInt8", 2, "header_type is 'UInt8'");
  refused_with("header_type=\"UInt32\"", "compressor=\"vtkLZ4DataCompressor\"", 2, "'vtkLZ4DataCompressor'");
  refused_with("<Piece ", "<Part ", 19, "not well-formed");
  refused_with("</Piece>", "</Piece><Piece/>", 19, "several pieces");
  refused_with("NumberOfPoints=\"5\"", "NumberOfPoints=\"-5\"", 4, "NumberOfPoints is '-5'");
  refused_with("NumberOfPoints=\"5\"", "NumberOfPoints=\"1152921504606846976\"", 4, "cannot hold so many");
  refused_with("NumberOfPoints=\"5\"", "NumberOfPoints=\"6\"", 12, "of 6 times 3 numbers has only");
  refused_with("NumberOfPoints=\"5\"", "NumberOfPoints=\"4\"", 12, "found '1', expected the end of the array");
  refused_with("NumberOfCells=\"3\"", "NumberOfCells=\"2\"", 16, "found '11', expected the end of the array");
  refused_with("Float64", "Float16", 12, "an array of type 'Float16'");
  refused_with("Name=\"offsets\"", "Name=\"ends\"", 14, "the cells have no array offsets");
  refused_with("4 8 11", "4 4 11", 16, "an offset is 4, expected more than the one before");
  refused_with("4 8 11", "4 8 9999999", 15, "has only");
  refused_with("10 10 5", "10 10 300", 17, "a cell type is 300");
  refused_with("10 10 5", "10 10 12", 14, "is a hexahedron");
  refused_with("3 4 0 1 2", "3 5 0 1 2", 15, "a point id is 5, expected 0 to 4");
  refused_with("0 1 1 1 1<", "0 1 1 1 inf<", 12, "finite");
  refused_with("0 1 2 nan 4", "0 1 2 nan x", 6, "'x', expected a number");
  refused_with("format=\"ascii\"", "format=\"morse\"", 6, "format is 'morse'");
  refused_with("NumberOfComponents=\"2\"", "NumberOfComponents=\"0\"", 9, "NumberOfComponents is 0");
  refused_with("NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"", 12, "2 components, expected 3");
}

TEST(VtuRead, RefusesDamageInData) {
  refused(replaced(vtu_inline_sample, "Float32", "Float64"), 6, "has 20 bytes, expected 40");
  const auto inline_start = vtu_inline_sample.find(">\n", vtu_inline_sample.find("Name=\"u\"")) + 2;
  auto damaged = std::string(vtu_inline_sample);
  damaged[inline_start + 20] = '!';
  refused(damaged, 6, "are not base64");
  damaged = vtu_inline_sample;
  damaged.insert(damaged.find("\n</DataArray>"), "AAAA");
  refused(damaged, 7, "goes on after its last number");
  refused(replaced(vtu_raw_sample, "offset=\"0\"", "offset=\"100000\""), 0, "bytes of appended data");
  refused(replaced(vtu_raw_sample, "offset=\"0\"", "offset=\"1\""), 0, "expected 20");
  refused(replaced(vtu_raw_sample, "encoding=\"raw\"", "encoding=\"hex\""), 21, "the encoding is 'hex'");
  refused(replaced(vtu_raw_sample, ">\n_", ">\n"), 21, "underscore");
  refused(replaced(vtu_raw_sample, "</AppendedData>\n", ""), 24, "does not end with </AppendedData>");
  damaged = vtu_raw_zlib_sample;
  const auto data = damaged.find("\n_") + 2;
  damaged[data + 17] = static_cast<char>(damaged[data + 17] ^ 0x40);
  refused(damaged, 0, "array 'u': block 0 is not 20 bytes compressed by zlib");
  damaged = vtu_raw_zlib_sample;
  damaged[data + 3] = '\x10';
  refused(damaged, 0, "blocks of 40 bytes");
  damaged = vtu_raw_zlib_sample;
  damaged[data + 14] = '\x10';
  refused(damaged, 0, "its blocks are cut short");
  // A billion bytes are announced consistently, but so few compressed ones cannot become them.
  damaged = replaced(vtu_raw_zlib_sample, "NumberOfComponents=\"1\"", "NumberOfComponents=\"50000\"");
  damaged.replace(damaged.find("\n_") + 2, 12, std::string("\x01\0\0\0\x40\x42\x0f\0\0\0\0\0", 12));
  refused(damaged, 0, "compressed bytes cannot become 1000000");
}

// A small file must not take much memory by naming the same bytes again and again.
TEST(VtuRead, ArraysDoNotShareBytes) {
  const TemporaryDirectory directory;
  auto mesh = read(vtu_raw_sample);
  mesh.fields = {{"p", MeshField::On::vertices, 1, {1, 2, 3, 4, 5}},
                 {"q", MeshField::On::vertices, 1, {6, 7, 8, 9, 0}}};
  write_mesh(directory / "a.vtu", mesh);
  const auto bytes = read_bytes(directory / "a.vtu");
  EXPECT_EQ(read(bytes).fields, mesh.fields);
  const auto offset_of = [&](const std::string& name) {
    const auto at = bytes.find("offset=", bytes.find("Name=\"" + name + "\""));
    return bytes.substr(at, bytes.find('/', at) - at);
  };
  refused(replaced(bytes, offset_of("q"), offset_of("p")), 0, "'q' shares its bytes with another");
}

TEST(PvdFile, WritesTimesAndEscapedNames) {
  const TemporaryDirectory directory;
  PvdFile series;
  series.add(0, "a&b.vtu").add(0.1, "c.vtu").write(directory / "a.pvd");
  EXPECT_EQ(read_bytes(directory / "a.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n"
            "    <DataSet timestep=\"0\" part=\"0\" file=\"a&amp;b.vtu\"/>\n"
            "    <DataSet timestep=\"0.1\" part=\"0\" file=\"c.vtu\"/>\n  </Collection>\n</VTKFile>\n");
  EXPECT_THROW(series.add(NAN, "x"), InputError);
  EXPECT_THROW(series.add(1, ""), InputError);
}

}  // namespace
}  // namespace derham::io_test
