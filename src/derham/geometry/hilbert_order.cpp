// This follows Skilling, "Programming the Hilbert curve", 2004.
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/renumber_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace derham {
namespace {

std::size_t index(Offset i) { return static_cast<std::size_t>(i); }

/// Place on the Hilbert curve through a grid of 2^bits cells along each axis. `cell` is overwritten.
std::uint64_t place_on_curve(std::span<std::uint32_t> cell, int bits) {
  const std::uint32_t top = std::uint32_t{1} << (bits - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    for (std::uint32_t& x : cell) {
      const std::uint32_t exchanged = (x & q) != 0 ? 0 : (cell[0] ^ x) & (q - 1);
      cell[0] ^= (x & q) != 0 ? q - 1 : exchanged;
      x ^= exchanged;
    }
  }
  for (std::size_t i = 1; i < cell.size(); ++i) cell[i] ^= cell[i - 1];
  std::uint32_t flipped = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1)
    if ((cell.back() & q) != 0) flipped ^= q - 1;
  std::uint64_t place = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t x : cell) place = place << 1 | ((x ^ flipped) >> bit & 1);
  return place;
}

/// One position per vertex: the given ones, or those of the first corner of each vertex.
std::vector<double> vertex_positions(const MeshData& mesh) {
  if (mesh.has_points()) return mesh.points;
  const std::size_t m = index(mesh.ambient_dimension);
  const auto ids = mesh.simplices.vertices();
  std::vector<double> points(index(mesh.vertex_count) * m);
  std::vector<char> known(index(mesh.vertex_count), 0);
  for (std::size_t v = 0; v < known.size(); ++v)
    std::copy_n(mesh.corners.begin(), m, points.begin() + static_cast<std::ptrdiff_t>(v * m));
  for (std::size_t c = 0; c < ids.size(); ++c) {
    if (std::exchange(known[index(ids[c])], 1) != 0) continue;
    std::copy_n(mesh.corners.begin() + static_cast<std::ptrdiff_t>(c * m), m,
                points.begin() + static_cast<std::ptrdiff_t>(index(ids[c]) * m));
  }
  return points;
}

/// Lowest coordinates, and the factors that map the longest side of the bounding box to 2^bits - 1 cells.
struct Grid {
  std::vector<double> low;
  double scale = 0;
  int bits = 0;

  Grid(const std::vector<double>& points, std::size_t m) : low(m), bits(std::min(31, static_cast<int>(63 / m))) {
    std::vector<double> high(m);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double &lowest = low[i % m], &highest = high[i % m];
      lowest = i < m ? points[i] : std::min(lowest, points[i]);
      highest = i < m ? points[i] : std::max(highest, points[i]);
    }
    double side = 0;
    for (std::size_t a = 0; a < m; ++a) side = std::max(side, high[a] - low[a]);
    scale = side > 0 ? static_cast<double>((std::uint32_t{1} << bits) - 1) / side : 0;
  }
  [[nodiscard]] std::uint32_t cell(double x, std::size_t axis) const {
    const double scaled = (x - low[axis]) * scale;
    const auto most = (std::uint32_t{1} << bits) - 1;
    return scaled > 0 ? static_cast<std::uint32_t>(std::min(scaled, static_cast<double>(most))) : 0;  // not a number: 0
  }
};

}  // namespace

Renumbering hilbert_order(const MeshData& mesh) {
  if (!mesh.has_points() && !mesh.has_corners())
    throw InputError("an order along a Hilbert curve needs positions; reverse_cuthill_mckee does without");
  if (mesh.ambient_dimension > 31)
    throw InputError(text("a Hilbert curve in dimension ", mesh.ambient_dimension, "; at most 31 is supported"));
  for (const Index v : mesh.simplices.vertices())
    if (v < 0 || v >= mesh.vertex_count)
      throw InputError(text("vertex id ", v, " in a mesh of ", mesh.vertex_count, " vertices"));
  const std::size_t m = index(mesh.ambient_dimension);
  const std::vector<double> points = vertex_positions(mesh);
  const Grid grid(points, m);
  std::vector<std::pair<std::uint64_t, Index>> place(index(mesh.vertex_count));
  parallel_blocks(mesh.vertex_count, 1 << 13, [&](Offset begin, Offset end) {
    std::vector<std::uint32_t> cell(m);
    for (auto v = static_cast<Index>(begin); v < end; ++v) {
      for (std::size_t a = 0; a < m; ++a) cell[a] = grid.cell(points[index(v) * m + a], a);
      place[index(v)] = {place_on_curve(cell, grid.bits), v};
    }
  });
  std::ranges::sort(place);
  std::vector<Index> new_vertex(place.size());
  for (std::size_t i = 0; i < place.size(); ++i) new_vertex[index(place[i].second)] = static_cast<Index>(i);
  return with_rows_in_order(std::move(new_vertex), mesh.simplices);
}

}  // namespace derham
