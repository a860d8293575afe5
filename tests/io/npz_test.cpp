#include "io/npz_samples.hpp"

#include "derham/io/atomic_file.hpp"
#include "derham/io/npy.hpp"
#include "derham/io/write_mesh.hpp"
#include "derham/io/zip_write.hpp"
#include "io/io_fixture.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace derham::io_test {
namespace {

MeshData read(std::string_view bytes) { return read_mesh_from_memory(bytes, MeshFormat::npz, "mesh"); }
void refused(std::string_view bytes, const std::string& part) { expect_refused(bytes, MeshFormat::npz, 0, part); }

// An array as the bytes of its .npy file.
template <class Number>
std::string npy(std::vector<std::int64_t> shape, const std::vector<Number>& numbers) {
  return npy_header(std::is_floating_point_v<Number> ? 'f' : 'i', sizeof(Number), shape) +
         std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}
std::string npy_of(const std::string& dictionary, const std::string& data) {
  std::string out("\x93NUMPY\x01", 7);
  return out + '\0' + static_cast<char>(dictionary.size()) + '\0' + dictionary + data;
}

// An archive with these entries.
std::string zip(const std::vector<std::pair<std::string, std::string>>& entries, std::int64_t full = 0xffffffff) {
  const TemporaryDirectory directory;
  AtomicFile file(directory / "a");
  TextWriter text(file);
  ZipWriter archive(text, full);
  for (const auto& [name, bytes] : entries) archive.add(name, bytes, "");
  archive.finish();
  text.flush();
  file.commit();
  return read_bytes(directory / "a");
}

const std::string triangle = npy<std::int32_t>({1, 3}, {0, 1, 2});
const std::string positions = npy<double>({3, 2}, {0, 0, 1, 0, 0, 1});
// A triangle in the plane and one array more.
std::string with(const std::string& name, const std::string& array) {
  return zip({{"simplices.npy", triangle}, {"points.npy", positions}, {name + ".npy", array}});
}

TEST(Npz, ReadsWhatNumpyStores) {
  const auto mesh = read(npz_stored_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5}));
  EXPECT_EQ(mesh.vertex_count, 5);
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_TRUE(mesh.notes.empty());
  EXPECT_EQ(detect_format("stdin", npz_stored_sample), MeshFormat::npz);
}

TEST(Npz, ReadsWhatNumpyCompresses) {
  const auto mesh = read(npz_deflated_sample);
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1.5}));
  ASSERT_EQ(mesh.lower.size(), 3U);
  EXPECT_EQ(mesh.lower[2], (SimplexList{{0, 1, 2}, {1, 2, 4}}));
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_EQ(mesh.parts[0], (MeshPart{"ränder", 7, 3, {1}}));
  EXPECT_EQ(mesh.parts[1], (MeshPart{"", -1, 2, {0, 1}}));
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0], (MeshField{"u", MeshField::On::vertices, 1, {0, 1, 2, 3, 4}}));
  EXPECT_EQ(mesh.fields[1], (MeshField{"v", MeshField::On::rows, 3, {1, 2, 3, 4, 5, 6}}));
  ASSERT_EQ(mesh.forms.size(), 1U);
  EXPECT_EQ(mesh.forms[0], (MeshForm{"flux", 2, true, {0, 1, 2, 3, 4, 5, 6}}));
  EXPECT_EQ(mesh.edge_lengths_squared, std::vector<double>(9, 1.0));
  EXPECT_EQ(mesh.notes, std::vector<std::string>{"skipped the array 'extra'"});
}

TEST(Npz, IntegersAreRealNumbersToo) {
  const auto mesh = read(zip({{"simplices.npy", triangle},
                              {"points.npy", npy<std::int64_t>({3, 2}, {0, 0, 1, 0, 0, -9007199254740992})},
                              {"point_data_u.npy", npy<std::int8_t>({3}, {1, 2, -3})},
                              {"form_f_1_primal.npy", npy<std::int32_t>({3}, {4, 5, 6})}}));
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 1, 0, 0, -0x1p53}));
  EXPECT_EQ(mesh.fields.at(0), (MeshField{"u", MeshField::On::vertices, 1, {1, 2, -3}}));
  EXPECT_EQ(mesh.forms.at(0), (MeshForm{"f", 1, false, {4, 5, 6}}));
  // In the order of axes of Fortran, and of bytes that this machine may not have.
  const auto columns = read(with("point_data_v", npy_of("{'descr': '>i2', 'fortran_order': True, 'shape': (3, 2)}",
                                                        std::string("\0\1\0\2\0\3\0\4\0\5\xff\xff", 12))));
  EXPECT_EQ(columns.fields.at(0).values, (std::vector<double>{1, 4, 2, 5, 3, -1}));
}

