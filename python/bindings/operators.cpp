#include "any_star.hpp"
#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/operators/star_report.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <string>
#include <tuple>

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

auto mass(const AnyComplex& any, int k, const MaterialArgument& material) {
  return any.with_metric([&](const auto& body) {
    return arrays_of(
        without_gil([&] { return whitney_mass(*body.complex, *body.geometry, k, material_of(material)); }));
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

}  // namespace

void bind_operators(ComplexClass& complex, StarClass& star) {
  using nb::arg;
  star.def("report", &report_of_star, arg("k"));
  complex.def("whitney_mass", &mass, arg("k"), arg("material").none());
  complex.def("whitney_report", &report_of_mass, arg("k"), arg("material").none());
}

}  // namespace derham::python
