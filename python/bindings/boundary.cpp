#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/boundary/boundary_complex.hpp"
#include "derham/boundary/manifold.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/geometry/volumes.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>

namespace derham::python {
namespace {

void coboundary(const AnyComplex& any, int k, const Values& x, const Output& y) {
  without_gil(
      [&] { any.with_complex([&](const auto& K) { apply_coboundary(K, k, span_of(x), span_of(y), columns_of(x)); }); });
}

void boundary(const AnyComplex& any, int k, const Values& x, const Output& y) {
  without_gil(
      [&] { any.with_complex([&](const auto& K) { apply_boundary(K, k, span_of(x), span_of(y), columns_of(x)); }); });
}

/// verdict, pure, closed, orientable, defects (kind, simplex, detail).
auto check(const AnyComplex& any) {
  const ManifoldReport report =
      without_gil([&] { return any.with_complex([](const auto& K) { return check_manifold(K); }); });
  std::vector<std::tuple<std::string, std::vector<Index>, std::string>> defects;
  for (const ManifoldDefect& defect : report.defects)
    defects.emplace_back(name(defect.kind), defect.simplex, defect.detail);
  return std::tuple(std::string(name(report.verdict)), report.pure, report.closed, report.orientable, defects);
}

/// The metric of the boundary: positions where K has them, else the lengths of its edges.
template <int n>
std::shared_ptr<const Geometry<n - 1>> geometry_of_boundary(const Body<n>& body, const BoundaryComplex<n>& boundary) {
  if (!body.geometry || boundary.complex.size(n - 1) == 0) return nullptr;
  const Geometry<n>& geometry = *body.geometry;
  if (geometry.source() == MetricSource::points) {
    const int m = geometry.ambient_dimension();
    std::vector<double> points;
    for (const Index v : boundary.inclusion[0])
      for (int c = 0; c < m; ++c) points.push_back(geometry.points()[static_cast<std::size_t>(v) * m + c]);
    return std::make_shared<const Geometry<n - 1>>(
        Geometry<n - 1>::from_points(boundary.complex, std::move(points), m));
  }
  if constexpr (n == 1) {
    return nullptr;
  } else {
    const auto squares = squared_lengths(*body.complex, geometry);
    std::vector<double> own;
    for (const Index e : boundary.inclusion[1]) own.push_back(squares[static_cast<std::size_t>(e)]);
    return std::make_shared<const Geometry<n - 1>>(Geometry<n - 1>::from_squared_lengths(boundary.complex, own));
  }
}

/// The boundary complex and its inclusion by degree.
auto boundary_of(const AnyComplex& any) {
  return any.visit<1>([]<int n>(const Body<n>& body) {
    auto boundary = boundary_complex(*body.complex);
    Body<n - 1> found{nullptr, {}};
    if constexpr (n <= max_metric_dimension) found.geometry = geometry_of_boundary(body, boundary);
    found.complex = std::make_shared<const SimplicialComplex<n - 1>>(std::move(boundary.complex));
    std::vector<Array<Index>> inclusion;
    for (auto& map : boundary.inclusion) inclusion.push_back(owned(std::move(map)));
    return std::pair(AnyComplex(std::move(found)), inclusion);
  });
}

}  // namespace

void bind_boundary(ComplexClass& complex) {
  using nb::arg;
  complex.def("apply_coboundary", &coboundary, arg("k"), arg("x").noconvert(), arg("y").noconvert());
  complex.def("apply_boundary", &boundary, arg("k"), arg("x").noconvert(), arg("y").noconvert());
  complex.def("check", &check);
  complex.def("boundary_complex", &boundary_of);
}

}  // namespace derham::python
