#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/read_hints.hpp"
#include "derham/io/unused_vertices.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
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
  Attributes(std::int64_t columns, MeshField::On on)
      : columns_(static_cast<std::size_t>(columns)), on_(on), are_regions_(columns == 1 && on == MeshField::On::rows) {}
  void take_row(Cursor& file) {
    if (are_regions_ && take_region(file)) return;
    for (std::size_t a = 0; a < columns_; ++a) values_.push_back(file.real_or_nan("an attribute"));
  }
  // TetGen's regions: a single column of integers on the simplices.
  [[nodiscard]] bool are_regions() const noexcept { return are_regions_; }
  [[nodiscard]] const std::vector<std::int64_t>& regions() const noexcept { return regions_; }
  void move_to(std::vector<MeshField>& fields) const {
    for (std::size_t a = 0; a < columns_; ++a) {
      MeshField field{tetgen_attribute_name(static_cast<Offset>(a) + 1), on_, 1, {}};
      field.values.reserve(values_.size() / columns_);
      for (std::size_t i = a; i < values_.size(); i += columns_) field.values.push_back(values_[i]);
      fields.push_back(std::move(field));
    }
  }

 private:
  // False if the next attribute is no region: then none is.
  bool take_region(Cursor& file) {
    if (!file.at_line_end()) {
      const auto start = file.offset();
      if (const auto region = tetgen_region(file.word("an attribute"))) {
        regions_.push_back(*region);
        return true;
      }
      file.rewind(start);
    }
    are_regions_ = false;
    for (const auto region : regions_) values_.push_back(static_cast<double>(region));
    return false;
  }

  std::size_t columns_;
  MeshField::On on_;
  bool are_regions_;
  std::vector<std::int64_t> regions_;
  std::vector<double> values_;
};

class TetgenReader {
 public:
  explicit TetgenReader(const ReadOptions& options) : corner_nodes_(options.corner_nodes) {}

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
    if (is_quadratic_) drop_mid_nodes(mesh_, mesh_.simplices.size(), "elements");
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

  // The nodes in the middle of edges, behind the corners.
  void pass_nodes(Cursor& file, std::int64_t count) const {
    for (; count > 0; --count) (void)file.integer("a node number", base_, base_ + mesh_.vertex_count - 1);
  }

  void read_simplices(Cursor& file) {
    if (!file.next_line()) file.fail_token("the number of simplices", nullptr);
    const Index rows = file.count("the number of simplices", 8);
    const auto nodes = file.integer("the number of nodes per simplex");
    is_quadratic_ = nodes == 6 || nodes == 10;
    if (is_quadratic_ && !corner_nodes_)
      file.fail(text(nodes, " nodes per simplex are quadratic ", nodes == 6 ? "triangles" : "tetrahedra", "; expected ",
                     nodes == 6 ? 3 : 4, ": make the mesh without second-order nodes (no -o2), or ",
                     keep_corner_nodes));
    const auto width = is_quadratic_ ? (nodes == 6 ? 3 : 4) : nodes;
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
      pass_nodes(file, nodes - width);
      attributes.take_row(file);
      file.end_line();
    }
    file.end_file();
    const int n = static_cast<int>(width) - 1;
    mesh_.simplices = SimplexList(n, std::move(ids));
    if (attributes.are_regions())
      for (Index i = 0; i < rows; ++i) mark(n, attributes.regions()[static_cast<std::size_t>(i)], i);
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
    std::int64_t base = 0;
    Columns columns;
    std::vector<Index> ids;
    reserve_large(ids, static_cast<std::size_t>(count) * (d + 1));
    for (Index i = 0; i < count; ++i) {
      next_record(file, names[d], i, count);
      if (i == 0) columns = further_columns(file, degree, markers);
      take_number(file, degree == 1 ? "the number of the edge" : "the number of the face", i, base);
      take_nodes(file, degree + 1, ids);
      pass_nodes(file, columns.mid_nodes);
      if (markers == 1) mark(degree, file.integer("a boundary marker"), i);
      for (std::int64_t column = 0; column < columns.adjacent; ++column)
        (void)file.integer("the number of an adjacent tetrahedron", -1, any);
      file.end_line();
    }
    file.end_file();
    if (count > 0) mesh_.lower[d] = SimplexList(degree, std::move(ids));
  }

  // With -o2 the corners of a face are followed by three more nodes, those of an edge by one; with -nn every face
  // ends with the two tetrahedra beside it, every edge with one.
  struct Columns {
    std::int64_t mid_nodes = 0, adjacent = 0;
  };
  [[nodiscard]] Columns further_columns(Cursor& file, int degree, std::int64_t markers) const {
    const auto start = file.offset();
    std::int64_t count = 0;
    for (; !file.at_line_end(); ++count) (void)file.word("a number");
    file.rewind(start);
    const auto rest = count - (1 + degree + 1 + markers);
    const std::int64_t mid_nodes = degree == 2 ? 3 : 1;
    if (is_quadratic_ && rest >= mid_nodes) return {mid_nodes, rest == mid_nodes + degree ? degree : 0};
    if (rest == 3 && degree == 2)
      file.fail(
          "a quadratic face of 6 nodes beside tetrahedra of 4; expected 3: make the mesh without second-order nodes "
          "(no -o2)");
    return {0, rest == degree ? degree : 0};
  }

  bool corner_nodes_;
  bool is_quadratic_ = false;
  MeshData mesh_;
  ListedSimplices parts_;
  std::int64_t base_ = 0;
};

}  // namespace

TetgenPaths tetgen_paths(const std::string& path) {
  const auto format = format_by_extension(path);
  const bool is_given = format == MeshFormat::tetgen;
  const auto dot = is_given ? path.find_last_of('.') : path.size();
  // As many capitals as the given extension begins with: .node, .Node or .NODE.
  const auto is_capital = [&](std::size_t at) { return at < path.size() && path[at] >= 'A' && path[at] <= 'Z'; };
  const std::size_t capitals = !is_capital(dot + 1) ? 0 : is_capital(dot + 2) ? 4 : 1;
  const auto named = [&](std::string extension) {
    for (std::size_t i = 0; i < std::min(capitals, extension.size()); ++i)
      extension[i] = static_cast<char>(extension[i] - 'a' + 'A');
    return path.substr(0, dot) + '.' + extension;
  };
  TetgenPaths paths{named("node"), named("ele"), named("face"), named("edge")};
  if (is_given) (path.size() - dot == 5 ? paths.node : paths.ele) = path;
  return paths;
}

std::string tetgen_attribute_name(Offset number) { return text("attribute ", number); }

std::optional<std::int64_t> tetgen_region(std::string_view attribute) {
  const char* const end = attribute.data() + attribute.size();
  std::int64_t region = 0;
  if (const auto found = std::from_chars(attribute.data(), end, region); found.ec == std::errc() && found.ptr == end)
    return region != 0 || attribute[0] != '-' ? std::optional(region)
                                              : std::nullopt;  // a real number has the sign of -0
  constexpr double largest = 9007199254740992;                 // 2^53
  double real = 0;
  if (attribute.starts_with('+')) attribute.remove_prefix(1);
  if (const auto found = std::from_chars(attribute.data(), end, real); found.ec != std::errc() || found.ptr != end)
    return {};
  if (!(std::abs(real) <= largest) || real != std::floor(real) || (real == 0 && std::signbit(real))) return {};
  return static_cast<std::int64_t>(real);
}

MeshData read_tetgen(const TetgenFiles& files, const ReadOptions& options) { return TetgenReader(options).read(files); }

}  // namespace derham
