#include "derham/io/write_mesh.hpp"

#include "io/io_fixture.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace derham::io_test {
namespace {

using Encoding = WriteOptions::Encoding;
constexpr std::array variants{WriteOptions{Encoding::ascii, false}, WriteOptions{Encoding::binary, false},
                              WriteOptions{Encoding::ascii, true}, WriteOptions{Encoding::binary, true}};

std::vector<double> random_values(std::mt19937_64& random, std::size_t count) {
  std::vector<double> out(count);
  for (double& value : out) value = std::normal_distribution<double>()(random);
  return out;
}

// Random rows and lower simplices, of which about every third is in each of some parts.
MeshData random_mesh(int n, int m) {
  std::mt19937_64 random(static_cast<unsigned>(10 * n + m));
  MeshData mesh;
  mesh.vertex_count = 30;
  mesh.ambient_dimension = m;
  mesh.points = random_values(random, 30 * static_cast<std::size_t>(m));
  const auto list = [&](int k) {
    std::vector<Index> ids(static_cast<std::size_t>(40 * (k + 1)));
    for (Index& v : ids) v = static_cast<Index>(random() % 30);
    return SimplexList(k, ids);
  };
  mesh.simplices = list(n);
  for (int k = 0; k < n; ++k) mesh.lower.push_back(list(k));
  for (int k = n; k >= 0; --k)
    for (const std::int64_t number : {1, 2, 2147483647}) {
      MeshPart part{number == 2 ? "" : std::string("part \"\xc3\xbc\" ") + std::to_string(k), number, k, {}};
      for (Index i = 0; i < 40; ++i) {
        // Members of degree 0 are vertices; only those that lower[0] lists come back to it as they were.
        const Index member = k == 0 && n > 0 ? mesh.lower[0][i][0] : i;
        if (random() % 3 == 0) part.members.push_back(member);
      }
      std::ranges::sort(part.members);
      part.members.erase(std::ranges::unique(part.members).begin(), part.members.end());
      mesh.parts.push_back(part);
    }
  mesh.fields = {{"heat", MeshField::On::vertices, 1, random_values(random, 30)},
                 {"heat", MeshField::On::rows, 1, random_values(random, 40)},
                 {"a \"flow\"", MeshField::On::rows, 3, random_values(random, 120)},
                 {"stress", MeshField::On::vertices, 9, random_values(random, 270)}};
  return mesh;
}

TEST(WriteGmsh, EverythingReadsBack) {
  const TemporaryDirectory directory;
  for (int n = 0; n <= 3; ++n)
    for (const auto& options : variants) {
      const auto mesh = random_mesh(n, 3);
      write_mesh(directory / "a.msh", mesh, MeshFormat::gmsh, options);
      const auto back = read_mesh(directory / "a.msh");
      EXPECT_EQ(back.simplices, mesh.simplices);
      EXPECT_EQ(back.points, mesh.points);
      EXPECT_EQ(back.lower, mesh.lower);
      EXPECT_EQ(back.parts, mesh.parts);
      EXPECT_EQ(back.fields, mesh.fields);
      EXPECT_EQ(back.row_tags.front(), 1);
      EXPECT_EQ(back.row_tags.back(), 40);
      EXPECT_EQ(back.vertex_tags.back(), 30);
      const bool repeats = !options.gmsh_41;
      EXPECT_EQ(back.notes.size(), repeats ? 1U : 0U);
    }
}

TEST(WriteGmsh, SaysWhatIsLost) {
  MeshData mesh;
  mesh.vertex_count = 3;
  mesh.ambient_dimension = 2;
  mesh.points = {0, 0, 1, 0, 0, 1};
  mesh.simplices = SimplexList{{0, 1, 2}};
  mesh.vertex_tags = {1, 2, 3};
  mesh.row_tags = {2};
  mesh.parts = {{"", 4, 2, {0}}, {"", 5, 2, {0}}, {"", 6, 2, {}}, {"", 0, 0, {1, 2}}};
  mesh.fields = {{"v", MeshField::On::rows, 2, {1.5, 2}}};
  const auto lost = not_carried(mesh, MeshFormat::gmsh);
  EXPECT_EQ(lost,
            (std::vector<std::string>{
                "format gmsh holds positions in space: written with z = 0, read back into the plane by --planar "
                "(ReadOptions::planar)",
                "format gmsh does not hold the numbers of rows (row_tags), only their order",
                "format gmsh does not hold parts without members (1) that have no name",
                "format gmsh numbers the parts of a dimension from 1 to 2147483647, none twice: 1 get other numbers",
                "format gmsh holds fields of 1, 3 or 9 components: 1 are padded with zeros",
                "format gmsh holds parts of vertices as points: 2 are added to the simplices of dimension 0",
                "format gmsh 2.2 lists simplices in several parts (1) once for each, which others may take for "
                "copies; 4.1 does not (--gmsh-version 4.1, WriteOptions::gmsh_41)"}));
  EXPECT_EQ(not_carried(mesh, MeshFormat::gmsh, {.gmsh_41 = true}).size(), lost.size() - 1);
}

TEST(WriteGmsh, PartsInFormat41AreAsManyAsTheReaderTakes) {
  const TemporaryDirectory directory;
  const auto in_parts = [](int rows, int parts) {
    MeshData mesh;
    mesh.vertex_count = 2;
    mesh.ambient_dimension = 3;
    mesh.points.resize(6, 0.5);
    std::vector<Index> ids, all;
    for (int i = 0; i < rows; ++i) {
      ids.insert(ids.end(), {0, 1});
      all.push_back(static_cast<Index>(i));
    }
    mesh.simplices = SimplexList(1, ids);
    for (int p = 1; p <= parts; ++p) mesh.parts.push_back({"", p, 1, all});
    return mesh;
  };
  const auto mesh = in_parts(50, 100);
  write_mesh(directory / "a.msh", mesh, MeshFormat::gmsh, {.gmsh_41 = true});
  EXPECT_EQ(read_mesh(directory / "a.msh").parts, mesh.parts);
  EXPECT_THROW(write_mesh(directory / "b.msh", in_parts(200, 200), MeshFormat::gmsh, {.gmsh_41 = true}), InputError);
  write_mesh(directory / "b.msh", in_parts(200, 200), MeshFormat::gmsh);
  EXPECT_EQ(read_mesh(directory / "b.msh").parts.size(), 200U);
}

TEST(WriteGmsh, IsExactlyThis) {
  const TemporaryDirectory directory;
  MeshData mesh;
  mesh.vertex_count = 3;
  mesh.ambient_dimension = 2;
  mesh.points = {0, 0, 1, 0, 0, 1};
  mesh.simplices = SimplexList{{0, 1, 2}};
  mesh.lower = {{}, SimplexList{{1, 2}, {0, 1}}};
  mesh.parts = {{"all", 4, 2, {0}}, {"", 5, 2, {0}}, {"wall", -1, 1, {1}}, {"tip", 1, 0, {2}}};
  mesh.fields = {{"v", MeshField::On::rows, 2, {1.5, 2}}};
  const std::string names = "$PhysicalNames\n3\n2 4 \"all\"\n1 1 \"wall\"\n0 1 \"tip\"\n$EndPhysicalNames\n";
  const std::string field = "$ElementData\n1\n\"v\"\n1\n0\n3\n0\n3\n1\n1 1.5 2 0\n$EndElementData\n";
  write_mesh(directory / "a.msh", mesh);
  EXPECT_EQ(read_bytes(directory / "a.msh"),
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
                "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n5\n1 2 2 4 1 1 2 3\n1 2 2 5 1 1 2 3\n"
                "2 1 2 0 1 2 3\n3 1 2 1 2 1 2\n4 15 2 1 1 3\n$EndElements\n" +
                field);
  write_mesh(directory / "a.msh", mesh, MeshFormat::gmsh, {Encoding::ascii, true});
  EXPECT_EQ(read_bytes(directory / "a.msh"),
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
                "$Entities\n1 2 1 0\n1 0 0 0 1 1\n1 0 0 0 1 1 0 0 0\n2 0 0 0 1 1 0 1 1 0\n1 0 0 0 1 1 0 2 4 5 0\n"
                "$EndEntities\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
                "$Elements\n4 4 1 4\n2 1 2 1\n1 1 2 3\n1 1 1 1\n2 2 3\n1 2 1 1\n3 1 2\n0 1 15 1\n4 3\n$EndElements\n" +
                field);
}

TEST(WriteGmsh, EmptyMeshesReadBack) {
  const TemporaryDirectory directory;
  for (const auto& options : variants)
    for (const Index vertices : {0, 2}) {
      MeshData mesh;
      mesh.vertex_count = vertices;
      mesh.ambient_dimension = 3;
      mesh.points.resize(static_cast<std::size_t>(vertices) * 3, 0.5);
      write_mesh(directory / "a.msh", mesh, MeshFormat::gmsh, options);
      const auto back = read_mesh(directory / "a.msh");
      EXPECT_TRUE(back.simplices.empty());
      EXPECT_EQ(back.points, mesh.points);
    }
}

TEST(WriteGmsh, RefusesWhatTheFormatCannotHold) {
  const TemporaryDirectory directory;
  const auto refused = [&](const MeshData& mesh, const std::string& part) {
    try {
      write_mesh(directory / "a.msh", mesh);
      ADD_FAILURE() << "expected: " << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  auto mesh = random_mesh(2, 3);
  mesh.fields[0].name = mesh.fields[3].name;
  refused(mesh, "two fields on vertices are called 'stress'");
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(WriteGmsh, LeavesOutFieldsAndNamesThatTheFormatCannotHold) {
  const TemporaryDirectory directory;
  constexpr auto on = MeshField::On::vertices;
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string longest(127, 'x'), too_long(128, 'x'), shown(40, 'x');
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2}};
  mesh.vertex_count = 3;
  mesh.ambient_dimension = 3;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.parts = {{"a\nb", 1, 2, {0}}, {too_long, 2, 2, {0}}, {longest, 3, 2, {0}}, {"\x7f", 4, 2, {}}};
  mesh.fields = {{"nan", on, 1, {0, nan, 0}},
                 {"inf", MeshField::On::rows, 1, {infinity}},
                 {"big", on, 10, std::vector<double>(30)},
                 {"u\rv", on, 1, {1, 2, 3}},
                 {too_long, on, 1, {1, 2, 3}},
                 {longest, on, 1, {1, 2, 3}}};
  auto expected = mesh;
  expected.parts = {{"", 1, 2, {0}}, {"", 2, 2, {0}}, {longest, 3, 2, {0}}};
  expected.fields = {mesh.fields.back()};
  for (const auto& options : variants) {
    auto lost = not_carried(mesh, MeshFormat::gmsh, options);
    if (!options.gmsh_41) {
      EXPECT_NE(lost.back().find("simplices in several parts"), std::string::npos);
      lost.pop_back();
    }
    EXPECT_EQ(lost, (std::vector<std::string>{
                        "format gmsh does not hold field 'nan', which has values that are not finite numbers",
                        "format gmsh does not hold field 'inf', which has values that are not finite numbers",
                        "format gmsh does not hold field 'big', which has 10 components, more than 9",
                        "format gmsh does not hold field 'u\\x0dv', whose name has control characters",
                        "format gmsh does not hold field '" + shown + "…', whose name has more than 127 bytes",
                        "format gmsh does not hold the name 'a\\x0ab' of part 1, which has control characters",
                        "format gmsh does not hold the name '" + shown + "…' of part 2, which has more than 127 bytes",
                        "format gmsh does not hold the name '\\x7f' of part 4, which has control characters",
                        "format gmsh does not hold parts without members (1) that have no name"}));
    write_mesh(directory / "a.msh", mesh, MeshFormat::gmsh, options);
    const auto back = read_mesh(directory / "a.msh");
    EXPECT_EQ(back.parts, expected.parts);
    EXPECT_EQ(back.fields, expected.fields);
    EXPECT_EQ(back.simplices, mesh.simplices);
    EXPECT_EQ(back.points, mesh.points);
  }
}

TEST(WriteGmsh, RefusesUnsoundMeshes) {
  const TemporaryDirectory directory;
  const auto refused = [&](auto ruin) {
    auto mesh = random_mesh(2, 3);
    ruin(mesh);
    EXPECT_THROW(write_mesh(directory / "a.msh", mesh), InputError);
  };
  refused([](MeshData& mesh) { mesh.lower[1].vertices()[3] = 30; });
  refused([](MeshData& mesh) { mesh.lower[1] = mesh.simplices; });
  refused([](MeshData& mesh) { mesh.lower.emplace_back(); });
  refused([](MeshData& mesh) { mesh.parts[0].members.back() = 40; });
  refused([](MeshData& mesh) { mesh.parts.back().members.back() = 30; });
  refused([](MeshData& mesh) { mesh.parts[0].members.insert(mesh.parts[0].members.begin(), -1); });
  refused([](MeshData& mesh) { mesh.parts[0].degree = 3; });
  refused([](MeshData& mesh) { mesh.fields[0].values.pop_back(); });
  refused([](MeshData& mesh) { mesh.fields[0].components = 0; });
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace
}  // namespace derham::io_test
