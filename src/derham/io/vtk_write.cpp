#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/renamed_fields.hpp"
#include "derham/io/vtk_cells.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace derham {
namespace {

// Numbers as text, one item per line, or as bytes, the highest first.
class NumberWriter {
 public:
  NumberWriter(TextWriter& file, bool is_text) : file_(file), is_text_(is_text) {}
  template <class Number>
  void put(Number value, bool ends_item) {
    if (is_text_)
      file_.put(value).put(ends_item ? '\n' : ' ');
    else
      file_.put_bytes(value, std::endian::native == std::endian::little);
  }
  void end_block() {
    if (!is_text_) file_.put('\n');
  }

 private:
  TextWriter& file_;
  bool is_text_;
};

// As VTK does it, for a name is one word.
std::string encoded_name(std::string_view name) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string out;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code > 0x20 && code < 0x7f && c != '"' && c != '%')
      out += c;
    else
      out += {'%', digits[code >> 4], digits[code & 15]};
  }
  return out.empty() ? "unnamed" : out;
}

void write_fields(TextWriter& file, NumberWriter numbers, const MeshData& mesh, MeshField::On on, Offset items,
                  Offset lower) {
  Offset count = 0;
  for (const auto& field : mesh.fields) count += field.on == on;
  if (count == 0) return;
  file.put(on == MeshField::On::rows ? "CELL_DATA " : "POINT_DATA ").put(items + lower);
  file.put("\nFIELD FieldData ").put(count).put('\n');
  for (const auto& field : mesh.fields) {
    if (field.on != on) continue;
    file.put(encoded_name(field.name)).put(' ').put(field.components).put(' ').put(items + lower).put(" double\n");
    const auto width = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < field.values.size(); ++i) numbers.put(field.values[i], (i + 1) % width == 0);
    for (Offset i = 0; i < lower; ++i)
      for (std::size_t c = 0; c < width; ++c) numbers.put(std::numeric_limits<double>::quiet_NaN(), c + 1 == width);
    numbers.end_block();
  }
}

}  // namespace

std::vector<std::string> lost_in_vtk(const MeshData& mesh, const WriteOptions&) {
  return renamed_fields(mesh, [](const std::string& name) { return name.empty() ? "unnamed" : name; });
}

void write_vtk(TextWriter& file, const MeshData& mesh, const WriteOptions& options) {
  const bool is_text = options.encoding != WriteOptions::Encoding::binary;
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  // The rows first, then what is listed beside them, highest dimension first.
  std::vector<const SimplexList*> lists{&mesh.simplices};
  for (std::size_t k = mesh.lower.size(); k-- > 0;) lists.push_back(&mesh.lower[k]);
  Offset cells = 0, size = 0;
  for (const auto* list : lists) {
    cells += list->size();
    size += list->size() + static_cast<Offset>(list->vertices().size());
  }
  if (size > std::numeric_limits<std::int32_t>::max())
    throw InputError(text("format vtk holds lists of cells of at most 2^31 - 1 numbers, this mesh needs ", size,
                          "; .vtu holds more"));

  NumberWriter numbers(file, is_text);
  file.put("# vtk DataFile Version 3.0\na mesh written by derham\n").put(is_text ? "ASCII" : "BINARY");
  file.put("\nDATASET UNSTRUCTURED_GRID\nPOINTS ").put(mesh.vertex_count).put(" double\n");
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) numbers.put(axis < m ? mesh.points[i * m + axis] : 0.0, axis == 2);
  numbers.end_block();
  file.put("CELLS ").put(cells).put(' ').put(size).put('\n');
  for (const auto* list : lists)
    for (Offset i = 0; i < list->size(); ++i) {
      const auto row = (*list)[i];
      numbers.put(static_cast<std::int32_t>(row.size()), false);
      for (std::size_t v = 0; v < row.size(); ++v) numbers.put(static_cast<std::int32_t>(row[v]), v + 1 == row.size());
    }
  numbers.end_block();
  file.put("CELL_TYPES ").put(cells).put('\n');
  for (const auto* list : lists)
    for (Offset i = 0; i < list->size(); ++i) numbers.put(std::int32_t{vtk_cell_types[(*list)[i].size() - 1]}, true);
  numbers.end_block();
  write_fields(file, numbers, mesh, MeshField::On::vertices, mesh.vertex_count, 0);
  write_fields(file, numbers, mesh, MeshField::On::rows, mesh.simplices.size(), cells - mesh.simplices.size());
}

}  // namespace derham
