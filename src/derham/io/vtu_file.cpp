#include "derham/io/vtu_file.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/base64_writer.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/renamed_fields.hpp"
#include "derham/io/text_writer.hpp"
#include "derham/io/vtk_cells.hpp"
#include "derham/io/xml_text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace derham {
namespace {

std::size_t value_bytes(const VtuFile::Values& values) {
  return std::visit([](auto v) { return sizeof(v[0]); }, values);
}

const char* type_name(const VtuFile::Values& values) {
  constexpr std::array names{"Float64", "Int8", "Int32", "Int64"};
  return names[values.index()];
}

// Whether no number is infinite or NaN: VTK reads none of these in the text of a .vtu file.
bool is_finite(const VtuFile::Values& values) {
  const auto* const numbers = std::get_if<std::span<const double>>(&values);
  return numbers == nullptr || std::ranges::all_of(*numbers, [](double x) { return std::isfinite(x); });
}

// Writes numbers one after the other: text of its own lines, bytes as they are, or base64.
class NumberWriter {
 public:
  enum class Form : std::uint8_t { text, raw, base64 };
  NumberWriter(TextWriter& file, Form form) : file_(file), form_(form), base64_(file) {}
  template <class Number>
  void put(Number value) {
    if (form_ == Form::raw)
      file_.put_bytes(value);
    else if (form_ == Form::base64)
      base64_.put(value);
    else
      put_text(value);
  }
  void finish() { base64_.finish(); }

 private:
  template <class Number>
  void put_text(Number value) {
    if constexpr (sizeof(Number) == 1)
      file_.put(int{value});
    else
      file_.put(value);
    constexpr int numbers_per_line = 12;
    file_.put(++count_ % numbers_per_line == 0 ? '\n' : ' ');
  }

  TextWriter& file_;
  Form form_;
  Base64Writer base64_;
  int count_ = 0;
};

// One array of the file: its element, and what writes its numbers.
struct Block {
  const char* type;
  std::string_view name;
  int components;
  std::size_t bytes;
  std::function<void(NumberWriter&)> put;
  bool is_finite = true;
};

// The elements of the file with their arrays: in text the numbers stand inside, as text if they are finite, else they are
// appended as raw bytes.
class Document {
 public:
  Document(TextWriter& file, bool is_text) : file_(file), is_text_(is_text) {}
  void line(std::string_view line) { file_.put(line).put('\n'); }
  void array(Block block) {
    file_.put("        <DataArray type=\"").put(block.type).put("\" Name=\"").put(xml_escaped(block.name));
    file_.put('"');
    if (block.components > 1) file_.put(" NumberOfComponents=\"").put(block.components).put('"');
    if (is_text_) {
      file_.put(block.is_finite ? " format=\"ascii\">\n" : " format=\"binary\">\n");
      NumberWriter numbers(file_, block.is_finite ? NumberWriter::Form::text : NumberWriter::Form::base64);
      if (!block.is_finite) numbers.put(static_cast<std::uint64_t>(block.bytes));
      block.put(numbers);
      numbers.finish();
      file_.put("\n        </DataArray>\n");
      return;
    }
    file_.put(" format=\"appended\" offset=\"").put(offset_).put("\"/>\n");
    offset_ += sizeof(std::uint64_t) + block.bytes;
    appended_.push_back(std::move(block));
  }
  void append() {
    if (is_text_) return;
    file_.put("  <AppendedData encoding=\"raw\">\n_");
    NumberWriter numbers(file_, NumberWriter::Form::raw);
    for (const auto& block : appended_) {
      numbers.put(static_cast<std::uint64_t>(block.bytes));
      block.put(numbers);
    }
    file_.put("\n  </AppendedData>\n");
  }

