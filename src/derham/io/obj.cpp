#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/polygons.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

namespace derham {
namespace {

using namespace std::string_view_literals;

// What else a line of an OBJ file may begin with: it says nothing about the complex. Sorted.
constexpr std::array skipped_keywords{
    "bevel"sv, "bmat"sv,      "bsp"sv,    "bzp"sv,    "c_interp"sv,   "call"sv,  "cdc"sv,      "cdp"sv,
    "con"sv,   "csh"sv,       "cstype"sv, "ctech"sv,  "curv"sv,       "curv2"sv, "d_interp"sv, "deg"sv,
    "end"sv,   "g"sv,         "hole"sv,   "lod"sv,    "maplib"sv,     "mg"sv,    "mtllib"sv,   "o"sv,
    "parm"sv,  "res"sv,       "s"sv,      "scrv"sv,   "shadow_obj"sv, "sp"sv,    "stech"sv,    "step"sv,
    "surf"sv,  "trace_obj"sv, "trim"sv,   "usemap"sv, "usemtl"sv,     "vn"sv,    "vp"sv,       "vt"sv};
static_assert(std::ranges::is_sorted(skipped_keywords));

// Counts what is skipped, for the notes.
class Skipped {
 public:
  // False if no line may begin with `keyword`.
  bool count_line(std::string_view keyword) noexcept {
    const auto* const found = std::ranges::lower_bound(skipped_keywords, keyword);
    if (found == skipped_keywords.end() || *found != keyword) return false;
    ++lines_[static_cast<std::size_t>(found - skipped_keywords.begin())];
    return true;
  }
  void count_colour() noexcept { ++colours_; }

  void note_on(MeshData& mesh) const {
    std::string counts;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i] > 0) counts += text(counts.empty() ? "" : ", ", lines_[i], " ", skipped_keywords[i]);
    if (!counts.empty()) mesh.notes.push_back("skipped lines: " + counts);
    if (colours_ > 0) mesh.notes.push_back(text("skipped the colours of ", colours_, " vertices"));
  }

 private:
  std::array<Offset, skipped_keywords.size()> lines_{};
  Offset colours_ = 0;
};

// The vertex number of a corner "v", "v/vt", "v//vn" or "v/vt/vn"; 0, which numbers nothing, if it is none of these.
std::int64_t corner_number(std::string_view corner) noexcept {
  const char* at = corner.data();
  const char* const end = at + corner.size();
  std::int64_t number = 0, unused = 0;
  auto result = std::from_chars(at, end, number);
  for (int part = 1; part < 3 && result.ec == std::errc() && result.ptr != end && *result.ptr == '/'; ++part) {
    at = result.ptr + 1;
    if (at == end || *at == '/')
      result.ptr = at;
    else
      result = std::from_chars(at, end, unused);
  }
  return result.ec == std::errc() && result.ptr == end ? number : 0;
}

// Reads the corners of p, l and f lines. A corner may name a vertex that comes later in the file; the farthest such
// name is kept until all vertices are known.
class Corners {
 public:
  explicit Corners(Cursor& file) : file_(file) {}

  // Numbers count from 1, negative ones backwards from the last of the `known` vertices.
  Index next(Index known) {
    (void)file_.at_line_end();
    const auto here = file_.offset();
    const auto number = corner_number(file_.word("a vertex number"));
    const auto id = number > 0 ? number - 1 : known + number;
    if (number == 0 || id < 0 || id >= std::numeric_limits<Index>::max()) {
      file_.rewind(here);
      file_.fail_token(number == 0 ? "a vertex number such as 7, -1 or 7/1/3"
                                   : text("a vertex number from ", -std::int64_t{known}, " to ", known).c_str(),
                       nullptr);
    }
    if (id >= known && id > farthest_) {
      farthest_ = id;
      farthest_offset_ = here;
    }
    return static_cast<Index>(id);
  }

