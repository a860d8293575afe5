#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/vtk_cells.hpp"
#include "derham/io/vtu_arrays.hpp"
#include "derham/io/vtu_document.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace derham {
namespace {

using pugi::xml_node;

// The one piece of an unstructured grid.
xml_node piece_of(const VtuDocument& document) {
  const auto root = document.root();
  if (std::string_view(root.name()) != "VTKFile") document.fail_at(root, "found no element VTKFile");
  const std::string_view type = root.attribute("type").value();
  if (type != "UnstructuredGrid")
    document.fail_at(root, text("this is a VTK file of type ", quoted_token(type), "; expected UnstructuredGrid"));
  const auto grid = root.child("UnstructuredGrid");
  const auto piece = grid.child("Piece");
  if (!piece) document.fail_at(grid ? grid : root, "the file has no Piece");
  if (const auto second = piece.next_sibling("Piece"))
    document.fail_at(second, "the file has several pieces; expected one: merge them first");
  return piece;
}

class VtuReader {
 public:
  VtuReader(Cursor& file, const ReadOptions& options)
      : document_(file), piece_(piece_of(document_)), arrays_(document_), options_(options) {}

  MeshData read() && {
    mesh_.ambient_dimension = 3;
    note_grid_data();
    mesh_.vertex_count = item_count("NumberOfPoints");
    const Offset cells = item_count("NumberOfCells");
    read_points();
    read_cells(document_.only_child(piece_, "Cells"), cells);
    read_fields(piece_.child("PointData"), MeshField::On::vertices, mesh_.vertex_count);
    read_fields(piece_.child("CellData"), MeshField::On::rows, cells);
    document_.stand_at(piece_.child("Cells"));
    std::move(cells_).move_to(mesh_, options_, document_.file());
    return std::move(mesh_);
  }

 private:
  void note_grid_data() {
    const auto root = document_.root();
    for (const auto& grid_data : {root.child("UnstructuredGrid").child("FieldData"), root.child("FieldData")})
      for (const auto array : grid_data.children())
        mesh_.notes.push_back(
            text("array ", quoted_token(array.attribute("Name").value()), " of the whole data set is not kept"));
  }

  Index item_count(const char* name) {
    const auto count = document_.number(piece_, name, -1);
    if (count / VtuArrays::largest_ratio > static_cast<std::int64_t>(document_.whole().size()))
      document_.fail_at(piece_, text(name, " is ", count, ", but the file cannot hold so many"));
    if (count > std::numeric_limits<Index>::max() - 1)
      throw LimitError(text(document_.file().name(), ": ", name, " is ", count,
                            ", more than this build's index type can number; build with DERHAM_INDEX64"));
    return static_cast<Index>(count);
  }

  void read_points() {
    const auto array = document_.only_child(document_.only_child(piece_, "Points"), "DataArray");
    if (const auto components = document_.number(array, "NumberOfComponents", 1); components != 3)
      document_.fail_at(array, text("the points have ", components, " components, expected 3"));
    arrays_.read(array, mesh_.vertex_count, 3, [&](NumberArray& numbers) {
      note_rounded(mesh_, "Points", numbers.coordinates(Offset{mesh_.vertex_count} * 3, mesh_.points));
    });
  }

  xml_node array_named(const xml_node& parent, std::string_view name) {
    xml_node found;
    for (const auto array : parent.children("DataArray")) {
      if (array.attribute("Name").value() != name) continue;
      if (found) document_.fail_at(array, text("a second array ", name));
      found = array;
    }
    if (!found) document_.fail_at(parent, text("the cells have no array ", name));
    return found;
  }

  void read_cells(const xml_node& node, Offset cells) {
    Offset end = 0;
    arrays_.read(array_named(node, "offsets"), cells, 1, [&](NumberArray& numbers) {
      numbers.integers(cells, "an offset", "expected more than the one before", [&](std::int64_t value) {
        if (value <= end || value > std::numeric_limits<std::int64_t>::max() / VtuArrays::largest_ratio) return false;
        cells_.end_cell(end = value);
        return true;
      });
    });
    arrays_.read(array_named(node, "types"), cells, 1, [&](NumberArray& numbers) {
      numbers.integers(cells, "a cell type", "expected 0 to 255", [&](std::int64_t type) {
        cells_.add_type(static_cast<std::uint8_t>(type));
        return type >= 0 && type <= 255;
      });
    });
    arrays_.read(array_named(node, "connectivity"), end, 1,
                 [&](NumberArray& numbers) { numbers.ids(end, mesh_.vertex_count, cells_.ids); });
  }

  void read_fields(const xml_node& data, MeshField::On on, Offset items) {
    for (const auto array : data.children()) {
      const std::string_view name = array.attribute("Name").value();
      const std::string_view type = array.attribute("type").value();
      if (std::string_view(array.name()) != "DataArray" || type == "String" || type == "Bit") {
        mesh_.notes.push_back(text(quoted_token(array.name()), " ", quoted_token(name), " is not kept"));
        continue;
      }
      constexpr std::int64_t most_components = 1 << 20;
      const auto components = document_.number(array, "NumberOfComponents", 1);
      if (components < 1 || components > most_components)
        document_.fail_at(array, text("NumberOfComponents is ", components, ", expected 1 to ", most_components));
      MeshField field{std::string(name), on, static_cast<int>(components), {}};
      arrays_.read(array, items, components, [&](NumberArray& numbers) {
        note_rounded(mesh_, name, numbers.values(items * components, field.values));
      });
      mesh_.fields.push_back(std::move(field));
    }
  }

  VtuDocument document_;
  xml_node piece_;
  VtuArrays arrays_;
  const ReadOptions& options_;
  MeshData mesh_;
  VtkCells cells_;
};

}  // namespace

MeshData read_vtu(Cursor& file, const ReadOptions& options) { return VtuReader(file, options).read(); }

}  // namespace derham
