#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/operators/boundary_terms.hpp"

#include <nanobind/stl/tuple.h>

#include <memory>

// Traces and Robin terms as matrices.
namespace derham::python {
namespace {

auto matrix_of_trace(const AnyBoundary& any, int k) {
  return any.visit<max_metric_dimension>([k]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) {
    return arrays_of(without_gil([&] { return trace_matrix(*of->body.complex, of->boundary, k); }));
  });
}

/// S is given by its values, indices and pointers, by rows.
using Places = Input<SparseMatrix::StorageIndex, nb::ndim<1>>;
auto matrix_of_robin(const AnyBoundary& any, int k, const Values& values, const Places& indices,
                     const Places& pointers) {
  return any.visit<max_metric_dimension>([&]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) {
    const auto size = static_cast<Eigen::Index>(of->boundary.complex.size(k));
    const Eigen::Map<const SparseMatrix> S(size, size, static_cast<Eigen::Index>(values.size()), pointers.data(),
                                           indices.data(), values.data());
    return arrays_of(without_gil([&] { return robin_matrix<n>(*of->body.complex, of->boundary, k, SparseMatrix(S)); }));
  });
}

}  // namespace

void bind_operator_boundary(BoundaryClass& boundary) {
  using nb::arg;
  boundary.def("trace_matrix", &matrix_of_trace, arg("k"));
  boundary.def("robin_matrix", &matrix_of_robin, arg("k"), arg("values").noconvert(), arg("indices").noconvert(),
               arg("pointers").noconvert());
}

}  // namespace derham::python
