#include "derham/meshes/voxels.hpp"

#include "derham/meshes/counts.hpp"
#include "derham/meshes/kuhn.hpp"

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace derham::meshes {
namespace {

Offset voxel_count(const std::vector<Index>& shape) {
  detail::require_dimension(static_cast<int>(std::min<std::size_t>(shape.size(), 1000)), 1, max_dimension);
  std::vector<Offset> corners;
  for (const Index count : shape) {
    detail::require_at_least("the number of voxels along an axis", count, 1);
    corners.push_back(Offset{count} + 1);
  }
  detail::checked_count("voxel corners", corners);
  Offset voxels = 1;
  for (const Index count : shape) voxels *= count;
  constexpr Offset most = std::numeric_limits<std::int32_t>::max();  // of the bytes of the mask
  if (voxels > most) throw LimitError(text("a set of ", voxels, " voxels; at most ", most, " are supported"));
  return voxels;
}

/// Reads the spec from left to right.
class SpecReader {
 public:
  explicit SpecReader(std::string_view spec) : spec_(spec) {}

  [[nodiscard]] bool at_end() const noexcept { return place_ == spec_.size(); }

  /// Whether the next character is `c`, which is then passed.
  bool take(char c) noexcept {
    if (at_end() || spec_[place_] != c) return false;
    ++place_;
    return true;
  }

  Index number() {
    std::int32_t value = 0;  // of any build: a mask of more is out of proportion to its text
    const auto [end, error] = std::from_chars(spec_.data() + place_, spec_.data() + spec_.size(), value);
    if (error != std::errc() || value < 0) fail("a number is expected");
    place_ = static_cast<std::size_t>(end - spec_.data());
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(text("voxels \"", spec_.substr(0, 200), "\", character ", place_ + 1, ": ", what,
                          "; write for example 3x3x1-1,1,0 or 5x5x3-1:3,1:3,1+2,2,1"));
  }

 private:
  std::string_view spec_;
  std::size_t place_ = 0;
};

void set_cells(SpecReader& reader, VoxelSet& set, std::uint8_t value) {
  std::vector<Index> low, counts;
  for (std::size_t axis = 0; axis < set.shape.size(); ++axis) {
    if (axis > 0 && !reader.take(','))
      reader.fail(text("\",\" is expected: one range for each of the ", set.shape.size(), " axes"));
    low.push_back(reader.number());
    const Index high = reader.take(':') ? reader.number() : low.back();
    if (high < low.back() || high >= set.shape[axis])
      reader.fail(text("the range ", low.back(), ":", high, " is not inside 0:", set.shape[axis] - 1));
    counts.push_back(high - low.back() + 1);
  }
  detail::GridIndex at(counts);
  do {
    std::size_t place = 0;
    for (std::size_t axis = counts.size(); axis-- > 0;)
      place = place * static_cast<std::size_t>(set.shape[axis]) + static_cast<std::size_t>(low[axis] + at[axis]);
    set.filled[place] = value;
  } while (at.advance());
}

}  // namespace

VoxelSet parse_voxels(std::string_view spec) {
  SpecReader reader(spec);
  VoxelSet set;
  do {
    if (set.shape.size() == max_dimension) reader.fail(text("there are more than ", max_dimension, " axes"));
    set.shape.push_back(reader.number());
    if (set.shape.back() < 1) reader.fail("an axis has at least 1 cube");
  } while (reader.take('x'));
  set.filled.assign(static_cast<std::size_t>(voxel_count(set.shape)), 1);
  while (!reader.at_end()) {
    const bool away = reader.take('-');
    if (!away && !reader.take('+')) reader.fail("\"-\" (take cubes away) or \"+\" (put them back) is expected");
    set_cells(reader, set, away ? 0 : 1);
  }
  return set;
}

MeshData voxels(const VoxelSet& set) {
  const Offset size = voxel_count(set.shape);
  if (static_cast<Offset>(set.filled.size()) != size)
    throw InputError(text("filled has ", set.filled.size(), " entries; the shape has ", size, " voxels"));
  const std::size_t n = set.shape.size(), corners = std::size_t{1} << n;
  const auto full = static_cast<Offset>(set.filled.size()) - std::ranges::count(set.filled, 0);
  if (full == 0) throw InputError("no voxel is filled; fill at least one");
  const Offset rows = detail::checked_count("simplices", {full, factorial(static_cast<int>(n))});

  std::vector<Index> points_along = set.shape;
  for (Index& count : points_along) ++count;
  std::vector<std::size_t> corner_offset(corners);
  std::size_t points = 1;
  for (std::size_t axis = 0; axis < n; ++axis) {
    for (std::size_t corner = 0; corner < corners; ++corner)
      if (corner >> axis & 1) corner_offset[corner] += points;
    points *= static_cast<std::size_t>(points_along[axis]);
  }
  const auto for_each_voxel = [&](auto&& body) {  // body(place of the voxel's lowest corner)
    detail::GridIndex at(set.shape);
    for (const std::uint8_t filled : set.filled) {
      std::size_t place = 0;
      for (std::size_t axis = n; axis-- > 0;)
        place = place * static_cast<std::size_t>(points_along[axis]) + static_cast<std::size_t>(at[axis]);
      if (filled) body(place);
      at.advance();
    }
  };

  std::vector<Index> ids(points, -1);  // first 0 marks a used corner, then its number
  for_each_voxel([&](std::size_t place) {
    for (const std::size_t offset : corner_offset) ids[place + offset] = 0;
  });
  MeshData mesh;
  mesh.ambient_dimension = static_cast<int>(n);
  detail::GridIndex at(points_along);
  for (Index& id : ids) {
    if (id == 0) {
      id = mesh.vertex_count++;
      for (std::size_t axis = 0; axis < n; ++axis) mesh.points.push_back(static_cast<double>(at[axis]));
    }
    at.advance();
  }

  const detail::KuhnCutter cutter(static_cast<int>(n));
  std::vector<Index> corner_ids(corners), vertices;
  vertices.reserve(static_cast<std::size_t>(rows) * (n + 1));
  for_each_voxel([&](std::size_t place) {
    for (std::size_t corner = 0; corner < corners; ++corner) corner_ids[corner] = ids[place + corner_offset[corner]];
    cutter.cut(corner_ids, vertices);
  });
  mesh.simplices = SimplexList(static_cast<int>(n), std::move(vertices));
  return mesh;
}

}  // namespace derham::meshes
