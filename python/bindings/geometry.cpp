#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/complex/renumbering.hpp"
#include "derham/geometry/quality.hpp"
#include "derham/geometry/renumber_mesh.hpp"
#include "derham/geometry/top_volumes.hpp"
#include "derham/geometry/volumes.hpp"

#include <nanobind/stl/tuple.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace derham::python {
namespace {

const char* source_of(const AnyComplex& any) {
  return any.visit([]<int n>(const Body<n>& body) -> const char* {
    if constexpr (n <= max_metric_dimension) {
      if (body.geometry) {
        constexpr const char* names[] = {"points", "corners", "edge_lengths_squared"};
        return names[static_cast<int>(body.geometry->source())];
      }
    }
    return nullptr;
  });
}

int ambient_dimension(const AnyComplex& any) {
  return any.visit([&any]<int n>(const Body<n>& body) {
    if constexpr (n <= max_metric_dimension)
      if (body.geometry) return body.geometry->ambient_dimension();
    return any.rest().ambient_dimension;
  });
}

/// (|V|, m), or None where there are none.
nb::object points_of(const AnyComplex& any) {
  const auto m = static_cast<std::size_t>(ambient_dimension(any));
  return any.visit([&]<int n>(const Body<n>& body) -> nb::object {
    const auto vertices = static_cast<std::size_t>(body.complex->size(0));
    if constexpr (n <= max_metric_dimension) {
      if (body.geometry) {
        if (body.geometry->source() != MetricSource::points) return nb::none();
        return nb::cast(view(body.geometry->points(), {vertices, m}, body.geometry));
      }
    }
    if (!any.rest().has_points()) return nb::none();
    return nb::cast(owned(std::vector<double>(any.rest().points), {vertices, m}));
  });
}

/// (|K_n|, n+1, coordinates) in the order of the representatives.
auto corners_of(const AnyComplex& any) {
  return any.with_metric([]<int n>(const Body<n>& body) {
    const auto d = static_cast<std::size_t>(body.geometry->coordinate_dimension());
    const auto rows = static_cast<std::size_t>(body.complex->size(n));
    std::vector<double> values;
    without_gil([&] {
      values.reserve(rows * (n + 1) * d);
      for (Index t = 0; t < body.complex->size(n); ++t)
        for (const double* corner : body.geometry->corners(*body.complex, t))
          values.insert(values.end(), corner, corner + d);
    });
    return owned(std::move(values), {rows, n + 1, d});
  });
}

/// The library measures the degrees between 0 and n all at once.
template <int n>
std::vector<double> volumes_of(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k) {
  if (k == 0) return std::vector<double>(static_cast<std::size_t>(K.size(0)), 1.0);
  if (0 < k && k < n) return std::move(primal_volumes(K, geometry)[static_cast<std::size_t>(k)]);
  std::vector<double> volumes = top_volumes(K, geometry).volume;
  for (double& volume : volumes) volume = std::abs(volume);
  return volumes;
}

auto volumes(const AnyComplex& any, int k) {
  return any.with_metric([k](const auto& body) {
    return owned(without_gil([&] { return volumes_of(*body.complex, *body.geometry, k); }));
  });
}

auto lengths_squared(const AnyComplex& any) {
  return any.with_metric<1>([](const auto& body) {
    return owned(without_gil([&] { return squared_lengths(*body.complex, *body.geometry); }));
  });
}

auto quality_of(const AnyComplex& any) {
  return any.with_metric([](const auto& body) {
    QualityReport report = without_gil([&] { return quality(*body.complex, *body.geometry); });
    return std::tuple(owned(std::move(report.degenerate)), owned(std::move(report.inverted)), report.smallest_volume,
                      report.largest_volume, report.total_volume);
  });
}

/// The complex with other numbers, the new number of every vertex, the old row at every place.
auto renumbered(const AnyComplex& any, bool along_hilbert_curve) {
  Renumbering numbers;
  AnyComplex result = without_gil([&] {
    MeshData mesh = any.mesh();
    numbers = along_hilbert_curve ? hilbert_order(mesh) : reverse_cuthill_mckee(mesh.simplices, mesh.vertex_count);
    renumber(mesh, numbers);
    return AnyComplex(std::move(mesh));
  });
  return std::tuple(std::move(result), owned(std::move(numbers.new_vertex)), owned(std::move(numbers.old_row)));
}

}  // namespace

void bind_geometry(ComplexClass& complex) {
  complex.def("metric_source", &source_of);
  complex.def_prop_ro("ambient_dimension", &ambient_dimension);
  complex.def("points", &points_of);
  complex.def("corners", &corners_of);
  complex.def("volumes", &volumes, nb::arg("k"));
  complex.def("edge_lengths_squared", &lengths_squared);
  complex.def("quality", &quality_of);
  complex.def("renumbered", &renumbered, nb::arg("along_hilbert_curve"));
}

}  // namespace derham::python