 private:
  TextWriter& file_;
  bool is_text_;
  std::size_t offset_ = 0;
  std::vector<Block> appended_;
};

// XML holds few control characters, VTK no empty name.
std::string written_name(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') c = ' ';
  return name.empty() ? "unnamed" : name;
}

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

VtuFile::Array VtuFile::checked(const std::vector<Array>& others, std::string name, Values values, int components,
                                Offset items) {
  const auto size = static_cast<Offset>(std::visit([](auto v) { return v.size(); }, values));
  if (name.empty()) throw InputError("a data array needs a name");
  if (std::ranges::find(others, name, &Array::name) != others.end())
    throw InputError(text("two data arrays are called '", name, "'; expected distinct names"));
  if (components < 1 || size != items * components)
    throw InputError(text("data array '", name, "' has ", size, " values; expected ", items, " times ", components));
  return {std::move(name), values, components};
}

VtuFile& VtuFile::point_data(std::string name, Values values, int components) {
  point_arrays_.push_back(checked(point_arrays_, std::move(name), values, components, vertex_count_));
  return *this;
}

VtuFile& VtuFile::cell_data(std::string name, Values values, int components) {
  cell_arrays_.push_back(checked(cell_arrays_, std::move(name), values, components, simplices_.size()));
  return *this;
}

void VtuFile::write(const std::string& path) const {
  AtomicFile file(path);
  TextWriter writer(file);
  write(writer);
  writer.flush();
  file.commit();
}

void VtuFile::write(TextWriter& file, bool as_text) const {
  const auto ids = simplices_.vertices();
  const auto point_count = one_point_per_corner_ ? ids.size() : static_cast<std::size_t>(vertex_count_);
  const auto cell_count = static_cast<std::size_t>(simplices_.size());
  constexpr auto int64_bytes = sizeof(std::int64_t);

  Document document(file, as_text);
  document.line("<?xml version=\"1.0\"?>");
  document.line(text("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
                     std::endian::native == std::endian::little ? "Little" : "Big",
                     "Endian\" header_type=\"UInt64\">\n  <UnstructuredGrid>"));
  document.line(text("    <Piece NumberOfPoints=\"", point_count, "\" NumberOfCells=\"", cell_count, "\">"));
  document.line("      <Points>");
  const auto m = static_cast<std::size_t>(ambient_dimension_);
  document.array({"Float64", "Points", 3, point_count * 3 * sizeof(double), [&](NumberWriter& numbers) {
                    for (std::size_t i = 0; i < point_count; ++i)
                      for (std::size_t axis = 0; axis < 3; ++axis) numbers.put(axis < m ? points_[i * m + axis] : 0.0);
                  }});
  document.line("      </Points>\n      <Cells>");
  document.array({"Int64", "connectivity", 1, ids.size() * int64_bytes, [&](NumberWriter& numbers) {
                    for (std::size_t i = 0; i < ids.size(); ++i)
                      numbers.put(one_point_per_corner_ ? static_cast<std::int64_t>(i) : std::int64_t{ids[i]});
                  }});
  document.array({"Int64", "offsets", 1, cell_count * int64_bytes, [&](NumberWriter& numbers) {
                    std::int64_t end = 0;
                    for (Offset i = 0; i < simplices_.size(); ++i)
                      numbers.put(end += static_cast<std::int64_t>(simplices_[i].size()));
                  }});
  document.array({"UInt8", "types", 1, cell_count, [&](NumberWriter& numbers) {
                    for (Offset i = 0; i < simplices_.size(); ++i)
                      numbers.put(vtk_cell_types[simplices_[i].size() - 1]);
                  }});

  const auto data_array = [&](const Array& array, std::size_t items, bool per_corner) {
    const auto width = static_cast<std::size_t>(array.components);
    document.array({type_name(array.values), array.name, array.components, items * width * value_bytes(array.values),
                    [&array, width, items, per_corner, ids](NumberWriter& numbers) {
                      std::visit(
                          [&](auto values) {
                            for (std::size_t i = 0; i < items; ++i) {
                              const std::size_t item = per_corner ? static_cast<std::size_t>(ids[i]) : i;
                              for (std::size_t c = 0; c < width; ++c) numbers.put(values[item * width + c]);
                            }
                          },
                          array.values);
                    },
                    is_finite(array.values)});
  };
  document.line("      </Cells>\n      <PointData>");
  for (const auto& array : point_arrays_) data_array(array, point_count, one_point_per_corner_);
  document.line("      </PointData>\n      <CellData>");
  for (const auto& array : cell_arrays_) data_array(array, cell_count, false);
  document.line("      </CellData>\n    </Piece>\n  </UnstructuredGrid>");
  document.append();
  file.put("</VTKFile>\n");
}

std::vector<std::string> lost_in_vtu(const MeshData& mesh, const WriteOptions&) {
  return renamed_fields(mesh, written_name);
}

void write_vtu(TextWriter& file, const MeshData& mesh, const WriteOptions& options) {
  const bool as_text = options.encoding == WriteOptions::Encoding::ascii;
  // The rows first, then what is listed beside them, highest dimension first; of periodic meshes only the rows.
  const Offset lower = mesh.has_corners() ? 0 : mesh.lower_count();
  std::vector<std::vector<double>> padded;
  std::optional<VtuFile> vtu;
  if (lower == 0) {
    vtu.emplace(mesh);
  } else {
    auto cells = mesh.simplices;
    for (std::size_t k = mesh.lower.size(); k-- > 0;)
      for (Offset i = 0; i < mesh.lower[k].size(); ++i) cells.push_back(mesh.lower[k][i]);
    vtu.emplace(mesh.ambient_dimension, mesh.points, std::move(cells));
  }
  padded.reserve(mesh.fields.size());
  for (const auto& field : mesh.fields) {
    std::span<const double> values = field.values;
    if (field.on == MeshField::On::vertices) {
      vtu->point_data(written_name(field.name), values, field.components);
      continue;
    }
    if (lower > 0) {
      auto& copy = padded.emplace_back(field.values);
      copy.resize(copy.size() + static_cast<std::size_t>(lower * field.components),
                  std::numeric_limits<double>::quiet_NaN());
      values = copy;
    }
    vtu->cell_data(written_name(field.name), values, field.components);
  }
  vtu->write(file, as_text);
}

}  // namespace derham
