#include "any_star.hpp"
#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/operators/laplace_de_rham.hpp"
#include "derham/operators/weak_laplacian.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <nanobind/stl/tuple.h>

// δ, Laplace–de Rham in all its forms, and Whitney masses as matrices.
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

auto mass(const AnyComplex& any, int k, const MaterialArgument& material) {
  return any.with_metric([&](const auto& body) {
    return arrays_of(
        without_gil([&] { return whitney_mass(*body.complex, *body.geometry, k, material_of(material)); }));
  });
}

}  // namespace

void bind_operator_matrices(ComplexClass& complex, StarClass& star) {
  using nb::arg;
  star.def("codifferential", &codifferential_of, arg("k"), arg("dual"));
  star.def("laplacian", &laplacian_of, arg("k"), arg("dual"));
  star.def("weak_laplacian", &weak_laplacian, arg("k"));
  complex.def("mixed_laplacian", &mixed_laplacian, arg("k"), arg("material").none());
  complex.def("whitney_mass", &mass, arg("k"), arg("material").none());
}

}  // namespace derham::python
