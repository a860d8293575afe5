#include "any_star.hpp"
#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/operators/laplace_de_rham.hpp"
#include "derham/operators/weak_laplacian.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

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

/// The rows and columns of A with increasing numbers `kept`.
SparseMatrix restricted(const SparseMatrix& A, std::span<const Index> kept) {
  const auto count = static_cast<Index>(kept.size());
  std::vector<Index> number(static_cast<std::size_t>(A.cols()), -1);
  for (Index i = 0; i < count; ++i) number[static_cast<std::size_t>(kept[i])] = i;
  SparseMatrix result(count, count);
  result.reserve(A.nonZeros());
  for (Index i = 0; i < count; ++i) {
    result.startVec(i);
    for (SparseMatrix::InnerIterator entry(A, kept[i]); entry; ++entry)
      if (const Index j = number[static_cast<std::size_t>(entry.col())]; j >= 0)
        result.insertBack(i, j) = entry.value();
  }
  result.finalize();
  return result;
}

/// The matrix and the mass, of all unknowns or of those `kept`; σ comes first.
auto mixed_laplacian(const AnyComplex& any, int k, const MaterialArgument& material,
                     const std::optional<Indices>& kept) {
  return any.with_metric<1>([&](const auto& body) {
    auto mixed = without_gil([&] {
      auto whole = mixed_laplace_de_rham(*body.complex, *body.geometry, k, material_of(material));
      if (kept) {
        whole.matrix = restricted(whole.matrix, span_of(*kept));
        whole.mass = restricted(whole.mass, span_of(*kept));
      }
      return whole;
    });
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
  complex.def("mixed_laplacian", &mixed_laplacian, arg("k"), arg("material").none(), arg("kept").none());
  complex.def("whitney_mass", &mass, arg("k"), arg("material").none());
}

}  // namespace derham::python
