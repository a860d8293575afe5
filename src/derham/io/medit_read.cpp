#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/read_hints.hpp"
#include "derham/io/unused_vertices.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace derham {
namespace {

// What a Medit file may hold beside simplices: the numbers per record, -1 for as many as the space has dimensions, -2
// where writers disagree. `counted`: a count precedes the records.
struct Keyword {
  std::string_view name;
  int width;
  bool counted = true;
};
constexpr std::array skipped_keywords{
    Keyword{"Corners", 1},
    Keyword{"Ridges", 1},
    Keyword{"RequiredVertices", 1},
    Keyword{"RequiredEdges", 1},
    Keyword{"RequiredTriangles", 1},
    Keyword{"RequiredQuadrilaterals", 1},
    Keyword{"Normals", -1},
    Keyword{"Tangents", -1},
    Keyword{"NormalAtVertices", 2},
    Keyword{"NormalAtTriangleVertices", 3},
    Keyword{"NormalAtQuadrilateralVertices", 4},
    Keyword{"TangentAtVertices", 2},
    Keyword{"TangentAtEdgeVertices", 3},
    Keyword{"TangentAtEdges", -2},
    Keyword{"SubDomainFromGeom", -2},
    Keyword{"SubDomainFromMesh", -2},
    Keyword{"VertexOnGeometricVertex", -2},
    Keyword{"VertexOnGeometricEdge", -2},
    Keyword{"EdgeOnGeometricEdge", -2},
    Keyword{"VerticesOnGeometricVertices", 2},
    Keyword{"VerticesOnGeometricEdges", -2},
    Keyword{"VerticesOnGeometricTriangles", -2},
    Keyword{"EdgesOnGeometricEdges", 2},
    Keyword{"TrianglesOnGeometricTriangles", 2},
    Keyword{"PeriodicVertices", 2},
    Keyword{"PeriodicEdges", 2},
    Keyword{"PeriodicTriangles", 2},
    Keyword{"AngleOfCornerBound", 1, false},
    Keyword{"BoundingBox", -2, false},
};

// The sections of simplices, and quadrilaterals: their corners, and the nodes in the middle of edges behind them.
struct Kind {
  std::string_view name;
  const char *count, *records;
  std::size_t width, mid_nodes;
};
constexpr std::array kinds{
    Kind{"Edges", "the number of edges", "edges", 2, 0},
    Kind{"Triangles", "the number of triangles", "triangles", 3, 0},
    Kind{"Tetrahedra", "the number of tetrahedra", "tetrahedra", 4, 0},
    Kind{"Quadrilaterals", "the number of quadrilaterals", "quadrilaterals", 4, 0},
    Kind{"EdgesP2", "the number of edges", "edges", 2, 1},
    Kind{"TrianglesP2", "the number of triangles", "triangles", 3, 3},
    Kind{"TetrahedraP2", "the number of tetrahedra", "tetrahedra", 4, 6},
};

// Medit files are a sequence of tokens; lines mean nothing.
class MeditReader {
 public:
  MeditReader(Cursor& file, const ReadOptions& options) : file_(file), options_(options) {}

  MeshData read() && {
    read_header();
    while (file_.next_line()) {
      const auto start = file_.offset();
      const auto keyword = file_.word("a keyword");
      if (keyword == "End" || keyword == "END") {
        file_.end_file();
        has_end_ = true;
        break;
      }
      read_section(keyword, start);
    }
    if (!has_vertices_) file_.fail("the file has no section Vertices");
    if (!has_end_)
      mesh_.notes.emplace_back("the file does not say End: it may have been cut short between two sections");
    if (quadrilaterals_ > 0)
      mesh_.notes.push_back(
          text("split ", quadrilaterals_, " quadrilaterals into ", 2 * quadrilaterals_, " triangles"));
    std::move(simplices_).move_to(mesh_);
    std::move(vertex_parts_).move_to(mesh_);
    drop_mid_nodes(mesh_, higher_order_, "elements");
    return std::move(mesh_);
  }

