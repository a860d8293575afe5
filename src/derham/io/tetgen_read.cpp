#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/large_pages.hpp"
#include "derham/io/listed_simplices.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t most_attributes = 1000;

// Moves to record `i` of `count`.
void next_record(Cursor& file, const char* what, Index i, Index count) {
  if (!file.next_line()) file.fail(text("the file ends after ", i, " of ", count, " ", what));
}

// The number at the start of record i: the first is 0 or 1 and says so for all.
void take_number(Cursor& file, const char* what, Index i, std::int64_t& base) {
  base = i == 0 ? file.integer(what, 0, 1) : base;
  if (i > 0) file.integer(what, base + i, base + i);
}

// Columns of numbers that stand in a file row by row.
class Attributes {
 public:
  Attributes(std::int64_t columns, MeshField::On on) : columns_(static_cast<std::size_t>(columns)), on_(on) {}
  void take_row(Cursor& file) {
    for (std::size_t a = 0; a < columns_; ++a) values_.push_back(file.real_or_nan("an attribute"));
  }
  // TetGen's regions: a single column of integers.
  [[nodiscard]] bool are_regions() const {
    constexpr double largest = 9007199254740992;  // 2^53
    for (const double value : values_)
      if (!(std::abs(value) <= largest) || value != std::floor(value)) return false;
    return columns_ == 1;
  }
  void move_to(std::vector<MeshField>& fields) const {
    for (std::size_t a = 0; a < columns_; ++a) {
      MeshField field{text("attribute ", a + 1), on_, 1, {}};
      field.values.reserve(values_.size() / columns_);
      for (std::size_t i = a; i < values_.size(); i += columns_) field.values.push_back(values_[i]);
      fields.push_back(std::move(field));
    }
  }
  [[nodiscard]] const std::vector<double>& values() const noexcept { return values_; }

 private:
  std::size_t columns_;
  MeshField::On on_;
  std::vector<double> values_;
};

class TetgenReader {
 public:
  MeshData read(const TetgenFiles& files) && {
    read_nodes(files.nodes);
    if (&files.nodes != &files.simplices) files.nodes.end_file();
    read_simplices(files.simplices);
    const int n = mesh_.simplices.empty() ? mesh_.ambient_dimension : mesh_.simplices.dimension();
    mesh_.lower.resize(static_cast<std::size_t>(n));
    if (files.edges != nullptr) read_lower(*files.edges, 1);
    if (files.faces != nullptr && n == 3) read_lower(*files.faces, 2);
    if (files.faces != nullptr && n != 3)
      mesh_.notes.push_back(text(files.faces->name(), " is not read: the mesh consists of triangles already"));
    while (!mesh_.lower.empty() && mesh_.lower.back().empty()) mesh_.lower.pop_back();

    // Handed over without simplices, members of degree 0 stay what they are here: vertices.
    MeshData only_parts;
    std::move(parts_).move_to(only_parts);
    mesh_.parts = std::move(only_parts.parts);
    return std::move(mesh_);
  }

 private:
  void read_nodes(Cursor& file) {
    if (!file.next_line()) file.fail_token("the number of nodes", nullptr);
    mesh_.vertex_count = file.count("the number of nodes", 6);
    mesh_.ambient_dimension = static_cast<int>(file.integer("the dimension", 2, 3));
    const int m = mesh_.ambient_dimension;
    Attributes attributes(file.at_line_end() ? 0 : file.integer("the number of attributes", 0, most_attributes),
                          MeshField::On::vertices);
    const auto markers = file.at_line_end() ? 0 : file.integer("the number of boundary markers", 0, 1);
    file.end_line();
    reserve_large(mesh_.points, static_cast<std::size_t>(mesh_.vertex_count) * static_cast<std::size_t>(m));
    for (Index i = 0; i < mesh_.vertex_count; ++i) {
      next_record(file, "nodes", i, mesh_.vertex_count);
      take_number(file, "the node number", i, base_);
      for (int axis = 0; axis < m; ++axis) mesh_.points.push_back(file.real("a coordinate"));
      attributes.take_row(file);
      if (markers == 1) mark(0, file.integer("a boundary marker"), i);
      file.end_line();
    }
    attributes.move_to(mesh_.fields);
    if (base_ == 1) {
      reserve_large(mesh_.vertex_tags, static_cast<std::size_t>(mesh_.vertex_count));
      mesh_.vertex_tags.resize(static_cast<std::size_t>(mesh_.vertex_count));
      std::iota(mesh_.vertex_tags.begin(), mesh_.vertex_tags.end(), 1);
    }
  }

  void mark(int degree, std::int64_t marker, Index i) {
    if (marker != 0) parts_.add_to_part(degree, marker, i);
  }