  // Refuses names of vertices that never came.
  void finish(Index vertex_count) {
    if (farthest_ < vertex_count) return;
    file_.rewind(farthest_offset_);
    file_.fail(text("vertex number ", farthest_ + 1, ", but the file has ", vertex_count, " vertices"));
  }

 private:
  Cursor& file_;
  std::int64_t farthest_ = -1, farthest_offset_ = 0;
};

void read_vertex(Cursor& file, MeshData& mesh, Skipped& skipped) {
  if (mesh.vertex_count == std::numeric_limits<Index>::max() - 1)
    throw LimitError(
        text(file.name(), ": more vertices than this build's index type can number; build with DERHAM_INDEX64"));
  for (int axis = 0; axis < 3; ++axis) mesh.points.push_back(file.real("a coordinate"));
  ++mesh.vertex_count;
  // What may follow: a weight, or a colour of 3 or 4 components.
  int extra = 0;
  double last = 1;
  for (; extra < 4 && !file.at_line_end(); ++extra) last = file.real("a colour");
  file.end_line();
  if (extra == 1 && last != 1)
    file.fail(text("a vertex of weight ", last, "; expected weight 1: derham reads no rational curves"));
  if (extra == 2) file.fail("5 numbers for a vertex; expected 3 coordinates, and possibly a weight or a colour");
  if (extra > 2) skipped.count_colour();
}

}  // namespace

bool is_obj_keyword(std::string_view word) noexcept {
  return word == "v" || word == "f" || word == "l" || word == "p" || std::ranges::binary_search(skipped_keywords, word);
}

MeshData read_obj(Cursor& file, const ReadOptions& options) {
  MeshData mesh;
  mesh.ambient_dimension = 3;
  ListedSimplices rows;
  Corners corners(file);
  Polygons polygons(file, options);
  Skipped skipped;
  std::vector<Index> row(3);
  const auto next_corner = [&] { return corners.next(mesh.vertex_count); };
  while (file.next_line()) {
    const auto start = file.offset();
    const auto keyword = file.word("a keyword");
    if (keyword == "v") {
      read_vertex(file, mesh, skipped);
    } else if (keyword == "f") {
      row.resize(3);
      for (Index& v : row) v = next_corner();
      while (!file.at_line_end()) row.push_back(next_corner());
      polygons.add(row, rows);
    } else if (keyword == "l") {
      row[0] = next_corner();
      do {
        row[1] = next_corner();
        rows.add(std::span(row).first(2));
        row[0] = row[1];
      } while (!file.at_line_end());
    } else if (keyword == "p") {
      do {
        row[0] = next_corner();
        rows.add(std::span(row).first(1));
      } while (!file.at_line_end());
    } else if (skipped.count_line(keyword)) {
      file.skip_line();
    } else {
      file.rewind(start);
      file.fail_token("an OBJ keyword such as v, f or vn", nullptr);
    }
  }
  corners.finish(mesh.vertex_count);
  mesh.vertex_tags.resize(static_cast<std::size_t>(mesh.vertex_count));
  std::iota(mesh.vertex_tags.begin(), mesh.vertex_tags.end(), 1);  // OBJ numbers vertices from 1
  polygons.note_on(mesh);
  skipped.note_on(mesh);
  std::move(rows).move_to(mesh);
  return mesh;
}

void write_obj(TextWriter& file, const MeshData& mesh, const WriteOptions&) {
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  if (mesh.vertex_count == 0) file.put("# no vertices\n");  // a file without content would be refused
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count); ++i) {
    file.put('v');
    for (std::size_t axis = 0; axis < 3; ++axis) file.put(' ').put(axis < m ? mesh.points[i * m + axis] : 0.0);
    file.put('\n');
  }
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    const auto row = mesh.simplices[i];
    file.put("plf"sv[row.size() - 1]);
    for (const Index v : row) file.put(' ').put(std::int64_t{v} + 1);
    file.put('\n');
  }
}

}  // namespace derham