// Everything a mesh can have.
MeshData rich_mesh() {
  MeshData mesh = read(npz_deflated_sample);
  mesh.notes.clear();
  mesh.points[0] = -0.0;
  mesh.points[1] = std::numeric_limits<double>::denorm_min();
  mesh.vertex_tags = {10, -3, 7, 8, std::numeric_limits<std::int64_t>::max()};
  mesh.row_tags = {4, 5};
  mesh.forms.push_back({"a_b", 0, false, std::vector<double>(5, std::numeric_limits<double>::infinity())});
  mesh.forms.push_back({"", 3, false, {1, 2}});
  mesh.fields.push_back({"with/slash und ü", MeshField::On::vertices, 2, std::vector<double>(10, 0.1)});
  mesh.parts.push_back({"some vertices", 1, 0, {0, 4}});
  mesh.parts.push_back({"nothing", 2, 1, {}});
  return mesh;
}

void expect_same(const MeshData& a, const MeshData& b) {
  EXPECT_EQ(a.simplices, b.simplices);
  EXPECT_EQ(a.vertex_count, b.vertex_count);
  EXPECT_EQ(a.ambient_dimension, b.ambient_dimension);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.vertex_tags, b.vertex_tags);
  EXPECT_EQ(a.row_tags, b.row_tags);
  EXPECT_EQ(a.edge_lengths_squared, b.edge_lengths_squared);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.parts, b.parts);
  EXPECT_EQ(a.fields, b.fields);
  EXPECT_EQ(a.forms, b.forms);
  EXPECT_EQ(a.notes, b.notes);
}

TEST(Npz, HoldsEverythingThatAMeshHas) {
  const TemporaryDirectory directory;
  const auto mesh = rich_mesh();
  EXPECT_TRUE(not_carried(mesh, MeshFormat::npz).empty());
  write_mesh(directory / "a.npz", mesh);
  const auto back = read_mesh(directory / "a.npz");
  expect_same(back, mesh);
  EXPECT_TRUE(std::signbit(back.points[0]));
  write_mesh(directory / "b.npz", back);
  EXPECT_EQ(read_bytes(directory / "a.npz"), read_bytes(directory / "b.npz"));
}

TEST(Npz, HoldsPeriodicAbstractAndEmptyMeshes) {
  const TemporaryDirectory directory;
  MeshData periodic;
  periodic.simplices = SimplexList{{0, 0, 1}, {1, 0, 1}};
  periodic.vertex_count = 2;
  periodic.ambient_dimension = 2;
  periodic.corners = {0, 0, 1, 0, 0.5, 1, 1, 2, 3, 4, 5, 6};
  MeshData abstract;
  abstract.simplices = SimplexList{{0, 1, 2, 3, 4, 5, 9}};
  abstract.vertex_count = 12;
  MeshData points;
  points.vertex_count = 2;
  points.ambient_dimension = 6;
  points.points = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  for (const auto& mesh : {periodic, abstract, points, MeshData()}) {
    write_mesh(directory / "a.npz", mesh);
    expect_same(read_mesh(directory / "a.npz"), mesh);
  }
  MeshData mixed;
  mixed.simplices = SimplexList{{0, 1, 2}, {2, 3}};
  mixed.vertex_count = 4;
  EXPECT_THROW(write_mesh(directory / "a.npz", mixed, MeshFormat::npz), InputError);
  auto same = rich_mesh();
  same.fields.push_back(same.fields[0]);
  EXPECT_THROW(write_mesh(directory / "a.npz", same, MeshFormat::npz), InputError);
  same = rich_mesh();
  same.fields[0].name = std::string("a\0b", 3);
  EXPECT_THROW(write_mesh(directory / "a.npz", same, MeshFormat::npz), InputError);
}

