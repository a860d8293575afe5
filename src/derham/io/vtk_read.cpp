#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/vtk_cells.hpp"
#include "derham/io/vtk_data.hpp"
#include "derham/io/vtk_input.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace derham {
namespace {

// The sections of cells of a POLYDATA file. Data are by cells in this order, whatever the order of the sections.
struct PolydataSection {
  std::string_view keyword;
  std::uint8_t type;  // of a cell that is no simplex
  std::size_t width;  // of one that is
};
constexpr std::array polydata_sections{PolydataSection{"vertices", 2, 1}, PolydataSection{"lines", 4, 2},
                                       PolydataSection{"polygons", 7, 3}, PolydataSection{"triangle_strips", 6, 3}};

class VtkReader {
 public:
  VtkReader(Cursor& file, const ReadOptions& options) : input_(file), file_(file), options_(options) {
    mesh_.ambient_dimension = 3;
  }

  MeshData read() && {
    input_.read_header();
    for (auto keyword = input_.next_section(); !keyword.empty(); keyword = input_.next_section()) read_section(keyword);
    if (!has_points_) file_.fail("the file has no POINTS");
    if (!input_.is_polydata() && !has_cells_) file_.fail("the file has no CELLS");
    if (!input_.is_polydata() && !has_types_) file_.fail("the file has no CELL_TYPES");
    if (types_ > 0) file_.rewind(types_);
    std::move(cells_).move_to(mesh_, options_, file_);
    return std::move(mesh_);
  }

 private:
  void read_section(const std::string& keyword) {
    const auto once = [&](bool& seen) {
      if (std::exchange(seen, true)) refuse_second();
    };
    if (keyword == "points") {
      once(has_points_);
      read_points();
    } else if (keyword == "metadata") {
      input_.skip_metadata();
    } else if (keyword == "field") {
      skip_vtk_field_data(input_, mesh_);
    } else if (!has_points_) {
      input_.refuse(text("found ", section_word(), ", expected POINTS first"));
    } else if (keyword == "cells" && !input_.is_polydata()) {
      once(has_cells_);
      read_cells();
    } else if (keyword == "cell_types" && !input_.is_polydata()) {
      if (!has_cells_) input_.refuse("CELL_TYPES stand before CELLS");
      once(has_types_);
      read_types();
    } else if (keyword == "point_data" || keyword == "cell_data") {
      read_data(keyword == "cell_data");
    } else {
      const auto* const found = std::ranges::find(polydata_sections, keyword, &PolydataSection::keyword);
      if (!input_.is_polydata() || found == polydata_sections.end())
        input_.refuse(text("found ", section_word(), ", expected a section such as CELLS or POINT_DATA"));
      read_polydata(static_cast<std::size_t>(found - polydata_sections.begin()));
    }
  }

  // The keyword of the section as it stands in the file.
  std::string section_word() {
    file_.rewind(input_.section());
    return quoted_token(file_.word("a section"));
  }
  [[noreturn]] void refuse_second() { input_.refuse(text("a second section ", section_word())); }

  void read_points() {
    mesh_.vertex_count = file_.count("the number of points", 3);
    const auto type = input_.number_type("the type of the points");
    file_.end_line();
    auto numbers = input_.numbers(mesh_.vertex_count, 3, type, "POINTS");
    note_rounded(mesh_, "POINTS", numbers.coordinates(Offset{mesh_.vertex_count} * 3, mesh_.points));
  }

  void read_polydata(std::size_t section) {
    if (has_data_) input_.refuse("cells stand after the data");
    if (std::exchange(has_polydata_[section], true)) refuse_second();
    if (std::ranges::find(has_polydata_.begin() + static_cast<std::ptrdiff_t>(section) + 1, has_polydata_.end(),
                          true) != has_polydata_.end())
      input_.refuse("expected VERTICES, LINES, POLYGONS, TRIANGLE_STRIPS in this order");
    read_cells();
    types_ = input_.section();
    const auto& [keyword, type, width] = polydata_sections[section];
    for (auto i = cells_.typed(); i < cells_.size(); ++i)
      cells_.add_type(cells_.width(i) == width ? vtk_cell_types[width - 1] : type);
  }

  void read_cells() {
    if (input_.has_offsets()) return read_cells_by_offsets();
    const Index count = file_.count("the number of cells", 2);
    const Index size = file_.count("the size of the list of cells", 2);
    file_.end_line();
    auto list = input_.numbers(size, 1, NumberType::int32, "the list of cells");
    reserve_large(cells_.ids, cells_.ids.size() + static_cast<std::size_t>(std::max<Offset>(Offset{size} - count, 0)));
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
    if (cells != count) input_.refuse(text("the list of ", size, " numbers holds ", cells, " cells; expected ", count));
  }

  void read_cells_by_offsets() {
    const Index offsets = file_.count("the number of offsets", 2);
    const Index size = file_.count("the number of point ids", 2);
    file_.end_line();
    if (offsets == 0 && size > 0) input_.refuse("there are point ids, but no offsets");
    input_.demand_word("offsets");
    auto type = input_.number_type("the type of the offsets");
    file_.end_line();
    const auto begin = static_cast<Offset>(cells_.ids.size());
    Offset before = -1;
    input_.numbers(offsets, 1, type, "OFFSETS")
        .integers(offsets, "an offset",
                  "expected the first to be 0 and every other above the one before, up to the number of point ids",
                  [&](std::int64_t end) {
                    if (before < 0 ? end != 0 : end <= before || end > size) return false;
                    if (before >= 0) cells_.end_cell(begin + end);
                    before = end;
                    return true;
                  });
    if (offsets > 0 && before != size)
      input_.refuse(text("the last offset is ", before, ", expected the number of point ids, ", size));
    input_.demand_word("connectivity");
    type = input_.number_type("the type of the point ids");
    file_.end_line();
    input_.numbers(size, 1, type, "CONNECTIVITY").ids(size, mesh_.vertex_count, cells_.ids);
  }

  void read_types() {
    const Index count = file_.count("the number of cell types", 2);
    file_.end_line();
    if (count != cells_.size()) input_.refuse(text(count, " cell types for ", cells_.size(), " cells"));
    types_ = input_.section();
    input_.numbers(count, 1, NumberType::int32, "CELL_TYPES")
        .integers(count, "a cell type", "expected 0 to 255", [&](std::int64_t type) {
          cells_.add_type(static_cast<std::uint8_t>(type));
          return type >= 0 && type <= 255;
        });
  }

  void read_data(bool on_cells) {
    const auto items = file_.integer("the number of items", 0, std::numeric_limits<std::int64_t>::max());
    file_.end_line();
    if (on_cells && !input_.is_polydata() && !has_types_) input_.refuse("CELL_DATA stand before CELL_TYPES");
    const Offset expected = on_cells ? cells_.size() : Offset{mesh_.vertex_count};
    if (items != expected)
      input_.refuse(text("data for ", items, on_cells ? " cells" : " points", "; the mesh has ", expected));
    has_data_ = true;
    read_vtk_data(input_, on_cells ? MeshField::On::rows : MeshField::On::vertices, items, mesh_);
  }

  VtkInput input_;
  Cursor& file_;
  const ReadOptions& options_;
  MeshData mesh_;
  VtkCells cells_;
  std::int64_t types_ = 0;
  std::array<bool, polydata_sections.size()> has_polydata_{};
  bool has_points_ = false, has_cells_ = false, has_types_ = false, has_data_ = false;
};

}  // namespace

MeshData read_vtk(Cursor& file, const ReadOptions& options) { return VtkReader(file, options).read(); }

}  // namespace derham
