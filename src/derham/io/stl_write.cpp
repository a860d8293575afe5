#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/byte_order.hpp"
#include "derham/io/formats.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace derham {
namespace {

using Vector = std::array<double, 3>;

Vector position(const MeshData& mesh, Index v) {
  Vector out{};
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  for (std::size_t axis = 0; axis < m; ++axis) out[axis] = mesh.points[static_cast<std::size_t>(v) * m + axis];
  return out;
}

// Of length 1, or 0 where the triangle has no normal.
Vector normal(const std::array<Vector, 3>& corners) {
  Vector a, b;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    a[axis] = corners[1][axis] - corners[0][axis];
    b[axis] = corners[2][axis] - corners[0][axis];
  }
  Vector n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  const bool exists = length > 0 && std::isfinite(length);
  for (double& x : n) x = exists ? x / length : 0.0;
  return n;
}

void write_ascii(TextWriter& file, const MeshData& mesh) {
  const auto put = [&](const char* before, const Vector& vector) {
    file.put(before);
    for (const double x : vector) file.put(' ').put(x);
    file.put('\n');
  };
  file.put("solid derham\n");
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    const auto row = mesh.simplices[i];
    const std::array corners{position(mesh, row[0]), position(mesh, row[1]), position(mesh, row[2])};
    put("facet normal", normal(corners));
    file.put("outer loop\n");
    for (const auto& corner : corners) put("vertex", corner);
    file.put("endloop\nendfacet\n");
  }
  file.put("endsolid derham\n");
}

void write_binary(TextWriter& file, const MeshData& mesh) {
  constexpr bool swap = is_foreign_order(true);
  if (mesh.simplices.size() > Offset{std::numeric_limits<std::uint32_t>::max()})
    throw InputError(text("format stl counts triangles by 32 bits, this mesh has ", mesh.simplices.size()));
  for (const double x : mesh.points)
    if (!std::isfinite(static_cast<float>(x)))
      throw InputError(text("a coordinate is ", x, ", but binary stl holds numbers up to ",
                            std::numeric_limits<float>::max(), "; scale the mesh, or write ascii stl"));
  std::string header = "derham binary STL";  // must not begin with "solid"
  header.resize(80, ' ');
  file.put(header).put_bytes(static_cast<std::uint32_t>(mesh.simplices.size()), swap);
  for (Offset i = 0; i < mesh.simplices.size(); ++i) {
    const auto row = mesh.simplices[i];
    const std::array corners{position(mesh, row[0]), position(mesh, row[1]), position(mesh, row[2])};
    for (const double x : normal(corners)) file.put_bytes(static_cast<float>(x), swap);
    for (const auto& corner : corners)
      for (const double x : corner) file.put_bytes(static_cast<float>(x), swap);
    file.put_bytes(std::uint16_t{0}, swap);
  }
}

std::vector<Index> used_vertices(const MeshData& mesh) {
  const auto ids = mesh.simplices.vertices();
  std::vector<Index> used(ids.begin(), ids.end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

// Whether the format has room for the positions of these vertices, and the mesh has them.
bool have_positions(const MeshData& mesh, const std::vector<Index>& vertices) {
  const int m = mesh.ambient_dimension;
  return m >= 1 && m <= 3 && !vertices.empty() && vertices.front() >= 0 &&
         (Offset{vertices.back()} + 1) * m <= std::ssize(mesh.points);
}

// How many places these vertices have in a file of such numbers: as the reader compares them, 0 being -0. Word has the
// size of Number.
template <class Number, class Word>
Offset places(const MeshData& mesh, const std::vector<Index>& vertices) {
  std::vector<std::array<Word, 3>> all;
  all.reserve(vertices.size());
  for (const Index v : vertices)
    std::ranges::transform(position(mesh, v), all.emplace_back().begin(),
                           [](double x) { return std::bit_cast<Word>(static_cast<Number>(x) + Number{0}); });
  std::ranges::sort(all);
  return std::unique(all.begin(), all.end()) - all.begin();
}

}  // namespace

std::vector<std::string> lost_in_stl(const MeshData& mesh, const WriteOptions& options) {
  std::vector<std::string> lost;
  const bool is_binary = options.encoding != WriteOptions::Encoding::ascii;
  const auto rounded =
      std::ranges::count_if(mesh.points, [](double x) { return static_cast<double>(static_cast<float>(x)) != x; });
  if (rounded > 0 && is_binary)
    lost.push_back(text("holds positions as 32-bit numbers: ", rounded, " coordinates are rounded"));
  const auto used = used_vertices(mesh);
  if (const auto unused = Offset{mesh.vertex_count} - std::ssize(used); unused > 0)
    lost.push_back(text("does not hold vertices that no triangle uses (", unused, ")"));
  if (have_positions(mesh, used)) {
    const auto distinct =
        is_binary ? places<float, std::uint32_t>(mesh, used) : places<double, std::uint64_t>(mesh, used);
    if (const auto welded = std::ssize(used) - distinct; welded > 0)
      lost.push_back(text("makes one vertex of those at the same place: ", welded, " fewer"));
  }
  lost.emplace_back("does not hold the order of vertices");
  return lost;
}

void write_stl(TextWriter& file, const MeshData& mesh, const WriteOptions& options) {
  if (options.encoding == WriteOptions::Encoding::ascii)
    write_ascii(file, mesh);
  else
    write_binary(file, mesh);
}

}  // namespace derham
