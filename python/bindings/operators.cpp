#include "any_star.hpp"
#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/operators/boundary_terms.hpp"
#include "derham/operators/hot_weights.hpp"
#include "derham/operators/star_report.hpp"
#include "derham/operators/weak_laplacian.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

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

template <class Lists>
auto arrays_by_degree(Lists& lists) {
  std::vector<Array<Index>> arrays;
  for (auto& list : lists) arrays.push_back(owned(std::move(list)));
  return arrays;
}

auto weights(const AnyComplex& any, double margin) {
  return any.with_metric<1>([margin](const auto& body) {
    auto found = without_gil([&] { return hot_weights(*body.complex, *body.geometry, margin); });
    return std::tuple(owned(std::move(found.weights)), found.energy_before, found.energy,
                      arrays_by_degree(found.not_positive_before), arrays_by_degree(found.not_positive),
                      found.excluded_range, found.advice);
  });
}

auto weak_laplacian(const AnyStar& any, int k) {
  return any.visit<1>(
      [k](const auto& star) { return arrays_of(without_gil([&] { return weak_laplace_de_rham(star->star, k); })); });
}

/// The matrix and the mass; σ comes first.
auto mixed_laplacian(const AnyComplex& any, int k, const MaterialArgument& material) {
  return any.with_metric<1>([&](const auto& body) {
    auto mixed =
        without_gil([&] { return mixed_laplace_de_rham(*body.complex, *body.geometry, k, material_of(material)); });
    return std::tuple(arrays_of(std::move(mixed.matrix)), arrays_of(std::move(mixed.mass)));
  });
}

auto matrix_of_trace(const AnyBoundary& any, int k) {
  using Arrays = decltype(arrays_of(SparseMatrix()));
  return any.visit([k]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) -> Arrays {
    if constexpr (n > max_metric_dimension)
      throw InputError(text("the dimension of the complex is ", n, "; expected 1 to ", max_metric_dimension));
    else
      return arrays_of(without_gil([&] { return trace_matrix(*of->body.complex, of->boundary, k); }));
  });
}

/// S is given by its values, indices and pointers, by rows.
using Places = Input<SparseMatrix::StorageIndex, nb::ndim<1>>;
auto matrix_of_robin(const AnyBoundary& any, int k, const Values& values, const Places& indices,
                     const Places& pointers) {
  using Arrays = decltype(arrays_of(SparseMatrix()));
  return any.visit([&]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) -> Arrays {
    if constexpr (n > max_metric_dimension) {
      throw InputError(text("the dimension of the complex is ", n, "; expected 1 to ", max_metric_dimension));
    } else {
      const auto size = static_cast<Eigen::Index>(of->boundary.complex.size(k));
      const Eigen::Map<const SparseMatrix> S(size, size, static_cast<Eigen::Index>(values.size()), pointers.data(),
                                             indices.data(), values.data());
      return arrays_of(
          without_gil([&] { return robin_matrix<n>(*of->body.complex, of->boundary, k, SparseMatrix(S)); }));
    }
  });
}

}  // namespace

void bind_operators(ComplexClass& complex, StarClass& star, BoundaryClass& boundary) {
  using nb::arg;
  star.def("report", &report_of_star, arg("k"));
  star.def("weak_laplacian", &weak_laplacian, arg("k"));
  boundary.def("trace_matrix", &matrix_of_trace, arg("k"));
  boundary.def("robin_matrix", &matrix_of_robin, arg("k"), arg("values").noconvert(), arg("indices").noconvert(),
               arg("pointers").noconvert());
  complex.def("hot_weights", &weights, arg("margin"));
  complex.def("mixed_laplacian", &mixed_laplacian, arg("k"), arg("material").none());
  complex.def("whitney_mass", &mass, arg("k"), arg("material").none());
  complex.def("whitney_report", &report_of_mass, arg("k"), arg("material").none());
}

}  // namespace derham::python
