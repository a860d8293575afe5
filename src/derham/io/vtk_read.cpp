#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/number_array.hpp"
#include "derham/io/vtk_cells.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr Offset most_components = 1 << 20;

std::string lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// Names of arrays are written with blanks, quotes, % and all but ASCII as %XX.
std::string decoded_name(std::string_view name) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '%' && i + 2 < name.size() && digit(name[i + 1]) >= 0 && digit(name[i + 2]) >= 0) {
      out += static_cast<char>(16 * digit(name[i + 1]) + digit(name[i + 2]));
      i += 2;
    } else {
      out += name[i];
    }
  }
  return out;
}

std::optional<NumberType> number_type(std::string_view name) {
  struct Named {
    std::string_view name;
    NumberType type;
  };
  constexpr std::array types{
      Named{"double", NumberType::float64},      Named{"float", NumberType::float32},
      Named{"int", NumberType::int32},           Named{"unsigned_int", NumberType::uint32},
      Named{"long", NumberType::int64},          Named{"unsigned_long", NumberType::uint64},
      Named{"long_long", NumberType::int64},     Named{"unsigned_long_long", NumberType::uint64},
      Named{"vtktypeint64", NumberType::int64},  Named{"vtktypeuint64", NumberType::uint64},
      Named{"short", NumberType::int16},         Named{"unsigned_short", NumberType::uint16},
      Named{"char", NumberType::int8},           Named{"signed_char", NumberType::int8},
      Named{"unsigned_char", NumberType::uint8}, Named{"vtkidtype", NumberType::int32},
  };
  const auto found = std::ranges::find(types, std::string_view(name), &Named::name);
  return found == types.end() ? std::nullopt : std::optional(found->type);
}

class VtkReader {
 public:
  VtkReader(Cursor& file, const ReadOptions& options) : file_(file), options_(options) { mesh_.ambient_dimension = 3; }