TEST(Npz, SizesOf64Bits) {
  const std::vector<std::pair<std::string, std::string>> entries{{"simplices.npy", triangle},
                                                                 {"points.npy", positions}};
  for (const std::int64_t full : {1, 140, 160, 300}) {  // from some entry on, or for the directory alone
    const auto mesh = read(zip(entries, full));
    EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2}}));
    EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 1, 0, 0, 1}));
  }
  auto bytes = zip(entries, 1);
  bytes[bytes.find("PK\x06\x06") + 4] ^= 1;
  refused(bytes, "no zip64 end record");
}

TEST(Npz, EveryArrayBeginsAtAMultipleOf64) {
  const auto bytes = zip({{"simplices.npy", triangle}, {"points.npy", positions}});
  const auto first = bytes.find("\x93NUMPY");
  EXPECT_EQ(first % 64, 0U);
  EXPECT_EQ(bytes.find("\x93NUMPY", first + 1) % 64, 0U);
  EXPECT_EQ(triangle.find('\n') % 64, 63U);
}

TEST(Npz, RefusesBadArchives) {
  const std::string sample(npz_stored_sample);
  const auto directory = sample.find("PK\x01\x02"), end = sample.find("PK\x05\x06");
  const auto changed = [&](const std::vector<std::pair<std::size_t, char>>& changes) {
    auto out = sample;
    for (const auto& [at, value] : changes) out[at] = value;
    return out;
  };
  refused("PK", "does not end with the directory of a zip archive");
  refused(sample + "x", "does not end with the directory");
  refused("x" + sample, "the directory does not end where this record begins");
  refused(changed({{end + 4, 1}}), "one part of an archive in several files");
  refused(changed({{end + 8, 3}, {end + 10, 3}}), "the number of entries is 3, but their directory has");
  refused(changed({{end + 8, 1}, {end + 10, 1}}), "the directory does not end with its last entry");
  refused(changed({{end + 9, '\x7f'}, {end + 11, '\x7f'}}), "the number of entries is 32514, but their directory has");
  refused(changed({{6, 1}, {directory + 8, 1}}), "'simplices.npy' is encrypted");
  refused(changed({{6, 1}}), "differs from what the directory says");
  refused(changed({{7, 1}, {directory + 9, 1}}), "flags 256");
  refused(changed({{8, 12}, {directory + 10, 12}}), "compressed by method 12; expected stored or deflated");
  refused(changed({{30, 'S'}}), "differs from what the directory says");
  refused(changed({{directory + 16, static_cast<char>(sample[directory + 16] ^ 1)}}), "differs from");
  refused(changed({{directory + 24, static_cast<char>(sample[directory + 24] ^ 1)}}), "differs from");
  refused(changed({{directory + 45, 1}}), "is said to be at byte");
  refused(changed({{300, 1}}), "its checksum is wrong");
  const auto second = sample.find("PK\x01\x02", directory + 4);
  refused(changed({{second + 42, sample[directory + 42]}, {second + 43, sample[directory + 43]}}), "differs from");
  refused(zip({{"a", ""}, {"a", ""}}), "the entry 'a' is there twice");
  std::string deflated(npz_deflated_sample);
  const auto data = deflated.find("simplices.npy") + 13 + 20;
  deflated[data + 20] = static_cast<char>(deflated[data + 20] ^ 8);
  EXPECT_EQ(read_error(deflated, MeshFormat::npz).line(), 0);
}

