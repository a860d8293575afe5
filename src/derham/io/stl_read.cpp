#include "derham/core/error.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/byte_order.hpp"
#include "derham/io/formats.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr std::int64_t header_bytes = 84, triangle_bytes = 50;

using Position = std::array<double, 3>;

// Finds the corners that lie at exactly the same place: a hash table of vertices, numbered as they first appear.
class Weld {
 public:
  // How many positions `vertices` takes.
  static constexpr std::size_t most_at_once = 96;

  explicit Weld(MeshData& mesh) : mesh_(mesh) { resize(64); }

  // Room for as many vertices as a closed surface of so many triangles has, half as many. Most of the table stays empty:
  // then few corners are compared with vertices other than their own.
  void reserve(std::int64_t triangles) {
    const auto count = static_cast<std::size_t>(triangles);
    reserve_large(mesh_.points, count / 2 * 3);
    resize(std::bit_ceil(2 * std::max<std::size_t>(count, 64)));
  }

  // The vertices at these positions. Their places in the table are far apart and not in the cache: all are asked for
  // before the first is looked at.
  void vertices(std::span<const Position> positions, std::vector<Index>& out) {
    std::array<std::uint64_t, most_at_once> hashes{};
    for (std::size_t i = 0; i < positions.size(); ++i) {
      hashes[i] = hash_of(positions[i]);
      __builtin_prefetch(&table_[slot_of(hashes[i])]);
    }
    for (std::size_t i = 0; i < positions.size(); ++i) out.push_back(vertex(positions[i], hashes[i]));
  }

 private:
  Index vertex(const Position& position, std::uint64_t hash) {
    auto slot = slot_of(hash);
    for (; table_[slot] >= 0; slot = (slot + 1) & (table_.size() - 1)) {
      const auto* const other = &mesh_.points[static_cast<std::size_t>(table_[slot]) * 3];
      if (other[0] == position[0] && other[1] == position[1] && other[2] == position[2]) return table_[slot];
    }
    const Index v = mesh_.vertex_count++;
    table_[slot] = v;
    mesh_.points.insert(mesh_.points.end(), position.begin(), position.end());
    if (static_cast<std::size_t>(v) >= table_.size() / 2) resize(table_.size() * 2);
    return v;
  }

  // Multiply-shift of the halves of the words (Thorup, "High speed hashing for integers and strings", 2015): whatever
  // the positions, few fall on the same place for nearly all multipliers.
  [[nodiscard]] std::uint64_t hash_of(const Position& position) const noexcept {
    std::uint64_t hash = multipliers_[6];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto word = std::bit_cast<std::uint64_t>(position[i] + 0.0);  // -0 becomes 0
      hash += multipliers_[2 * i] * (word & 0xffffffffU) + multipliers_[2 * i + 1] * (word >> 32);
    }
    return hash;
  }
  [[nodiscard]] std::size_t slot_of(std::uint64_t hash) const noexcept {
    return static_cast<std::size_t>(hash >> shift_);
  }

  // `size` is a power of two above 1.
  void resize(std::size_t size) {
    table_ = {};
    reserve_large(table_, size);
    table_.assign(size, -1);
    shift_ = 64 - std::countr_zero(size);
    for (Index v = 0; v < mesh_.vertex_count; ++v) {
      const auto* const position = &mesh_.points[static_cast<std::size_t>(v) * 3];
      auto slot = slot_of(hash_of({position[0], position[1], position[2]}));
      while (table_[slot] >= 0) slot = (slot + 1) & (table_.size() - 1);
      table_[slot] = v;
    }
  }

  MeshData& mesh_;
  std::vector<Index> table_;
  int shift_ = 0;
  // Drawn anew every time, so that nobody can write a file whose vertices all fall on one place of the table. The result
  // does not depend on them.
  std::array<std::uint64_t, 7> multipliers_ = [] {
    std::random_device random;
    std::array<std::uint64_t, 7> drawn{};
    for (auto& number : drawn) number = std::uint64_t{random()} << 32 | random();
    return drawn;
  }();
};

class Triangles {
 public:
  explicit Triangles(const Cursor& file) : file_(file) { mesh_.ambient_dimension = 3; }
  void reserve(std::int64_t count) {
    require_numbers(count);
    reserve_large(ids_, static_cast<std::size_t>(count) * 3);
    weld_.reserve(count);
  }
  void add_corners(std::span<const Position> positions) {
    if (ids_.size() + positions.size() > most_corners) require_numbers(static_cast<std::int64_t>(most_corners));
    weld_.vertices(positions, ids_);
  }
  [[nodiscard]] Index size() const {
    const auto count = static_cast<std::int64_t>(ids_.size() / 3);
    require_numbers(count);
    return static_cast<Index>(count);
  }
  MeshData finish() && {
    const auto corners = ids_.size();
    if (corners > 0) mesh_.simplices = SimplexList(2, std::move(ids_));
    mesh_.notes.push_back(
        text("welded ", corners, " corners of ", corners / 3, " triangles to ", mesh_.vertex_count, " vertices"));
    return std::move(mesh_);
  }

 private:
  // Three corners each, all of which may be vertices.
  void require_numbers(std::int64_t count) const {
    if (count > static_cast<std::int64_t>(most_corners / 3))
      throw LimitError(text(file_.name(), ": ", count,
                            " triangles may have more vertices than this build's index type can number; build with "
                            "DERHAM_INDEX64"));
  }