  void take_nodes(Cursor& file, std::int64_t width, std::vector<Index>& ids) {
    for (std::int64_t v = 0; v < width; ++v)
      ids.push_back(static_cast<Index>(file.integer("a node number", base_, base_ + mesh_.vertex_count - 1) - base_));
  }

  void read_simplices(Cursor& file) {
    if (!file.next_line()) file.fail_token("the number of simplices", nullptr);
    const Index rows = file.count("the number of simplices", 8);
    const auto width = file.integer("the number of nodes per simplex");
    if (width == 6 || width == 10)
      file.fail(text(width, " nodes per simplex are quadratic ", width == 6 ? "triangles" : "tetrahedra", "; expected ",
                     width == 6 ? 3 : 4, ": make the mesh without second-order nodes (no -o2)"));
    if (width < 3 || width > mesh_.ambient_dimension + 1)
      file.fail(text(width, " nodes per simplex, expected 3", mesh_.ambient_dimension == 3 ? " or 4" : "",
                     " in dimension ", mesh_.ambient_dimension));
    Attributes attributes(file.at_line_end() ? 0 : file.integer("the number of attributes", 0, most_attributes),
                          MeshField::On::rows);
    file.end_line();
    std::int64_t row_base = 0;
    std::vector<Index> ids;
    reserve_large(ids, static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
    for (Index i = 0; i < rows; ++i) {
      next_record(file, "simplices", i, rows);
      take_number(file, "the number of the simplex", i, row_base);
      take_nodes(file, width, ids);
      attributes.take_row(file);
      file.end_line();
    }
    file.end_file();
    const int n = static_cast<int>(width) - 1;
    mesh_.simplices = SimplexList(n, std::move(ids));
    if (attributes.are_regions())
      for (Index i = 0; i < rows; ++i)
        mark(n, static_cast<std::int64_t>(attributes.values()[static_cast<std::size_t>(i)]), i);
    else
      attributes.move_to(mesh_.fields);
    if (row_base == 1) {
      reserve_large(mesh_.row_tags, static_cast<std::size_t>(rows));
      mesh_.row_tags.resize(static_cast<std::size_t>(rows));
      std::iota(mesh_.row_tags.begin(), mesh_.row_tags.end(), 1);
    }
  }

  // Triangles of a .face file, edges of an .edge file.
  void read_lower(Cursor& file, int degree) {
    constexpr std::array count_names{"", "the number of edges", "the number of faces"};
    constexpr std::array names{"", "edges", "faces"};
    const auto d = static_cast<std::size_t>(degree);
    if (!file.next_line()) file.fail_token(count_names[d], nullptr);
    const Index count = file.count(count_names[d], 4);
    const auto markers = file.at_line_end() ? 0 : file.integer("the number of boundary markers", 0, 1);
    file.end_line();
    std::int64_t base = 0, adjacent = 0;
    std::vector<Index> ids;
    reserve_large(ids, static_cast<std::size_t>(count) * (d + 1));
    for (Index i = 0; i < count; ++i) {
      next_record(file, names[d], i, count);
      if (i == 0) adjacent = adjacent_columns(file, degree, markers);
      take_number(file, degree == 1 ? "the number of the edge" : "the number of the face", i, base);
      take_nodes(file, degree + 1, ids);
      if (markers == 1) mark(degree, file.integer("a boundary marker"), i);
      for (std::int64_t column = 0; column < adjacent; ++column)
        (void)file.integer("the number of an adjacent tetrahedron", -1, any);
      file.end_line();
    }
    file.end_file();
    if (count > 0) mesh_.lower[d] = SimplexList(degree, std::move(ids));
  }

  // With -nn every face is followed by the two tetrahedra beside it, every edge by one.
  static std::int64_t adjacent_columns(Cursor& file, int degree, std::int64_t markers) {
    const auto start = file.offset();
    std::int64_t columns = 0;
    for (; !file.at_line_end(); ++columns) (void)file.word("a number");
    file.rewind(start);
    const auto rest = columns - (1 + degree + 1 + markers);
    if (rest == 3 && degree == 2)
      file.fail("a quadratic face of 6 nodes; expected 3: make the mesh without second-order nodes (no -o2)");
    return rest == degree ? rest : 0;
  }

  MeshData mesh_;
  ListedSimplices parts_;
  std::int64_t base_ = 0;
};

}  // namespace

TetgenPaths tetgen_paths(const std::string& path) {
  const auto stem = path.ends_with(".node") || path.ends_with(".ele") ? path.substr(0, path.find_last_of('.')) : path;
  return {stem + ".node", stem + ".ele", stem + ".face", stem + ".edge"};
}

MeshData read_tetgen(const TetgenFiles& files) { return TetgenReader().read(files); }

}  // namespace derham
