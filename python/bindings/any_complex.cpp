#include "any_complex.hpp"

#include "derham/geometry/volumes.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace derham::python {
namespace {

bool has_metric(const MeshData& mesh) {
  return mesh.has_points() || mesh.has_corners() || !mesh.edge_lengths_squared.empty();
}

/// Takes the points out of the mesh.
template <int n>
Geometry<n> geometry_of(const SimplicialComplex<n>& K, MeshData& mesh) {
  if (mesh.has_corners()) return Geometry<n>::from_mesh(K, mesh);
  if (mesh.has_points()) return Geometry<n>::from_points(K, std::exchange(mesh.points, {}), mesh.ambient_dimension);
  return Geometry<n>::from_squared_lengths(K, mesh.edge_lengths_squared);
}

/// Gives the body the metric of the mesh, if both admit one.
template <int n>
void measure(Body<n>& body, MeshData& mesh) {
  if constexpr (n <= max_metric_dimension)
    if (has_metric(mesh) && body.complex->is_pure())
      body.geometry = std::make_shared<const Geometry<n>>(geometry_of(*body.complex, mesh));
}

template <int n>
void orient_as(SimplicialComplex<n>& K, std::span<const Sign> signs) {
  if (!signs.empty()) K.orient_by(std::vector<double>(signs.begin(), signs.end()));
}

template <int n>
Body<n> body_of(MeshData& mesh, std::span<const Sign> signs) {
  const bool empty = mesh.simplices.empty() && mesh.vertex_count <= 0;
  const auto K = empty ? std::make_shared<SimplicialComplex<n>>()
                       : std::make_shared<SimplicialComplex<n>>(mesh.simplices, mesh.vertex_count);
  Body<n> body{K, {}};
  measure(body, mesh);
  if constexpr (n <= max_metric_dimension)
    if (body.geometry) orient_by_volume(*K, *body.geometry);
  orient_as(*K, signs);
  return body;
}

/// Rows of width n+1, the last two entries of `items` each exchanged where the top simplex is negative.
template <int n, class T>
void exchange_last(const SimplicialComplex<n>& K, std::vector<T>& values, std::size_t items) {
  if constexpr (n >= 1) {
    for (Index t = 0; t < K.size(n); ++t) {
      if (K.sign(n, t) > 0) continue;
      const auto end =
          values.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(t) + 1) * (n + 1) * items);
      const auto size = static_cast<std::ptrdiff_t>(items);
      std::swap_ranges(end - 2 * size, end - size, end - size);
    }
  }
}

template <int n>
SimplexList oriented_rows(const SimplicialComplex<n>& K) {
  const auto tuples = K.simplices(n);
  std::vector<Index> vertices(tuples.begin(), tuples.end());
  exchange_last(K, vertices, 1);
  return SimplexList(n, std::move(vertices));
}

/// The metric as a mesh has it, also where the complex was not made from one.
template <int n>
void restore_metric(const Body<n>& body, MeshData& mesh) {
  if constexpr (n <= max_metric_dimension) {
    if (!body.geometry) return;
    mesh.ambient_dimension = body.geometry->ambient_dimension();
    if (body.geometry->source() == MetricSource::lengths) {
      if constexpr (n >= 1)
        if (mesh.edge_lengths_squared.empty())
          mesh.edge_lengths_squared = squared_lengths(*body.complex, *body.geometry);
      return;
    }
    const auto coordinates = body.geometry->coordinates();
    auto& values = body.geometry->source() == MetricSource::points ? mesh.points : mesh.corners;
    values.assign(coordinates.begin(), coordinates.end());
    if (&values == &mesh.corners)
      exchange_last(*body.complex, values, static_cast<std::size_t>(body.geometry->ambient_dimension()));
  }
}

}  // namespace

AnyComplex::AnyComplex(MeshData mesh, std::span<const Sign> signs)
    : body_(with_constant<0, max_dimension>(std::max(0, mesh.simplices.dimension()), "the dimension of the simplices",
                                            [&](auto n) { return Bodies(body_of<n()>(mesh, signs)); })),
      rest_(std::move(mesh)) {
  drop_what_the_body_holds();
}

AnyComplex::AnyComplex(Bodies complex, MeshData mesh) : body_(std::move(complex)), rest_(std::move(mesh)) {
  std::visit([this](auto& body) { measure(body, rest_); }, body_);
  drop_what_the_body_holds();
}

void AnyComplex::drop_what_the_body_holds() {
  visit([this](const auto& body) {
    if (body.complex->is_pure()) rest_.simplices = SimplexList();
    if (!body.complex->is_pure() || body.complex->dimension > max_metric_dimension) return;
    rest_.points = {};
    rest_.corners = {};
  });
}

MeshData AnyComplex::mesh() const {
  MeshData mesh = rest_;
  visit([&mesh](const auto& body) {
    mesh.vertex_count = body.complex->size(0);
    if (body.complex->is_pure() && mesh.vertex_count > 0) mesh.simplices = oriented_rows(*body.complex);
    restore_metric(body, mesh);
  });
  return mesh;
}

void AnyComplex::refuse_metric(bool pure) {
  if (!pure)
    throw TopologyError("a metric needs a pure complex: some maximal simplices are of lower dimension than others");
  throw GeometryError("the complex has no metric; give points, corners or edge_lengths_squared when it is made");
}

}  // namespace derham::python