  static constexpr std::size_t most_corners = std::numeric_limits<Index>::max() - 1;

  const Cursor& file_;
  MeshData mesh_;
  Weld weld_{mesh_};
  std::vector<Index> ids_;
};

MeshData read_binary(Cursor& file) {
  constexpr bool swap = is_foreign_order(true);
  file.name_bytes(true);
  (void)file.bytes(80, "the header");
  const auto count = std::int64_t{load_number<std::uint32_t>(file.bytes(4, "the number of triangles").data(), swap)};
  if (file.remaining() != count * triangle_bytes) {
    file.rewind(80);
    file.fail(text("the number of triangles is ", count, ", which take ", count * triangle_bytes, " bytes, but ",
                   file.remaining() - 4, " follow"));
  }
  Triangles triangles(file);
  triangles.reserve(count);
  std::array<Position, Weld::most_at_once> corners{};
  std::size_t known = 0;
  const char* triangle = file.bytes(count * triangle_bytes, "the triangles").data();
  for (std::int64_t i = 0; i < count; ++i, triangle += triangle_bytes) {
    const char* at = triangle + 12;  // behind the normal
    for (int corner = 0; corner < 3; ++corner, at += 12) {
      const Position position{load_number<float>(at, swap), load_number<float>(at + 4, swap),
                              load_number<float>(at + 8, swap)};
      if (!std::isfinite(position[0]) || !std::isfinite(position[1]) || !std::isfinite(position[2])) {
        file.rewind(header_bytes + i * triangle_bytes + 12 + 12 * corner);
        file.fail(text("a corner of triangle ", i, " is at (", position[0], ", ", position[1], ", ", position[2],
                       "); expected finite coordinates"));
      }
      corners[known++] = position;
    }
    if (known < corners.size() && i + 1 < count) continue;
    triangles.add_corners(std::span(corners).first(known));
    known = 0;
  }
  return std::move(triangles).finish();
}

// The next word, in any letter case.
bool is_next(Cursor& file, std::string_view keyword) {
  if (!file.next_line()) return false;
  const auto here = file.offset();
  const auto word = file.word("a keyword");
  const bool same = std::ranges::equal(
      word, keyword, [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; });
  if (!same) file.rewind(here);
  return same;
}
void demand(Cursor& file, const char* keyword) {
  if (!is_next(file, keyword)) file.fail_token(keyword, nullptr);
}

// Everything up to the end of the line but the blanks around it.
std::string rest_of_line(Cursor& file) {
  (void)file.at_line_end();
  const auto begin = file.offset();
  file.skip_line();
  const auto end = file.offset();
  file.rewind(begin);
  auto rest = file.bytes(end - begin, "a name");
  while (!rest.empty() && (rest.back() == ' ' || (rest.back() >= '\t' && rest.back() <= '\r'))) rest.remove_suffix(1);
  return std::string(rest);
}

void read_facet(Cursor& file, Triangles& triangles) {
  demand(file, "normal");
  for (int axis = 0; axis < 3; ++axis) (void)file.real("a coordinate of the normal");
  file.end_line();
  demand(file, "outer");
  demand(file, "loop");
  file.end_line();
  std::array<Position, 3> corners{};
  for (auto& position : corners) {
    demand(file, "vertex");
    for (double& x : position) x = file.real("a coordinate");
    file.end_line();
  }
  triangles.add_corners(corners);
  demand(file, "endloop");
  file.end_line();
  demand(file, "endfacet");
  file.end_line();
}

MeshData read_ascii(Cursor& file) {
  Triangles triangles(file);
  std::vector<std::pair<std::string, Index>> solids;  // and the row behind the last
  demand(file, "solid");
  do {
    auto name = rest_of_line(file);
    while (is_next(file, "facet")) read_facet(file, triangles);
    if (!is_next(file, "endsolid")) file.fail_token("facet or endsolid", nullptr);
    file.skip_line();
    solids.emplace_back(std::move(name), triangles.size());
  } while (is_next(file, "solid"));
  if (file.next_line()) file.fail_token("solid or the end of the file", nullptr);

  auto mesh = std::move(triangles).finish();
  Index row = 0;
  for (std::size_t i = 0; solids.size() > 1 && i < solids.size(); ++i) {
    MeshPart part{std::move(solids[i].first), static_cast<std::int64_t>(i) + 1, 2, {}};
    while (row < solids[i].second) part.members.push_back(row++);
    mesh.parts.push_back(std::move(part));
  }
  return mesh;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) noexcept {
  if (bytes.size() < static_cast<std::size_t>(header_bytes)) return false;
  const auto count = std::uint64_t{load_number<std::uint32_t>(bytes.data() + 80, is_foreign_order(true))};
  return bytes.size() == static_cast<std::size_t>(header_bytes) + count * static_cast<std::size_t>(triangle_bytes);
}

MeshData read_stl(Cursor& file, const ReadOptions&) {
  // Binary files may begin with "solid", too: they are known by their length, damaged ones by a zero byte.
  file.rewind(0);
  const auto all = file.bytes(file.remaining(), "the file");
  file.rewind(0);
  if (is_binary_stl(all) || all.substr(0, static_cast<std::size_t>(header_bytes)).find('\0') != std::string_view::npos)
    return read_binary(file);
  Cursor lines(all, file.name(), Cursor::no_comment);  // past a byte order mark
  return read_ascii(lines);
}

}  // namespace derham