  MeshData read() && {
    read_header();
    while (file_.next_line()) {
      section_ = file_.offset();
      const auto keyword = file_.word("a section");
      read_section(lower_case(keyword), keyword);
    }
    if (!has_points_) file_.fail("the file has no POINTS");
    if (!is_polydata_ && !has_cells_) file_.fail("the file has no CELLS");
    if (!is_polydata_ && !has_types_) file_.fail("the file has no CELL_TYPES");
    if (types_ > 0) file_.rewind(types_);
    std::move(cells_).move_to(mesh_, options_, file_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& message) {
    file_.rewind(section_);
    file_.fail(message);
  }

  void demand_line() {
    if (!file_.next_line()) file_.fail_token("a section", nullptr);
  }

  void read_header() {
    const auto demand_word = [&](const char* expected) {
      if (!file_.next_line()) file_.fail_token(expected, nullptr);
      const auto start = file_.offset();
      if (file_.word(expected) == expected) return;
      file_.rewind(start);
      file_.fail_token(expected, nullptr);
    };
    for (const auto* word : {"#", "vtk", "DataFile", "Version"}) demand_word(word);
    const auto start = file_.offset();
    const auto version = file_.word("the version of the format");
    if (version.size() < 2 || version[0] < '1' || version[0] > '5' || version[1] != '.') {
      file_.rewind(start);
      file_.fail(text("this is version ", quoted_token(version), " of the VTK format; expected 1.0 to 5.1"));
    }
    has_offsets_ = version[0] == '5';
    file_.end_line();
    end_header_line();
    file_.skip_line();  // the title: anything
    end_header_line();
    demand_line();
    section_ = file_.offset();
    const auto encoding = lower_case(file_.word("ASCII or BINARY"));
    if (encoding != "ascii" && encoding != "binary") refuse("expected ASCII or BINARY as the third line");
    is_text_ = encoding == "ascii";
    file_.end_line();
    if (!is_text_) file_.name_bytes(true);

    demand_line();
    section_ = file_.offset();
    if (lower_case(file_.word("DATASET")) != "dataset") refuse("expected DATASET after the encoding");
    const auto kind = file_.word("the kind of data set");
    is_polydata_ = lower_case(kind) == "polydata";
    if (!is_polydata_ && lower_case(kind) != "unstructured_grid")
      refuse(text("the data set is ", quoted_token(kind),
                  "; expected UNSTRUCTURED_GRID or POLYDATA: convert it to an unstructured grid of simplices"));
    file_.end_line();
  }

  void end_header_line() { (void)file_.bytes(1, "the end of the line"); }

  void read_section(const std::string& keyword, std::string_view as_found) {
    const auto once = [&](bool& seen) {
      if (std::exchange(seen, true)) refuse(text("a second section ", quoted_token(as_found)));
    };
    if (keyword == "points") {
      once(has_points_);
      read_points();
    } else if (keyword == "metadata") {
      skip_metadata();
    } else if (keyword == "field") {
      read_field_data(-1);
    } else if (!has_points_) {
      refuse(text("found ", quoted_token(as_found), ", expected POINTS first"));
    } else if (keyword == "cells" && !is_polydata_) {
      once(has_cells_);
      read_cells();
    } else if (keyword == "cell_types" && !is_polydata_) {
      if (!has_cells_) refuse("CELL_TYPES stand before CELLS");
      once(has_types_);
      read_types();
    } else if (is_polydata_ &&
               (keyword == "vertices" || keyword == "lines" || keyword == "polygons" || keyword == "triangle_strips")) {
      if (has_data_) refuse("cells stand after the data");
      const std::uint8_t type = keyword == "vertices" ? 2 : keyword == "lines" ? 4 : keyword == "polygons" ? 7 : 6;
      if (std::ranges::count(polydata_, type) > 0) refuse(text("a second section ", quoted_token(as_found)));
      polydata_.push_back(type);
      // Data are by cells in this order, whatever the order of the sections.
      if (polydata_.size() > 1 && polydata_rank(polydata_[polydata_.size() - 2]) > polydata_rank(type))
        refuse("expected VERTICES, LINES, POLYGONS, TRIANGLE_STRIPS in this order");
      read_cells();
      types_ = section_;
      for (auto i = static_cast<Offset>(cells_.types.size()); i < cells_.size(); ++i)
        cells_.types.push_back(polydata_type(type, i));
    } else if (keyword == "point_data" || keyword == "cell_data") {
      read_data(keyword == "cell_data");
    } else {
      refuse(text("found ", quoted_token(as_found), ", expected a section such as CELLS or POINT_DATA"));
    }
  }

  static int polydata_rank(std::uint8_t type) noexcept { return type == 2 ? 0 : type == 4 ? 1 : type == 7 ? 2 : 3; }

  // The simplex that a cell of a polydata file is, if it is one.
  [[nodiscard]] std::uint8_t polydata_type(std::uint8_t type, Offset i) const noexcept {
    const auto width = cells_.width(i);
    const std::size_t simplex = type == 2 ? 1 : type == 4 ? 2 : 3;
    return width == simplex ? vtk_cell_types[simplex - 1] : type;
  }

  // `count` numbers of a type that are to follow: refused if the file cannot hold them.
  NumberArray numbers(Offset count, Offset per_item, NumberType type, const char* what) {
    const Offset width = is_text_ ? 2 : byte_width(type);
    if (per_item > 0 && count > (file_.remaining() + 1) / (width * per_item))
      file_.fail(text(what, " takes ", count, " times ", per_item, " numbers, but the ", file_.remaining(),
                      " bytes that are left cannot hold so many"));
    if (is_text_) return NumberArray(file_, type);
    end_header_line();
    const auto offset = file_.offset();
    const auto bytes = file_.bytes(count * per_item * width, what);
    return NumberArray(file_, bytes, type, std::endian::native == std::endian::little, offset);
  }

  NumberType type_of(const char* what) {
    const auto start = file_.offset();
    const auto name = file_.word(what);
    if (const auto type = number_type(lower_case(name))) return *type;
    file_.rewind(start);
    file_.fail(text("found ", quoted_token(name), " as ", what,
                    "; expected a type of numbers such as double, float, int: remove this array"));
  }

  void read_points() {
    mesh_.vertex_count = file_.count("the number of points", 3);
    const auto type = type_of("the type of the points");
    file_.end_line();
    numbers(mesh_.vertex_count, 3, type, "POINTS").coordinates(Offset{mesh_.vertex_count} * 3, mesh_.points);
  }

  void read_cells() {
    if (has_offsets_) return read_cells_by_offsets();
    const Index count = file_.count("the number of cells", 2);
    const Index size = file_.count("the size of the list of cells", 2);
    file_.end_line();
    auto list = numbers(size, 1, NumberType::int32, "the list of cells");
    cells_.ids.reserve(cells_.ids.size() + static_cast<std::size_t>(std::max<Offset>(Offset{size} - count, 0)));
    // Every cell is the number of its points, then their ids.
    Offset cells = 0, left = 0, used = 0;
    list.integers(size, "an entry of the list of cells", "expected a number of points or the id of a point",
                  [&](std::int64_t value) {
                    ++used;
                    if (left == 0) {
                      if (value < 1 || value > size - used || cells == count) return false;
                      left = value;
                      ++cells;
                      return true;
                    }
                    cells_.ids.push_back(static_cast<Index>(value));
                    if (--left == 0) cells_.end_cell(static_cast<Offset>(cells_.ids.size()));
                    return value >= 0 && value < mesh_.vertex_count;
                  });
    if (cells != count) refuse(text("the list of ", size, " numbers holds ", cells, " cells; expected ", count));
  }

  void read_cells_by_offsets() {
    const Index offsets = file_.count("the number of offsets", 2);
    const Index size = file_.count("the number of point ids", 2);
    file_.end_line();
    if (offsets == 0 && size > 0) refuse("there are point ids, but no offsets");
    demand_word("offsets");
    auto type = type_of("the type of the offsets");
    file_.end_line();
    const auto begin = static_cast<Offset>(cells_.ids.size());
    Offset before = -1;
    numbers(offsets, 1, type, "OFFSETS")
        .integers(offsets, "an offset",
                  "expected the first to be 0 and every other above the one before, up to the number of point ids",
                  [&](std::int64_t end) {
                    if (before < 0 ? end != 0 : end <= before || end > size) return false;
                    if (before >= 0) cells_.end_cell(begin + end);
                    before = end;
                    return true;
                  });
    if (offsets > 0 && before != size)
      refuse(text("the last offset is ", before, ", expected the number of point ids, ", size));
    demand_line();
    demand_word("connectivity");
    type = type_of("the type of the point ids");
    file_.end_line();
    numbers(size, 1, type, "CONNECTIVITY").ids(size, mesh_.vertex_count, cells_.ids);
  }

  void demand_word(const std::string& expected) {
    demand_line();
    const auto start = file_.offset();
    if (lower_case(file_.word(expected.c_str())) == expected) return;
    file_.rewind(start);
    file_.fail_token(expected.c_str(), nullptr);
  }

  void read_types() {
    const Index count = file_.count("the number of cell types", 2);
    file_.end_line();
    if (count != cells_.size()) refuse(text(count, " cell types for ", cells_.size(), " cells"));
    types_ = section_;
    cells_.types.reserve(static_cast<std::size_t>(count));
    numbers(count, 1, NumberType::int32, "CELL_TYPES")
        .integers(count, "a cell type", "expected 0 to 255", [&](std::int64_t type) {
          cells_.types.push_back(static_cast<std::uint8_t>(type));
          return type >= 0 && type <= 255;
        });
  }

  void read_data(bool on_cells) {
    const auto items = file_.integer("the number of items", 0, std::numeric_limits<std::int64_t>::max());
    file_.end_line();
    if (on_cells && !is_polydata_ && !has_types_) refuse("CELL_DATA stand before CELL_TYPES");
    if (items != (on_cells ? cells_.size() : Offset{mesh_.vertex_count}))
      refuse(text("data for ", items, on_cells ? " cells" : " points", "; the mesh has ",
                  on_cells ? cells_.size() : Offset{mesh_.vertex_count}));
    has_data_ = true;
    on_ = on_cells ? MeshField::On::rows : MeshField::On::vertices;
    while (file_.next_line()) {
      const auto start = file_.offset();
      const auto keyword = lower_case(file_.word("an attribute"));
      if (keyword == "metadata") {
        skip_metadata();
      } else if (keyword == "field") {
        read_field_data(items);
      } else if (keyword == "lookup_table") {
        (void)file_.word("the name of the table");
        const Index colors = file_.count("the number of colours", 4);
        file_.end_line();
        std::vector<double> dropped;
        (void)numbers(colors, 4, NumberType::uint8, "LOOKUP_TABLE").values(Offset{colors} * 4, dropped);
      } else if (!read_attribute(keyword, items)) {
        file_.rewind(start);
        return;
      }
    }
  }

  // SCALARS, VECTORS and their like; false if it is none of them.
  bool read_attribute(const std::string& keyword, Offset items) {
    struct Attribute {
      std::string_view name;
      int components;  // 0: given
    };
    constexpr std::array attributes{
        Attribute{"scalars", 1},    Attribute{"vectors", 3},      Attribute{"normals", 3},
        Attribute{"tensors", 9},    Attribute{"tensors6", 6},     Attribute{"texture_coordinates", 0},
        Attribute{"global_ids", 1}, Attribute{"pedigree_ids", 1}, Attribute{"color_scalars", 0}};
    const auto found = std::ranges::find(attributes, std::string_view(keyword), &Attribute::name);
    if (found == attributes.end()) return false;
    const auto name = decoded_name(file_.word("the name of the array"));
    Offset components = found->components;
    auto type = is_text_ ? NumberType::float32 : NumberType::uint8;  // of colours
    if (components == 0) components = file_.integer("the number of components", 1, most_components);
    if (keyword != "color_scalars") type = type_of("the type of the array");
    if (keyword == "scalars" && !file_.at_line_end())
      components = file_.integer("the number of components", 1, most_components);
    file_.end_line();
    if (keyword == "scalars") skip_table_line();
    take_field(name, components, items, type);
    return true;
  }

  // SCALARS may name the table of their colours.
  void skip_table_line() {
    const auto start = file_.offset();
    if (file_.next_line() && lower_case(file_.word("LOOKUP_TABLE")) == "lookup_table") {
      (void)file_.word("the name of the table");
      file_.end_line();
    } else {
      file_.rewind(start);
    }
  }

  void take_field(const std::string& name, Offset components, Offset items, NumberType type) {
    MeshField field{name, on_, static_cast<int>(components), {}};
    if (numbers(items, components, type, "an array").values(items * components, field.values))
      mesh_.notes.push_back(text("field ", quoted_token(name), ": integers beyond 2^53 are rounded"));
    mesh_.fields.push_back(std::move(field));
  }

  // FIELD: arrays with names. `items` is -1 for those that belong to the whole data set, which are dropped.
  void read_field_data(Offset items) {
    (void)file_.word("the name of the field data");
    const Index count = file_.count("the number of arrays", 6);
    file_.end_line();
    for (Index i = 0; i < count; ++i) {
      if (!file_.next_line()) file_.fail(text("the file ends after ", i, " of ", count, " arrays"));
      auto name = file_.word("the name of an array");
      if (name == "METADATA") {
        skip_metadata();
        if (!file_.next_line()) file_.fail(text("the file ends after ", i, " of ", count, " arrays"));
        name = file_.word("the name of an array");
      }
      const auto decoded = decoded_name(name);
      const auto components = file_.integer("the number of components", 1, most_components);
      const Offset length = file_.count("the number of tuples", 1);
      const auto type = type_of("the type of the array");
      file_.end_line();
      if (items >= 0 && length != items)
        file_.fail(text("array ", quoted_token(decoded), " has ", length, " tuples, expected ", items));
      if (items >= 0) {
        take_field(decoded, components, items, type);
      } else {
        std::vector<double> dropped;
        (void)numbers(length, components, type, "an array").values(length * components, dropped);
        mesh_.notes.push_back(text("array ", quoted_token(decoded), " of the whole data set is not kept"));
      }
    }
  }

  // Up to an empty line.
  void skip_metadata() {
    file_.skip_line();
    while (file_.remaining() > 0) {
      end_header_line();
      if (file_.at_line_end()) return;
      file_.skip_line();
    }
  }

  Cursor& file_;
  const ReadOptions& options_;
  MeshData mesh_;
  VtkCells cells_;
  MeshField::On on_ = MeshField::On::vertices;
  std::int64_t section_ = 0, types_ = 0;
  std::vector<std::uint8_t> polydata_;
  bool is_text_ = true, is_polydata_ = false, has_offsets_ = false;
  bool has_points_ = false, has_cells_ = false, has_types_ = false, has_data_ = false;
};

}  // namespace

MeshData read_vtk(Cursor& file, const ReadOptions& options) { return VtkReader(file, options).read(); }

}  // namespace derham
