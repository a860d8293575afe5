#include "derham/meshes/boxes.hpp"

#include "derham/meshes/counts.hpp"
#include "derham/meshes/kuhn.hpp"
#include "derham/meshes/soundness.hpp"

#include <random>

namespace derham::meshes {
namespace {

using detail::GridIndex;
using detail::KuhnCutter;

/// Positions of the grid planes, per axis; ends are exact.
std::vector<std::vector<double>> grid_planes(const std::vector<Index>& cells, const BoxOptions& options) {
  std::vector<std::vector<double>> planes;
  for (std::size_t axis = 0; axis < cells.size(); ++axis) {
    const double length = options.lengths.empty() ? 1.0 : options.lengths[axis];
    auto& plane = planes.emplace_back(static_cast<std::size_t>(cells[axis]) + 1, length);
    for (Index i = 0; i < cells[axis]; ++i)
      plane[static_cast<std::size_t>(i)] = length * static_cast<double>(i) / static_cast<double>(cells[axis]);
  }
  return planes;
}

/// Uniform in [-1/2, 1/2), the same on every machine (std::uniform_real_distribution is not).
double centred_uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; }

void check(const std::vector<Index>& cells, const BoxOptions& options, Index least) {
  const auto n = cells.size();
  detail::require_dimension(static_cast<int>(std::min<std::size_t>(n, 1000)), 1, max_dimension);
  for (const Index count : cells) detail::require_at_least("the number of cells along an axis", count, least);
  if (!options.lengths.empty() && options.lengths.size() != n)
    throw InputError(text(options.lengths.size(), " lengths are given for ", n, " axes; give one per axis or none"));
  for (const double length : options.lengths) detail::require_positive("the length of a side", length);
  if (!(options.jitter >= 0 && options.jitter <= 1))
    throw InputError(
        text("jitter is ", options.jitter, "; it must be 0 to 1, and below 1/", n, " to keep all volumes positive"));
}

/// How many simplices the cubes make; throws LimitError when they or the vertices do not fit.
std::size_t simplex_count(const std::vector<Index>& cells, Offset planes_beyond) {
  std::vector<Offset> factors;
  for (const Index count : cells) factors.push_back(static_cast<Offset>(count) + planes_beyond);
  detail::checked_count("vertices", factors);
  for (Offset& factor : factors) factor -= planes_beyond;
  factors.push_back(factorial(static_cast<int>(cells.size())));
  return static_cast<std::size_t>(detail::checked_count("simplices", factors));
}

std::vector<Index> equal_cells(int n, Index cells) {
  detail::require_dimension(n, 1, max_dimension);
  return std::vector<Index>(static_cast<std::size_t>(n), cells);
}

std::vector<double> box_points(const std::vector<Index>& cells, const BoxOptions& options) {
  const auto planes = grid_planes(cells, options);
  std::vector<Index> counts = cells;
  for (Index& count : counts) ++count;
  std::size_t vertices = 1;
  for (const Index count : counts) vertices *= static_cast<std::size_t>(count);

  std::vector<double> points(vertices * cells.size());
  std::mt19937_64 random(options.seed);
  GridIndex at(counts);
  auto point = points.begin();
  do {
    bool interior = options.jitter > 0;
    for (std::size_t axis = 0; axis < cells.size(); ++axis)
      interior = interior && at[axis] > 0 && at[axis] < cells[axis];
    for (std::size_t axis = 0; axis < cells.size(); ++axis) {
      *point = planes[axis][static_cast<std::size_t>(at[axis])];
      if (interior) *point += options.jitter * planes[axis][1] * centred_uniform(random);
      ++point;
    }
  } while (at.advance());
  return points;
}

}  // namespace

MeshData box(const std::vector<Index>& cells, const BoxOptions& options) {
  check(cells, options, 1);
  const auto n = cells.size();
  const std::size_t rows = simplex_count(cells, 1);

  MeshData mesh;
  mesh.ambient_dimension = static_cast<int>(n);
  mesh.points = box_points(cells, options);
  mesh.vertex_count = static_cast<Index>(mesh.points.size() / n);

  std::array<Index, max_dimension> stride{1};
  for (std::size_t axis = 1; axis < n; ++axis) stride[axis] = stride[axis - 1] * (cells[axis - 1] + 1);
  std::vector<Index> pattern;  // the simplices of the cube at vertex 0: all others are shifts of it
  for (const std::uint8_t corner : detail::kuhn_simplices(static_cast<int>(n))) {
    Index vertex = 0;
    for (std::size_t axis = 0; axis < n; ++axis)
      if (corner >> axis & 1) vertex += stride[axis];
    pattern.push_back(vertex);
  }

  std::vector<Index> vertices(rows * (n + 1));
  Index* out = vertices.data();
  GridIndex cube(cells);
  do {
    Index first = 0;
    for (std::size_t axis = 0; axis < n; ++axis) first += cube[axis] * stride[axis];
    for (const Index vertex : pattern) *out++ = first + vertex;
  } while (cube.advance());
  mesh.simplices = SimplexList(static_cast<int>(n), std::move(vertices));
  return mesh;
}

