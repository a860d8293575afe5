#include "derham/io/vtu_file.hpp"

#include "derham/io/form_picture.hpp"
#include "io/io_fixture.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace derham::io_test {
namespace {

// The other side of the format: finds every array by its name and its block by the announced offset.
struct ParsedVtu {
  explicit ParsedVtu(const std::string& bytes) {
    const std::string marker = "<AppendedData encoding=\"raw\">\n_";
    const auto appended = bytes.find(marker);
    EXPECT_NE(appended, std::string::npos);
    header = bytes.substr(0, appended);
    const auto data = bytes.substr(appended + marker.size());
    std::size_t end_of_blocks = 0;
    for (auto at = header.find("<DataArray"); at != std::string::npos; at = header.find("<DataArray", at + 1)) {
      const auto tag = header.substr(at, header.find("/>", at) - at);
      const auto attribute = [&](const std::string& key) {
        const auto start = tag.find(key + "=\"") + key.size() + 2;
        return tag.substr(start, tag.find('"', start) - start);
      };
      const auto offset = std::stoul(attribute("offset"));
      EXPECT_EQ(offset, end_of_blocks);
      std::uint64_t size = 0;
      std::memcpy(&size, data.data() + offset, sizeof size);
      arrays[attribute("Name")] = {
          attribute("type"),
          tag.find("NumberOfComponents") == std::string::npos ? 1 : std::stoi(attribute("NumberOfComponents")),
          data.substr(offset + sizeof size, size)};
      end_of_blocks = offset + sizeof size + size;
    }
    EXPECT_EQ(data.substr(end_of_blocks), "\n  </AppendedData>\n</VTKFile>\n");
  }

  template <class Number>
  std::vector<Number> values(const std::string& name, const std::string& type, int components = 1) const {
    const auto& array = arrays.at(name);
    EXPECT_EQ(array.type, type);
    EXPECT_EQ(array.components, components);
    std::vector<Number> out(array.bytes.size() / sizeof(Number));
    std::memcpy(out.data(), array.bytes.data(), array.bytes.size());
    return out;
  }

