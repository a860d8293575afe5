#include "derham/operators/weak_laplacian.hpp"

#include "derham/boundary/eigen.hpp"
#include "derham/core/cancel.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/operators/linear_map.hpp"

#include <vector>

namespace derham {
namespace {

template <int n>
void require_degree(int k) {
  if (k < 0 || k > n) throw InputError(text("a Laplacian of ", k, "-forms; degrees are 0 to ", n));
}

template <int n>
SparseMatrix derivative(const SimplicialComplex<n>& K, int k) {
  return to_eigen(coboundary_matrix(K, k));
}

void require_shape(const SparseMatrix& M, Index size, int k) {
  if (M.rows() != size || M.cols() != size)
    throw InputError(text("an inner product of ", k, "-forms of shape ", M.rows(), " x ", M.cols(), "; expected ", size,
                          " rows and columns"));
}

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_block(const SparseMatrix& A, Index row, Index column, Triplets& entries) {
  poll_cancel();
  for (Eigen::Index i = 0; i < A.outerSize(); ++i)
    for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry)
      entries.emplace_back(static_cast<int>(row + entry.row()), static_cast<int>(column + entry.col()), entry.value());
}

SparseMatrix matrix_of(Index size, const Triplets& entries) {
  SparseMatrix result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// 1/star of the free k-simplices.
template <int n>
std::vector<double> free_inverse(const HodgeStar<n>& star, const FormSpace<n>& space, int k) {
  const auto diagonal = star.diagonal(k);
  std::vector<double> inverse;
  std::vector<Index> zero;
  for (const Index i : space.free(k)) {
    const double entry = diagonal[static_cast<std::size_t>(i)];
    if (entry == 0) zero.push_back(i);
    inverse.push_back(1 / entry);
  }
  if (!zero.empty())
    throw GeometryError(text("the Laplacian divides by dual volumes, and ", zero.size(), " of them are zero: those of ",
                             simplices_text<n>(star.complex(), k, zero), "; use mixed_laplace_de_rham"));
  return inverse;
}

}  // namespace

template <int n>
  requires(n >= 1)
SparseMatrix weak_laplace_de_rham(const HodgeStar<n>& star, int k) {
  require_degree<n>(k);
  const auto& K = star.complex();
  SparseMatrix result(K.size(k), K.size(k));
  if (k < n) {
    const SparseMatrix d = derivative(K, k);
    result = d.transpose() * detail::diagonal_matrix(star.diagonal(k + 1)) * d;
  }
  poll_cancel();
  if (k > 0) {
    const SparseMatrix flux = detail::diagonal_matrix(star.diagonal(k)) * derivative(K, k - 1);
    result += SparseMatrix(flux * detail::diagonal_matrix(star.inverse_diagonal(k - 1)) * flux.transpose());
  }
  return result;
}

template <int n>
  requires(n >= 1)
SparseMatrix weak_laplace_de_rham(const HodgeStar<n>& star, const FormSpace<n>& space, int k) {
  require_degree<n>(k);
  const auto& K = star.complex();
  if (&space.complex() != &K) throw InputError("the form space and the Hodge star belong to different complexes");
  const SparseMatrix E = space.extension(k);
  SparseMatrix result(E.cols(), E.cols());
  if (k < n) {
    const SparseMatrix d = derivative(K, k) * E;
    result = d.transpose() * detail::diagonal_matrix(star.diagonal(k + 1)) * d;
  }
  poll_cancel();
  if (k > 0) {
    const SparseMatrix flux =
        E.transpose() * detail::diagonal_matrix(star.diagonal(k)) * derivative(K, k - 1) * space.extension(k - 1);
    result += SparseMatrix(flux * detail::diagonal_matrix(free_inverse(star, space, k - 1)) * flux.transpose());
  }
  return result;
}

template <int n>
  requires(n >= 1)
MixedLaplacian mixed_laplace_de_rham(const SimplicialComplex<n>& K, int k, const std::array<SparseMatrix, 3>& M) {
  require_degree<n>(k);
  require_shape(M[1], K.size(k), k);
  const Index sigma = k > 0 ? K.size(k - 1) : 0, size = sigma + K.size(k);
  Triplets entries;
  if (k > 0) {
    require_shape(M[0], K.size(k - 1), k - 1);
    const SparseMatrix coupling = M[1] * derivative(K, k - 1);
    add_block(-M[0], 0, 0, entries);
    add_block(coupling, sigma, 0, entries);
    add_block(coupling.transpose(), 0, sigma, entries);
  }
  if (k < n) {
    require_shape(M[2], K.size(k + 1), k + 1);
    const SparseMatrix d = derivative(K, k);
    add_block(d.transpose() * M[2] * d, sigma, sigma, entries);
  }
  Triplets mass;
  add_block(M[1], sigma, sigma, mass);
  return {sigma, matrix_of(size, entries), matrix_of(size, mass)};
}

template <int n>
  requires(n >= 1)
MixedLaplacian mixed_laplace_de_rham(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k,
                                     const Material& material) {
  require_degree<n>(k);
  std::array<SparseMatrix, 3> M;
  for (int j = 0; j < 3; ++j)
    if (k - 1 + j >= 0 && k - 1 + j <= n)
      M[static_cast<std::size_t>(j)] = whitney_mass(K, geometry, k - 1 + j, material);
  return mixed_laplace_de_rham(K, k, M);
}

template <int n>
  requires(n >= 1)
MixedLaplacian restricted(const MixedLaplacian& whole, const FormSpace<n>& space, int k) {
  require_degree<n>(k);
  const auto& K = space.complex();
  const Index sigma = k > 0 ? K.size(k - 1) : 0;
  require_shape(whole.matrix, sigma + K.size(k), k);
  Triplets entries;
  if (k > 0) add_block(space.extension(k - 1), 0, 0, entries);
  const Index free_sigma = k > 0 ? static_cast<Index>(space.free(k - 1).size()) : 0;
  add_block(space.extension(k), sigma, free_sigma, entries);
  SparseMatrix E(whole.matrix.rows(), free_sigma + static_cast<Index>(space.free(k).size()));
  E.setFromTriplets(entries.begin(), entries.end());
  return {free_sigma, E.transpose() * whole.matrix * E, E.transpose() * whole.mass * E};
}

#define DERHAM_INSTANTIATE(n)                                                                                          \
  template SparseMatrix weak_laplace_de_rham(const HodgeStar<n>&, int);                                                \
  template SparseMatrix weak_laplace_de_rham(const HodgeStar<n>&, const FormSpace<n>&, int);                           \
  template MixedLaplacian mixed_laplace_de_rham(const SimplicialComplex<n>&, int, const std::array<SparseMatrix, 3>&); \
  template MixedLaplacian mixed_laplace_de_rham(const SimplicialComplex<n>&, const Geometry<n>&, int,                  \
                                                const Material&);                                                      \
  template MixedLaplacian restricted(const MixedLaplacian&, const FormSpace<n>&, int);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
