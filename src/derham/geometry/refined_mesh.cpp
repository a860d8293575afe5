#include "derham/geometry/refined_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>

namespace derham {
namespace {

std::size_t index(Offset i) { return static_cast<std::size_t>(i); }

/// `width` values for every fine vertex: the mean of those of its ends.
template <int n>
std::vector<double> at_midpoints(const Refinement<n>& refinement, std::span<const double> values, std::size_t width) {
  const Index vertices = refinement.fine().size(0);
  std::vector<double> result(index(vertices) * width);
  for (Index v = 0; v < vertices; ++v) {
    const auto [low, high] = refinement.ends(v);
    for (std::size_t c = 0; c < width; ++c)
      result[index(v) * width + c] = low == high
                                         ? values[index(low) * width + c]
                                         : (values[index(low) * width + c] + values[index(high) * width + c]) / 2;
  }
  return result;
}

/// The fine top simplices as rows, positively oriented.
template <int n>
std::vector<Index> oriented_tops(const SimplicialComplex<n>& K) {
  std::vector<Index> rows(K.simplices(n).begin(), K.simplices(n).end());
  for (Index t = 0; t < K.size(n); ++t)
    if (K.sign(n, t) < 0) std::swap(rows[index(t) * (n + 1) + n - 1], rows[index(t) * (n + 1) + n]);
  return rows;
}

/// Corners of the pieces of every row, from the corners of the row.
template <int n>
std::vector<double> refined_corners(const MeshData& mesh, const Refinement<n>& refinement,
                                    const SimplexList& fine_rows) {
  const auto m = index(mesh.ambient_dimension);
  std::vector<double> corners;
  corners.reserve(index(fine_rows.size()) * (n + 1) * m);
  for (Offset fine = 0; fine < fine_rows.size(); ++fine) {
    const Offset row = fine >> n;
    const auto tuple = mesh.simplices[row];
    const auto corner = [&](Index v) {
      return &mesh.corners[(index(row) * (n + 1) + index(std::ranges::find(tuple, v) - tuple.begin())) * m];
    };
    for (const Index v : fine_rows[fine]) {
      const auto ends = refinement.ends(v);
      const double *const low = corner(ends[0]), *const high = corner(ends[1]);
      for (std::size_t axis = 0; axis < m; ++axis)
        corners.push_back(low == high ? low[axis] : (low[axis] + high[axis]) / 2);
    }
  }
  return corners;
}

/// The squared length of every fine edge: of Σ δ_i x_i with Σ δ_i = 0 it is -Σ_{i<j} δ_i δ_j |x_i - x_j|².
template <int n>
std::vector<double> refined_lengths(const Refinement<n>& refinement, std::span<const double> squares) {
  const auto& K = refinement.coarse();
  const auto& fine = refinement.fine();
  std::vector<double> result(index(fine.size(1)));
  for (Index e = 0; e < fine.size(1); ++e) {
    const RowTarget carrier = refinement.carrier(1, e);
    const auto vertices = K.simplex(carrier.degree, carrier.index);
    std::array<double, n + 1> weight{};
    for (std::size_t end = 0; end < 2; ++end)
      for (const Index v : refinement.ends(fine.template simplex<1>(e)[end]))
        weight[index(std::ranges::find(vertices, v) - vertices.begin())] += end == 0 ? -0.5 : 0.5;
    for (std::size_t j = 0; j < vertices.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        result[index(e)] -= weight[i] * weight[j] * squares[index(K.find({vertices[i], vertices[j]}).index)];
  }
  return result;
}

/// Every listed simplex cut, in the order of the list.
template <int n>
SimplexList refined_list(const Refinement<n>& refinement, const SimplexList& list) {
  if (list.empty()) return list;
  std::vector<Index> rows;
  for (Offset i = 0; i < list.size(); ++i) refinement.append_pieces(list[i], rows);
  return SimplexList(list.dimension(), std::move(rows));
}

template <int n>
MeshPart refined_part(const Refinement<n>& refinement, const MeshPart& part) {
  MeshPart result{part.name, part.number, part.degree, {}};
  for (const Index member : part.members) {
    if (part.degree == 0 && (member < 0 || member >= refinement.coarse().size(0)))
      throw InputError(text("part ", part.number, " has the vertex ", member, " of ", refinement.coarse().size(0)));
    for (Index piece = 0; piece < 1 << part.degree; ++piece)
      result.members.push_back(part.degree == 0 ? refinement.vertex(member) : (member << part.degree) + piece);
  }
  return result;
}

template <int n>
MeshField refined_field(const Refinement<n>& refinement, const MeshField& field) {
  MeshField result{field.name, field.on, field.components, {}};
  const auto width = index(field.components);
  if (field.on == MeshField::On::vertices) {
    result.values = at_midpoints(refinement, field.values, width);
  } else {
    for (std::size_t row = 0; row * width < field.values.size(); ++row)
      for (int piece = 0; piece < 1 << n; ++piece)
        result.values.insert(result.values.end(), field.values.begin() + static_cast<std::ptrdiff_t>(row * width),
                             field.values.begin() + static_cast<std::ptrdiff_t>((row + 1) * width));
  }
  return result;
}

template <int n>
MeshData refined_alone(const MeshData& mesh) {
  const SimplicialComplex<n> K(mesh.simplices, mesh.vertex_count);
  return refined_mesh(mesh, Refinement<n>(K));
}

}  // namespace

template <int n>
MeshData refined_mesh(const MeshData& mesh, const Refinement<n>& refinement) {
  const auto& K = refinement.coarse();
  if (!K.is_pure() || mesh.simplices.size() != K.size(n) || mesh.vertex_count != K.size(0) ||
      mesh.simplices.dimension() != n || !mesh.simplices.is_uniform())
    throw InputError(text("a refinement of ", K.size(n), " simplices of dimension ", n, " with ", K.size(0),
                          " vertices for a mesh of ", mesh.simplices.size(), " rows with ", mesh.vertex_count));
  MeshData result;
  result.simplices = SimplexList(n, oriented_tops(refinement.fine()));
  result.vertex_count = refinement.fine().size(0);
  result.ambient_dimension = mesh.ambient_dimension;
  if (mesh.has_points()) result.points = at_midpoints(refinement, mesh.points, index(mesh.ambient_dimension));
  if (mesh.has_corners()) result.corners = refined_corners(mesh, refinement, result.simplices);
  if (!mesh.edge_lengths_squared.empty())
    result.edge_lengths_squared = refined_lengths(refinement, mesh.edge_lengths_squared);
  for (const SimplexList& list : mesh.lower) result.lower.push_back(refined_list(refinement, list));
  for (const MeshPart& part : mesh.parts) result.parts.push_back(refined_part(refinement, part));
  for (const MeshField& field : mesh.fields) result.fields.push_back(refined_field(refinement, field));
  if (!mesh.forms.empty())
    result.notes.push_back(text(mesh.forms.size(), " forms are not refined; `prolongation` brings them along"));
  return result;
}

MeshData refined_mesh(const MeshData& mesh) {
  switch (mesh.simplices.dimension()) {
    case 1:
      return refined_alone<1>(mesh);
    case 2:
      return refined_alone<2>(mesh);
    case 3:
      return refined_alone<3>(mesh);
    case 4:
      return refined_alone<4>(mesh);
    default:
      throw InputError(text("a mesh of dimension ", mesh.simplices.dimension(), "; 1 to 4 can be refined"));
  }
}

template MeshData refined_mesh(const MeshData&, const Refinement<1>&);
template MeshData refined_mesh(const MeshData&, const Refinement<2>&);
template MeshData refined_mesh(const MeshData&, const Refinement<3>&);
template MeshData refined_mesh(const MeshData&, const Refinement<4>&);

}  // namespace derham