 private:
  // Parts of degree 0 name vertices here, and a Medit file has no simplices of dimension 0.
  class VertexParts {
   public:
    void add(std::int64_t number, Index vertex) {
      if (number != 0) list_.add_to_part(0, number, vertex);
    }
    void move_to(MeshData& mesh) && {
      MeshData only_parts;
      std::move(list_).move_to(only_parts);
      for (auto& part : only_parts.parts) mesh.parts.push_back(std::move(part));
    }

   private:
    ListedSimplices list_;
  };

  [[noreturn]] void refuse(std::int64_t start, const std::string& message) {
    file_.rewind(start);
    file_.fail(message);
  }

  // The next token may stand on any line.
  std::int64_t integer(const char* what) {
    (void)file_.next_line();
    return file_.integer(what);
  }
  double real(const char* what) {
    (void)file_.next_line();
    return file_.real(what);
  }
  Index count(const char* what, std::int64_t record_bytes) {
    (void)file_.next_line();
    return file_.count(what, record_bytes);
  }

  void read_header() {
    if (!file_.next_line()) file_.fail_token("MeshVersionFormatted", nullptr);
    const auto start = file_.offset();
    const auto first = file_.word("MeshVersionFormatted");
    if (first == "MeshVersionUnformatted") refuse(start, "this is binary Medit; expected ASCII: MeshVersionFormatted");
    if (first != "MeshVersionFormatted") {
      file_.rewind(start);
      file_.fail_token("MeshVersionFormatted", nullptr);
    }
    (void)file_.next_line();
    (void)file_.integer("the version of the format", 1, 4);
  }

  void read_section(std::string_view keyword, std::int64_t start) {
    for (const auto& kind : kinds)
      if (kind.name == keyword) return read_simplices(kind, start);  // all that the sections of one name hold
    if (std::ranges::find(seen_, keyword) != seen_.end())
      refuse(start, text("a second section ", quoted_token(keyword), "; expected one: join the two"));
    seen_.emplace_back(keyword);
    if (keyword == "Dimension") {
      (void)file_.next_line();
      mesh_.ambient_dimension = static_cast<int>(file_.integer("the dimension", 2, 3));
      return;
    }
    if (mesh_.ambient_dimension == 0) refuse(start, text("found ", quoted_token(keyword), ", expected Dimension"));
    if (keyword == "Vertices") return read_vertices();
    for (const auto& skipped : skipped_keywords)
      if (skipped.name == keyword) return skip(skipped);
    for (const std::string_view other : {"Hexahedra", "Hexaedra", "Prisms", "Pentahedra", "Pyramids", "Polyhedra"})
      if (other == keyword) return read_none_of(keyword, "expected tetrahedra", start);
    for (const std::string_view other : {"QuadrilateralsQ2", "HexahedraQ2", "PrismsP2", "PyramidsP2"})
      if (other == keyword) return read_none_of(keyword, "expected simplices of first order", start);
    refuse(start, text("found ", quoted_token(keyword), ", expected a keyword of the format such as Vertices"));
  }

  // A section that derham does not read may still stand there empty.
  void read_none_of(std::string_view keyword, const char* expected, std::int64_t start) {
    if (integer("the number of records") != 0)
      refuse(start, text("the file has ", keyword, ", which are no simplices; ", expected));
  }

  void read_vertices() {
    has_vertices_ = true;
    const int m = mesh_.ambient_dimension;
    mesh_.vertex_count = count("the number of vertices", 2 * (m + 1));
    reserve_large(mesh_.points, static_cast<std::size_t>(mesh_.vertex_count) * static_cast<std::size_t>(m));
    for (Index i = 0; i < mesh_.vertex_count; ++i) {
      next_record(i, mesh_.vertex_count, "vertices");
      for (int axis = 0; axis < m; ++axis) mesh_.points.push_back(real("a coordinate"));
      vertex_parts_.add(integer("the reference of a vertex"), i);
    }
  }

