#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/boundary/boundary_complex.hpp"
#include "derham/boundary/manifold.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/operators/boundary_metric.hpp"

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

/// The boundary complex and its inclusion by degree.
auto boundary_of(const AnyComplex& any) {
  return any.visit<1>([]<int n>(const Body<n>& body) {
    auto boundary = boundary_complex(*body.complex);
    Body<n - 1> found{nullptr, {}};
    if constexpr (n <= max_metric_dimension)
      if (body.geometry && boundary.complex.size(0) > 0)
        found.geometry =
            std::make_shared<const Geometry<n - 1>>(boundary_geometry(*body.complex, *body.geometry, boundary));
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