MeshData box(int n, Index cells, const BoxOptions& options) { return box(equal_cells(n, cells), options); }

MeshData periodic_box(const std::vector<Index>& cells, const BoxOptions& options) {
  check(cells, options, 1);
  for (const Index count : cells)
    if (count < 3)
      throw InputError(text("a periodic box has ", count,
                            " cells along an axis; it must have at least 3, for with fewer ",
                            "different simplices have the same vertices (a 2 x 2 torus collapses)"));
  const auto n = cells.size();
  const std::size_t rows = simplex_count(cells, 0);
  const auto planes = grid_planes(cells, options);

  MeshData mesh;
  mesh.ambient_dimension = static_cast<int>(n);
  mesh.vertex_count = static_cast<Index>(rows / static_cast<std::size_t>(factorial(static_cast<int>(n))));

  std::vector<double> shift;  // (vertex_count, n) the jitter
  if (options.jitter > 0) {
    std::mt19937_64 random(options.seed);
    shift.resize(static_cast<std::size_t>(mesh.vertex_count) * n);
    for (std::size_t i = 0; i < shift.size(); ++i)
      shift[i] = options.jitter * planes[i % n][1] * centred_uniform(random);
  }

  const KuhnCutter cutter(static_cast<int>(n));
  const std::size_t corners = std::size_t{1} << n;
  std::vector<Index> ids(corners);
  std::vector<double> positions(corners * n);
  std::vector<Index> vertices;
  vertices.reserve(rows * (n + 1));
  mesh.corners.reserve(rows * (n + 1) * n);
  GridIndex cube(cells);
  do {
    for (std::size_t corner = 0; corner < corners; ++corner) {
      Index id = 0;
      for (std::size_t axis = n; axis-- > 0;) {
        const Index i = cube[axis] + static_cast<Index>(corner >> axis & 1);
        id = id * cells[axis] + (i == cells[axis] ? 0 : i);
        positions[corner * n + axis] = planes[axis][static_cast<std::size_t>(i)];
      }
      ids[corner] = id;
      if (!shift.empty())
        for (std::size_t axis = 0; axis < n; ++axis)
          positions[corner * n + axis] += shift[static_cast<std::size_t>(id) * n + axis];
    }
    cutter.cut(ids, vertices);
    for (const std::uint8_t corner : cutter.simplices()) {
      const auto position = positions.begin() + static_cast<std::ptrdiff_t>(corner * n);
      mesh.corners.insert(mesh.corners.end(), position, position + static_cast<std::ptrdiff_t>(n));
    }
  } while (cube.advance());
  mesh.simplices = SimplexList(static_cast<int>(n), std::move(vertices));
  return mesh;
}

MeshData periodic_box(int n, Index cells, const BoxOptions& options) {
  return periodic_box(equal_cells(n, cells), options);
}

std::vector<double> squared_edge_lengths(const MeshData& mesh) {
  detail::require_sound(mesh);
  if (!mesh.has_points() && !mesh.has_corners())
    throw InputError("the mesh has no positions, so its edges have no length");
  if (!mesh.simplices.is_uniform())
    throw InputError("the rows have different dimensions; edge lengths need rows of one");
  const auto width = static_cast<std::size_t>(mesh.simplices.dimension() + 1);
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  std::vector<double> lengths;
  lengths.reserve(static_cast<std::size_t>(mesh.simplices.size()) * width * (width - (width > 0)) / 2);
  for (Offset row = 0; row < mesh.simplices.size(); ++row) {
    const auto simplex = mesh.simplices[row];
    const auto position = [&](std::size_t place) {
      return mesh.has_corners() ? mesh.corners.data() + (static_cast<std::size_t>(row) * width + place) * m
                                : mesh.points.data() + static_cast<std::size_t>(simplex[place]) * m;
    };
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t j = i + 1; j < width; ++j) {
        double sum = 0;
        for (std::size_t axis = 0; axis < m; ++axis) {
          const double difference = position(j)[axis] - position(i)[axis];
          sum += difference * difference;
        }
        lengths.push_back(sum);
      }
  }
  return lengths;
}

}  // namespace derham::meshes
