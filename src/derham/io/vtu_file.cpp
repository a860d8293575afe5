#include "derham/io/vtu_file.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/text_writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <utility>

namespace derham {
namespace {

std::string escaped(std::string_view name) {
  std::string out;
  for (const char c : name) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::size_t value_bytes(const VtuFile::Values& values) {
  return std::visit([](auto v) { return sizeof(v[0]); }, values);
}

const char* type_name(const VtuFile::Values& values) {
  constexpr std::array names{"Float64", "Int8", "Int32", "Int64"};
  return names[values.index()];
}

// The XML part: it announces every array with the offset of its block in the appended data.
class Header {
 public:
  void array(const char* type, std::string_view name, int components, std::size_t bytes) {
    xml_ += text("        <DataArray type=\"", type, "\" Name=\"", escaped(name), "\" NumberOfComponents=\"",
                 components, "\" format=\"appended\" offset=\"", offset_, "\"/>\n");
    offset_ += sizeof(std::uint64_t) + bytes;
  }
  void line(std::string_view line) { (xml_ += line) += '\n'; }
  [[nodiscard]] const std::string& xml() const noexcept { return xml_; }

 private:
  std::string xml_;
  std::size_t offset_ = 0;
};

}  // namespace

VtuFile::VtuFile(const MeshData& mesh)
    : ambient_dimension_(mesh.ambient_dimension), points_(mesh.has_corners() ? mesh.corners : mesh.points),
      simplices_(mesh.simplices), vertex_count_(mesh.vertex_count), one_point_per_corner_(mesh.has_corners()) {
  require_valid();
}

VtuFile::VtuFile(int m, std::span<const double> points, SimplexList simplices)
    : ambient_dimension_(m), points_(points), simplices_(std::move(simplices)),
      vertex_count_(m > 0 ? static_cast<Offset>(points.size()) / m : 0) {
  require_valid();
}

void VtuFile::require_valid() const {
  const int m = ambient_dimension_;
  if (m > 3) throw InputError(text("a vtu file holds positions in at most 3 dimensions, not ", m));
  if (m < 1 && vertex_count_ > 0) throw InputError("a vtu file needs positions; the mesh is abstract");
  if (simplices_.dimension() > 3)
    throw InputError(text("a vtu file holds simplices of dimension at most 3, not ", simplices_.dimension()));
  const auto ids = simplices_.vertices();
  const auto expected = (one_point_per_corner_ ? static_cast<Offset>(ids.size()) : vertex_count_) * m;
  if (static_cast<Offset>(points_.size()) != expected)
    throw InputError(text(points_.size(), " coordinates in dimension ", m, "; expected ", expected));
  for (const Index v : ids)
    if (v < 0 || v >= vertex_count_)
      throw InputError(text("vertex id ", v, " among ", vertex_count_, " vertices; expected 0 to ", vertex_count_ - 1));
}

VtuFile::Array VtuFile::checked(std::string name, Values values, int components, Offset items) const {
  const auto size = static_cast<Offset>(std::visit([](auto v) { return v.size(); }, values));
  if (name.empty()) throw InputError("a data array needs a name");
  if (components < 1 || size != items * components)
    throw InputError(text("data array '", name, "' has ", size, " values; expected ", items, " times ", components));
  return {std::move(name), values, components};
}

VtuFile& VtuFile::point_data(std::string name, Values values, int components) {
  point_arrays_.push_back(checked(std::move(name), values, components, vertex_count_));
  return *this;
}

VtuFile& VtuFile::cell_data(std::string name, Values values, int components) {
  cell_arrays_.push_back(checked(std::move(name), values, components, simplices_.size()));
  return *this;
}

void VtuFile::write(const std::string& path) const {
  AtomicFile file(path);
  TextWriter writer(file);
  write(writer);
  writer.flush();
  file.commit();
}

void VtuFile::write(TextWriter& file) const {
  const auto ids = simplices_.vertices();
  const auto point_count = one_point_per_corner_ ? ids.size() : static_cast<std::size_t>(vertex_count_);
  const auto cell_count = static_cast<std::size_t>(simplices_.size());
  const auto array_bytes = [](const Array& array, std::size_t items) {
    return items * static_cast<std::size_t>(array.components) * value_bytes(array.values);
  };
  constexpr auto int64_bytes = sizeof(std::int64_t);

  Header header;
  header.line("<?xml version=\"1.0\"?>");
  header.line(text("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
                   std::endian::native == std::endian::little ? "Little" : "Big", "Endian\" header_type=\"UInt64\">"));
  header.line("  <UnstructuredGrid>");
  header.line(text("    <Piece NumberOfPoints=\"", point_count, "\" NumberOfCells=\"", cell_count, "\">"));
  header.line("      <Points>");
  header.array("Float64", "Points", 3, point_count * 3 * sizeof(double));
  header.line("      </Points>\n      <Cells>");
  header.array("Int64", "connectivity", 1, ids.size() * int64_bytes);
  header.array("Int64", "offsets", 1, cell_count * int64_bytes);
  header.array("UInt8", "types", 1, cell_count);
  header.line("      </Cells>\n      <PointData>");
  for (const auto& a : point_arrays_)
    header.array(type_name(a.values), a.name, a.components, array_bytes(a, point_count));
  header.line("      </PointData>\n      <CellData>");
  for (const auto& a : cell_arrays_)
    header.array(type_name(a.values), a.name, a.components, array_bytes(a, cell_count));
  header.line("      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">");

  file.put(header.xml()).put('_');
  const auto begin_block = [&](std::size_t bytes) { file.put_bytes(static_cast<std::uint64_t>(bytes)); };

  const auto m = static_cast<std::size_t>(ambient_dimension_);
  begin_block(point_count * 3 * sizeof(double));
  for (std::size_t i = 0; i < point_count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) file.put_bytes(axis < m ? points_[i * m + axis] : 0.0);
  begin_block(ids.size() * int64_bytes);
  for (std::size_t i = 0; i < ids.size(); ++i)
    file.put_bytes(one_point_per_corner_ ? static_cast<std::int64_t>(i) : std::int64_t{ids[i]});
  begin_block(cell_count * int64_bytes);
  std::int64_t end = 0;
  for (Offset i = 0; i < simplices_.size(); ++i) file.put_bytes(end += static_cast<std::int64_t>(simplices_[i].size()));
  begin_block(cell_count);
  constexpr std::array<std::uint8_t, 4> cell_types{1, 3, 5, 10};  // VTK_VERTEX, VTK_LINE, VTK_TRIANGLE, VTK_TETRA
  for (Offset i = 0; i < simplices_.size(); ++i) file.put_bytes(cell_types[simplices_[i].size() - 1]);

  for (const auto& a : point_arrays_) {
    begin_block(array_bytes(a, point_count));
    const auto width = static_cast<std::size_t>(a.components);
    std::visit(
        [&](auto values) {
          for (std::size_t i = 0; i < point_count; ++i) {
            const std::size_t vertex = one_point_per_corner_ ? static_cast<std::size_t>(ids[i]) : i;
            for (std::size_t c = 0; c < width; ++c) file.put_bytes(values[vertex * width + c]);
          }
        },
        a.values);
  }
  for (const auto& a : cell_arrays_) {
    begin_block(array_bytes(a, cell_count));
    std::visit(
        [&](auto values) {
          for (const auto value : values) file.put_bytes(value);
        },
        a.values);
  }
  file.put("\n  </AppendedData>\n</VTKFile>\n");
}

void write_vtu(TextWriter& file, const MeshData& mesh, const WriteOptions&) { VtuFile(mesh).write(file); }

}  // namespace derham