TEST(Npz, OverlappingAndInflatedEntriesAreRefused) {
  // Two entries of the directory that share one local entry, as archives that explode on unpacking have.
  auto bytes = zip({{"a.npy", triangle}, {"b.npy", triangle}});
  const auto first = bytes.find("PK\x01\x02"), second = bytes.find("PK\x01\x02", first + 4);
  for (std::size_t i = 42; i < 46; ++i) bytes[second + i] = bytes[first + i];
  bytes[second + 46] = 'a';
  refused(bytes, "the entry 'a.npy' is there twice");
  // An entry inside another: its local header is among the other's data.
  const auto inner = zip({{"b.npy", ""}});
  const auto local = inner.substr(0, inner.find("PK\x01\x02"));
  bytes = zip({{"a.npy", "1234" + local}, {"b.npy", ""}});
  const auto where = bytes.find(local);
  const auto entry = bytes.rfind("PK\x01\x02");
  bytes[entry + 42] = static_cast<char>(where & 255);
  bytes[entry + 43] = static_cast<char>(where >> 8);
  refused(bytes, "overlap");
  // A deflated entry that would be more than 1032 times its bytes.
  std::string bomb(npz_deflated_sample);
  const auto directory = bomb.find("PK\x01\x02");
  bomb[22 + 3] = 1;  // of the size in the local header
  bomb[directory + 24 + 3] = 1;
  refused(bomb, "that cannot be");
}

TEST(Npz, RefusesBadArrays) {
  const auto array = [&](const std::string& dictionary, std::size_t data_bytes) {
    return zip({{"simplices.npy", npy_of(dictionary, std::string(data_bytes, '\0'))}});
  };
  refused(zip({{"points.npy", positions}}), "there is no array called simplices");
  refused(zip({{"simplices.npy", "NUMPY"}}), "does not begin as numpy arrays do");
  auto version = triangle;
  version[6] = 4;
  refused(zip({{"simplices.npy", version}}), "format 4.0; expected 1.0, 2.0 or 3.0");
  refused(array("{'descr': '<i4', 'fortran_order': False, 'shape': (1, 3)}", 11),
          "11 bytes, which do not make the shape (1, 3)");
  refused(array("{'descr': '<i4', 'fortran_order': False, 'shape': (1, 3)}", 13), "13 bytes");
  refused(array("{'descr': '<i4', 'fortran_order': False, 'shape': (4611686018427387904, 4)}", 12), "12 bytes");
  refused(array("{'descr': '<i4', 'fortran_order': False, 'shape': (1, -3)}", 12), "as an extent");
  refused(array("{'descr': '<i4', 'fortran_order': False}", 12), "a header without descr, fortran_order or shape");
  refused(array("{'descr': '<i4', 'descr': '<i4'}", 12), "the key 'descr'");
  refused(array("{'descr': '<i4', 'fortran_order': 1, 'shape': (1, 3)}", 12), "as fortran_order");
  refused(array("{'descr': '<i3', 'fortran_order': False, 'shape': (1, 4)}", 12), "numbers of 3 bytes");
  refused(array("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3)}", 24), "the type f8; expected integers");
  refused(array("{'descr': '|O', 'fortran_order': False, 'shape': (1, 3)}", 24), "the type O8; expected integers");
  refused(array("{'descr': [('a', '<i4')], 'fortran_order': False, 'shape': (3,)}", 12), "the type V0");
  refused(array("{'descr': '<i4', 'fortran_order': False, 'shape': (3,)}", 12), "shape (3,); expected (rows, n+1)");
  refused(array("{'descr': '|i1', 'fortran_order': False, 'shape': (1, 8)}", 8), "n at most 6");
  refused(array("{'descr': '|i1', 'fortran_order': False, 'shape': (1, 1)} x", 1), "behind the header");
  refused(array("['descr']", 1), "instead of {");
}