  struct Array {
    std::string type;
    int components;
    std::string bytes;
  };
  std::string header;
  std::map<std::string, Array> arrays;
};

MeshData square() {
  MeshData mesh;
  mesh.vertex_count = 4;
  mesh.ambient_dimension = 2;
  mesh.points = {0, 0, 1, 0, 1, 1, 0, 1};
  mesh.simplices = SimplexList{{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(VtuFile, HoldsTheMeshAndItsData) {
  const TemporaryDirectory directory;
  const auto mesh = square();
  const std::vector<double> heat{1.5, 2.5, 3.5, 4.5}, flow{1, 2, 3, 4, 5, 6};
  const std::vector<std::int8_t> sign{1, -1};
  const std::vector<std::int32_t> index{0, 1};
  const std::vector<std::int64_t> tag{7, 1LL << 40};
  VtuFile(mesh)
      .point_data("a<b & \"c\"", heat)
      .cell_data("flow", flow, 3)
      .cell_data("sign", sign)
      .cell_data("index", index)
      .cell_data("tag", tag)
      .write(directory / "a.vtu");
  const ParsedVtu vtu(read_bytes(directory / "a.vtu"));
  EXPECT_NE(vtu.header.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(vtu.header.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_EQ(vtu.values<double>("Points", "Float64", 3), (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(vtu.values<std::int64_t>("connectivity", "Int64"), (std::vector<std::int64_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(vtu.values<std::int64_t>("offsets", "Int64"), (std::vector<std::int64_t>{3, 6}));
  EXPECT_EQ(vtu.values<std::uint8_t>("types", "UInt8"), (std::vector<std::uint8_t>{5, 5}));
  EXPECT_EQ(vtu.values<double>("a&lt;b &amp; &quot;c&quot;", "Float64"), heat);
  EXPECT_EQ(vtu.values<double>("flow", "Float64", 3), flow);
  EXPECT_EQ(vtu.values<std::int8_t>("sign", "Int8"), sign);
  EXPECT_EQ(vtu.values<std::int32_t>("index", "Int32"), index);
  EXPECT_EQ(vtu.values<std::int64_t>("tag", "Int64"), tag);
}

TEST(VtuFile, HoldsSimplicesOfEveryDegree) {
  const TemporaryDirectory directory;
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  VtuFile(3, points, SimplexList{{0}, {0, 1}, {0, 1, 2}, {0, 1, 2, 3}}).write(directory / "a.vtu");
  const ParsedVtu vtu(read_bytes(directory / "a.vtu"));
  EXPECT_EQ(vtu.values<std::uint8_t>("types", "UInt8"), (std::vector<std::uint8_t>{1, 3, 5, 10}));
  EXPECT_EQ(vtu.values<std::int64_t>("offsets", "Int64"), (std::vector<std::int64_t>{1, 3, 6, 10}));
  EXPECT_EQ(vtu.values<double>("Points", "Float64", 3), points);
}

TEST(VtuFile, APeriodicMeshHasOnePointPerCorner) {
  const TemporaryDirectory directory;
  MeshData circle;
  circle.vertex_count = 3;
  circle.ambient_dimension = 1;
  circle.simplices = SimplexList{{0, 1}, {1, 2}, {2, 0}};
  circle.corners = {0, 1, 1, 2, 2, 3};
  const std::vector<double> heat{10, 11, 12}, length{1, 2, 3};
  VtuFile(circle).point_data("heat", heat).cell_data("length", length).write(directory / "a.vtu");
  const ParsedVtu vtu(read_bytes(directory / "a.vtu"));
  EXPECT_EQ(vtu.values<double>("Points", "Float64", 3),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 2, 0, 0, 3, 0, 0}));
  EXPECT_EQ(vtu.values<std::int64_t>("connectivity", "Int64"), (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(vtu.values<double>("heat", "Float64"), (std::vector<double>{10, 11, 11, 12, 12, 10}));
  EXPECT_EQ(vtu.values<double>("length", "Float64"), length);
}

TEST(FormPicture, DrawsFormsOfEveryDegreeWithIndexAndSign) {
  const TemporaryDirectory directory;
  const auto mesh = square();
  SimplicialComplex<2> K(mesh.simplices);
  K.orient_by(std::vector<double>{-1, -1});  // both representatives are negative
  const Form<2, 0> height(K, {1, 2, 3, 4});
  const Form<2, 1> wind(K, {10, 20, 30, 40, 50});
  const Form<2, 1, Side::dual> flux(K, {5, 4, 3, 2, 1});
  const Form<2, 2> rain(K, {0.5, 0.25});
  FormPicture<2>(K, 2, mesh.points)
      .add("height", height)
      .add("wind", wind)
      .add("flux", flux)
      .add("rain", rain)
      .write(directory / "a.vtu");
  const ParsedVtu vtu(read_bytes(directory / "a.vtu"));
  EXPECT_NE(vtu.header.find("NumberOfPoints=\"4\" NumberOfCells=\"11\""), std::string::npos);
  EXPECT_EQ(vtu.values<std::int32_t>("degree", "Int32"), (std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 1, 1, 2, 2}));
  EXPECT_EQ(vtu.values<std::int64_t>("index", "Int64"), (std::vector<std::int64_t>{0, 1, 2, 3, 0, 1, 2, 3, 4, 0, 1}));
  EXPECT_EQ(vtu.values<std::int8_t>("sign", "Int8"), (std::vector<std::int8_t>{1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1}));
  EXPECT_EQ(vtu.values<double>("height", "Float64"), (std::vector<double>{1, 2, 3, 4}));
  const auto expect_on = [&](const std::string& name, std::size_t first, const std::vector<double>& values) {
    const auto cells = vtu.values<double>(name, "Float64");
    ASSERT_EQ(cells.size(), 11u);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i >= first && i < first + values.size()) {
        EXPECT_EQ(cells[i], values[i - first]) << name;
      } else {
        EXPECT_TRUE(std::isnan(cells[i])) << name;
      }
    }
  };
  expect_on("wind", 4, {10, 20, 30, 40, 50});
  expect_on("flux", 4, {5, 4, 3, 2, 1});
  expect_on("rain", 9, {0.5, 0.25});
  const SimplicialComplex<2> other(mesh.simplices);
  EXPECT_THROW((FormPicture<2>(K, 2, mesh.points).add("x", Form<2, 1>(other))), InputError);
}

TEST(VtuFile, LargeArraysCrossTheBuffer) {
  const TemporaryDirectory directory;
  std::vector<double> points(3 * 50000);
  std::iota(points.begin(), points.end(), 0.5);
  std::vector<Index> ids(2 * 40000);
  std::iota(ids.begin(), ids.end(), 0);
  for (Index& v : ids) v %= 50000;
  VtuFile(3, points, SimplexList(1, ids)).write(directory / "a.vtu");
  const ParsedVtu vtu(read_bytes(directory / "a.vtu"));
  EXPECT_EQ(vtu.values<double>("Points", "Float64", 3), points);
  EXPECT_EQ(vtu.values<std::int64_t>("connectivity", "Int64"), std::vector<std::int64_t>(ids.begin(), ids.end()));
}

TEST(VtuFile, RefusesWhatItCannotHold) {
  const std::vector<double> one{1};
  auto mesh = square();
  EXPECT_THROW(VtuFile(mesh).point_data("x", one), InputError);
  EXPECT_THROW(VtuFile(mesh).cell_data("x", one), InputError);
  EXPECT_THROW(VtuFile(mesh).cell_data("", std::vector<double>{1, 2}), InputError);
  EXPECT_THROW(VtuFile(mesh).cell_data("x", std::vector<double>{}, 0), InputError);
  const std::vector<double> two{1, 2}, four{1, 2, 3, 4};
  EXPECT_THROW(VtuFile(mesh).cell_data("x", two).cell_data("x", two), InputError);
  EXPECT_NO_THROW(VtuFile(mesh).cell_data("x", two).point_data("x", four));
  EXPECT_THROW(VtuFile(4, std::vector<double>(8), SimplexList{{0, 1}}), InputError);
  EXPECT_THROW(VtuFile(3, std::vector<double>(15), SimplexList{{0, 1, 2, 3, 4}}), InputError);
  EXPECT_THROW(VtuFile(3, std::vector<double>(7), SimplexList{{0, 1}}), InputError);
  EXPECT_THROW(VtuFile(3, std::vector<double>(6), SimplexList{{0, 2}}), InputError);
  EXPECT_THROW(VtuFile(0, std::vector<double>(6), SimplexList{{0, 1}}), InputError);
  mesh.points.clear();
  EXPECT_THROW((VtuFile(mesh)), InputError);
}

}  // namespace
}  // namespace derham::io_test
