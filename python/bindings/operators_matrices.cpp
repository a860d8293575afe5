#include "any_star.hpp"
#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/operators/laplace_de_rham.hpp"

#include <nanobind/stl/tuple.h>

// δ and Laplace–de Rham as matrices.
namespace derham::python {
namespace {

template <int n, int k, Side side>
SparseMatrix codifferential_matrix(const HodgeStar<n>& star) {
  return codifferential<Form<n, k, side>>(star).matrix();
}

template <int n, int k, Side side>
SparseMatrix laplacian_matrix(const HodgeStar<n>& star) {
  return laplace_de_rham<Form<n, k, side>>(star).matrix();
}

auto codifferential_of(const AnyStar& any, int k, bool dual) {
  return any.visit<1>([&]<int n>(const std::shared_ptr<const StarOf<n>>& star) {
    return arrays_of(without_gil([&] {
      return with_constant<1, n>(k, "the degree k", [&](auto degree) {
        return dual ? codifferential_matrix<n, degree(), Side::dual>(star->star)
                    : codifferential_matrix<n, degree(), Side::primal>(star->star);
      });
    }));
  });
}

auto laplacian_of(const AnyStar& any, int k, bool dual) {
  return any.visit<1>([&]<int n>(const std::shared_ptr<const StarOf<n>>& star) {
    return arrays_of(without_gil([&] {
      return with_constant<0, n>(k, "the degree k", [&](auto degree) {
        return dual ? laplacian_matrix<n, degree(), Side::dual>(star->star)
                    : laplacian_matrix<n, degree(), Side::primal>(star->star);
      });
    }));
  });
}

}  // namespace

void bind_operator_matrices(StarClass& star) {
  using nb::arg;
  star.def("codifferential", &codifferential_of, arg("k"), arg("dual"));
  star.def("laplacian", &laplacian_of, arg("k"), arg("dual"));
}

}  // namespace derham::python
