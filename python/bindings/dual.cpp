#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/dual/dual_cell.hpp"
#include "derham/dual/dual_report.hpp"

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>

namespace derham::python {
namespace {

auto volumes(const AnyComplex& any, int k) {
  return any.with_metric([k](const auto& body) {
    auto all = without_gil([&] { return dual_volumes(*body.complex, *body.geometry); });
    return owned(std::move(all[static_cast<std::size_t>(k)]));
  });
}

/// By degree (min, zero, negative, undefined); pairwise Delaunay, one-sided, well-centred; degenerate.
auto report(const AnyComplex& any) {
  return any.with_metric([](const auto& body) {
    DualReport found = without_gil([&] { return dual_report(*body.complex, *body.geometry); });
    std::vector<std::tuple<double, Array<Index>, Array<Index>, Index>> stars;
    for (StarVerdict& star : found.star)
      stars.emplace_back(star.min, owned(std::move(star.zero)), owned(std::move(star.negative)), star.undefined);
    return std::tuple(stars, found.pairwise_delaunay, found.one_sided, found.well_centered,
                      owned(std::move(found.degenerate)));
  });
}

/// The dual cells of some k-simplices: (points, polylines, polygons) of each.
auto cells(const AnyComplex& any, int k, const Indices& simplices) {
  return any.with_metric([&]<int n>(const Body<n>& body) {
    std::vector<DualCell> cells;
    without_gil([&] {
      const DualCells<n> all(*body.complex, *body.geometry, k);
      for (const Index i : span_of(simplices)) cells.push_back(all.cell(i));
    });
    const auto d = static_cast<std::size_t>(body.geometry->coordinate_dimension());
    using Loops = std::vector<std::vector<Index>>;
    std::vector<std::tuple<Array<double>, Loops, Loops>> result;
    for (DualCell& cell : cells) {
      const std::size_t count = cell.points.size() / d;
      result.emplace_back(owned(std::move(cell.points), {count, d}), cell.polylines, cell.polygons);
    }
    return result;
  });
}

}  // namespace

void bind_dual(ComplexClass& complex) {
  complex.def("dual_volumes", &volumes, nb::arg("k"));
  complex.def("dual_report", &report);
  complex.def("dual_cells", &cells, nb::arg("k"), nb::arg("simplices").noconvert());
}

}  // namespace derham::python