  void read_simplices(const Kind& kind, std::int64_t start) {
    if (!has_vertices_) refuse(start, text(kind.name, " stand before Vertices; expected Vertices first"));
    const bool is_quad = kind.name == "Quadrilaterals";
    const Index records = count(kind.count, 2 * (static_cast<std::int64_t>(kind.width + kind.mid_nodes) + 1));
    if (is_quad && records > 0 && !options_.triangulate)
      refuse(start, text("the file has ", records,
                         " quadrilaterals, which are no simplices; expected triangles: split them first, or have them ",
                         split_on_reading));
    if (kind.mid_nodes > 0 && records > 0 && !options_.corner_nodes)
      refuse(start, text("the file has ", records, ' ', kind.name, "; expected simplices of first order, or ",
                         keep_corner_nodes));
    const int degree = static_cast<int>(kind.width) - 1;
    if (!is_quad && simplices_.size(degree) == 0) simplices_.reserve(degree, records, false);
    std::array<Index, 4> row{};
    for (Index i = 0; i < records; ++i) {
      next_record(i, records, kind.records);
      for (std::size_t v = 0; v < kind.width; ++v) {
        (void)file_.next_line();
        row[v] = static_cast<Index>(file_.integer("a vertex number", 1, mesh_.vertex_count) - 1);
      }
      for (std::size_t v = 0; v < kind.mid_nodes; ++v) {
        (void)file_.next_line();
        (void)file_.integer("a vertex number", 1, mesh_.vertex_count);
      }
      const auto reference = integer("a reference");
      if (is_quad) {
        add(std::array{row[0], row[1], row[2]}, reference);
        add(std::array{row[0], row[2], row[3]}, reference);
      } else {
        add(std::span<const Index>(row).first(kind.width), reference);
      }
    }
    if (is_quad) quadrilaterals_ += records;
    if (kind.mid_nodes > 0) higher_order_ += records;
  }

  void add(std::span<const Index> row, std::int64_t reference) {
    const Index position = simplices_.add(row);
    if (reference != 0) simplices_.add_to_part(static_cast<int>(row.size()) - 1, reference, position);
  }

  void next_record(Index i, Index records, const char* what) {
    if (!file_.next_line()) file_.fail(text("the file ends after ", i, " of ", records, " ", what));
  }

  void skip(const Keyword& keyword) {
    const Index records = keyword.counted ? count("the number of records", 2) : 1;
    std::int64_t numbers = 0;
    std::optional<std::int64_t> expected;
    if (keyword.width != -2)
      expected = std::int64_t{records} * (keyword.width == -1 ? mesh_.ambient_dimension : keyword.width);
    while (file_.next_line()) {
      if (expected && numbers == *expected) break;
      const auto start = file_.offset();
      const char first = file_.word("a number")[0];
      file_.rewind(start);
      if (!expected && !(first == '-' || first == '+' || first == '.' || (first >= '0' && first <= '9'))) break;
      (void)file_.real("a number");
      ++numbers;
    }
    if (expected ? numbers != *expected : (records == 0 ? numbers != 0 : numbers % records != 0 || numbers == 0))
      file_.fail(text("found ", numbers, " numbers in ", records, " records of the section ", keyword.name,
                      expected ? text("; expected ", *expected) : "; expected as many in every record"));
    if (records > 0) mesh_.notes.push_back(text("section ", keyword.name, " (", records, ") is not kept"));
  }

  Cursor& file_;
  const ReadOptions& options_;
  MeshData mesh_;
  ListedSimplices simplices_;
  VertexParts vertex_parts_;
  std::vector<std::string> seen_;
  Offset quadrilaterals_ = 0, higher_order_ = 0;
  bool has_vertices_ = false, has_end_ = false;
};

}  // namespace

MeshData read_medit(Cursor& file, const ReadOptions& options) { return MeditReader(file, options).read(); }

}  // namespace derham
