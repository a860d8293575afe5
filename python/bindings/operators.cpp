#include "any_star.hpp"
#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/operators/hot_weights.hpp"
#include "derham/operators/linear_map.hpp"
#include "derham/operators/star_report.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>

// What stars and masses are good for, and weights that make a star good.
namespace derham::python {
namespace {

auto fields_of(StarReport report) {
  constexpr const char* definiteness[] = {"positive", "not positive", "unproved"};
  return std::tuple(std::string(definiteness[static_cast<int>(report.definiteness)]), owned(std::move(report.zero)),
                    owned(std::move(report.negative)), report.smallest, report.largest, report.condition,
                    report.constant_error, report.advice);
}

auto report_of_star(const AnyStar& any, int k) {
  return any.visit<1>([k](const auto& star) {
    return fields_of(without_gil([&] { return star_report(star->star, *star->body.geometry, k); }));
  });
}

auto report_of_mass(const AnyComplex& any, int k, const MaterialArgument& given) {
  return any.with_metric<1>([&](const auto& body) {
    return fields_of(without_gil([&] {
      const Material material = material_of(given);
      const SparseMatrix matrix = whitney_mass(*body.complex, *body.geometry, k, material);
      return star_report(matrix, *body.complex, *body.geometry, k, material);
    }));
  });
}

auto weights(const AnyComplex& any, double margin) {
  return any.with_metric<1>([margin](const auto& body) {
    auto found = without_gil([&] { return hot_weights(*body.complex, *body.geometry, margin); });
    return std::tuple(owned(std::move(found.weights)), found.energy_before, found.energy,
                      owned_each(std::move(found.not_positive_before)), owned_each(std::move(found.not_positive)),
                      found.excluded_range, found.advice);
  });
}

}  // namespace

void bind_operators(ComplexClass& complex, StarClass& star) {
  using nb::arg;
  star.def("report", &report_of_star, arg("k"));
  complex.def("whitney_report", &report_of_mass, arg("k"), arg("material").none());
  complex.def("hot_weights", &weights, arg("margin"));
}

}  // namespace derham::python
