#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/boundary/manifold.hpp"
#include "derham/boundary/matrix_free.hpp"
#include "derham/operators/boundary_metric.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace derham::python {
namespace {

void coboundary(const AnyComplex& any, int k, const Values& x, const Output& y) {
  without_gil(
      [&] { any.with_complex([&](const auto& K) { apply_coboundary(K, k, span_of(x), span_of(y), columns_of(x)); }); });
}

void boundary_of(const AnyComplex& any, int k, const Values& x, const Output& y) {
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

/// The boundary as a complex with its metric, if K has one.
AnyComplex complex_of(const AnyBoundary& any) {
  return any.visit([]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) {
    Body<n - 1> found{std::shared_ptr<const SimplicialComplex<n - 1>>(of, &of->boundary.complex), {}};
    if constexpr (n <= max_metric_dimension)
      if (of->body.geometry && found.complex->size(0) > 0)
        found.geometry = std::make_shared<const Geometry<n - 1>>(
            boundary_geometry(*of->body.complex, *of->body.geometry, of->boundary));
    return AnyComplex(std::move(found));
  });
}

/// By degree the indices in K.
auto inclusion_of(const AnyBoundary& any) {
  return any.visit([](const auto& of) {
    std::vector<Array<const Index>> inclusion;
    for (const auto& map : of->boundary.inclusion) inclusion.push_back(view(std::span<const Index>(map), of));
    return inclusion;
  });
}

}  // namespace

void bind_boundary(ComplexClass& complex, BoundaryClass& boundary) {
  using nb::arg;
  complex.def("apply_coboundary", &coboundary, arg("k"), arg("x").noconvert(), arg("y").noconvert());
  complex.def("apply_boundary", &boundary_of, arg("k"), arg("x").noconvert(), arg("y").noconvert());
  complex.def("check", &check);
  boundary.def(nb::init<const AnyComplex&>(), arg("complex"), nb::call_guard<Unlocked>());
  boundary.def("complex", &complex_of, nb::call_guard<Unlocked>());
  boundary.def("inclusion", &inclusion_of);
}

}  // namespace derham::python