TEST(Npz, RefusesArraysThatDoNotFitTheMesh) {
  refused(zip({{"simplices.npy", npy<std::int64_t>({1, 3}, {0, 1, 3})}, {"points.npy", positions}}),
          "a vertex id is 3, expected 0 to 2");
  refused(zip({{"simplices.npy", npy<std::int8_t>({1, 3}, {0, 1, -1})}}), "a vertex id is -1");
  refused(with("vertex_count", npy<std::int64_t>({}, {4})), "shape (3, 2); expected (4, 2) as vertex_count says");
  refused(with("corners", npy<double>({1, 3, 1}, {0, 1, 2})), "both points and corners");
  refused(zip({{"simplices.npy", triangle}, {"corners.npy", npy<double>({3, 1, 1}, {0, 1, 2})}}),
          "a position for every corner");
  refused(zip({{"simplices.npy", triangle}, {"points.npy", npy<double>({3, 1}, {0, 1, NAN})}}),
          "number 2 of the array is nan");
  refused(with("edge_lengths_squared", npy<double>({1, 1}, {0})), "expected (1,), a number for every edge");
  refused(with("row_tags", npy<std::int64_t>({2}, {0, 1})), "shape (2,); expected (1,)");
  refused(with("lower_1", npy<std::int64_t>({1, 3}, {0, 1, 2})), "expected (rows, 2)");
  refused(with("point_data_u", npy<double>({2}, {0, 1})), "shape (2,); expected (3,) or (3, components)");
  refused(with("row_data_u", npy_of("{'descr': '<f2', 'fortran_order': False, 'shape': (1,)}", "ab")),
          "the type f2; expected float64, float32 or integers: save it with astype(float)");
  refused(with("row_data_u", npy_of("{'descr': '|b1', 'fortran_order': False, 'shape': (1,)}", "a")),
          "the type b1; expected float64");
  refused(with("row_data_u", npy<std::int64_t>({1}, {-9007199254740993})),
          "the integer -9007199254740993, which no double holds");
  refused(with("row_data_u", npy_of("{'descr': '<u8', 'fortran_order': False, 'shape': (1,)}", std::string(8, '\xff'))),
          "the integer 18446744073709551615, which no double holds");
  refused(with("form_u_1_primal", npy<double>({1, 1}, {0})), "a number for every simplex");
  refused(with("form_u_0_primal", npy<double>({2}, {0, 1})),
          "a primal 0-form with 2 values; expected 3, one for every vertex");
  refused(with("form_u_2_dual", npy<double>({2}, {0, 1})),
          "a dual 2-form with 2 values; expected 3, one for every vertex");
  refused(with("form_u_0_dual", npy<double>({2}, {0, 1})),
          "a dual 0-form with 2 values; expected 1, one for every row");
  refused(with("form_u_3_primal", npy<double>({1}, {0})), "a form of degree 3 on a mesh of dimension 2");
  refused(with("edge_lengths_squared", npy<double>({3}, {0, 1, -1})),
          "number 2 of the array is -1; expected squares of lengths");
  for (const auto* name : {"form_u", "form_u_1", "form_u_x_dual", "form_u_7_dual", "form_1_dual", "lower_2"})
    EXPECT_EQ(read(with(name, triangle)).notes.size(), 1U) << name;
}

TEST(Npz, RefusesBadParts) {
  const auto parts = [](const std::vector<std::int64_t>& degrees, const std::vector<std::int64_t>& offsets,
                        const std::vector<std::int64_t>& members) {
    const auto list = [](const std::vector<std::int64_t>& numbers) {
      return npy<std::int64_t>({static_cast<std::int64_t>(numbers.size())}, numbers);
    };
    return zip({{"simplices.npy", triangle},
                {"part_numbers.npy", list({5, 5})},
                {"part_degrees.npy", list(degrees)},
                {"part_offsets.npy", list(offsets)},
                {"part_members.npy", list(members)}});
  };
  EXPECT_EQ(read(parts({2, 0}, {0, 1, 3}, {0, 0, 2})).parts[1].members, (std::vector<Index>{0, 2}));
  refused(parts({2, 2}, {0, 0, 0}, {}), "two parts of degree 2 with the number 5");
  refused(parts({2, 3}, {0, 0, 0}, {}), "a degree is 3, expected 0 to 2");
  refused(parts({2, 1}, {0, 0, 1}, {0}), "the member 0 of 0 simplices of degree 1");
  refused(parts({2, 0}, {0, 1, 2}, {0, 3}), "the member 3 of 3 simplices of degree 0");
  refused(parts({2, 0}, {0, 0, 2}, {1, 1}), "the members of part 5 do not increase");
  refused(parts({2, 0}, {0, 1, 0}, {}), "the offsets do not increase");
  refused(parts({2, 0}, {1, 1, 1}, {0}), "the offsets do not increase from 0");
  refused(parts({2, 0}, {0, 0, 1}, {}), "as part_offsets ends");
  refused(parts({2}, {0, 0, 0}, {}), "as part_numbers has");
  refused(with("part_numbers", npy<std::int64_t>({1}, {1})), "no array called part_degrees");
}

}  // namespace
}  // namespace derham::io_test
