#include "derham/operators/boundary_terms.hpp"

#include <vector>

namespace derham {

template <int n>
  requires(n >= 1)
SparseMatrix trace_matrix(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B, int k) {
  if (k < 0 || k >= n) throw InputError(text("the trace of ", k, "-forms; degrees are 0 to ", n - 1));
  detail::require_boundary_of(K, B, k);
  const auto& inclusion = B.inclusion[static_cast<std::size_t>(k)];
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < B.complex.size(k); ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(inclusion[static_cast<std::size_t>(i)]),
                         B.complex.sign(k, i));
  SparseMatrix result(B.complex.size(k), K.size(k));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

template <int n>
  requires(n >= 1)
SparseMatrix robin_matrix(const SimplicialComplex<n>& K, const BoundaryComplex<n>& B, int k, const SparseMatrix& S) {
  const SparseMatrix T = trace_matrix(K, B, k);
  if (S.rows() != T.rows() || S.cols() != T.rows())
    throw InputError(text("an inner product of ", k, "-forms on the boundary of shape ", S.rows(), " x ", S.cols(),
                          "; expected ", T.rows(), " rows and columns"));
  return T.transpose() * S * T;
}

#define DERHAM_INSTANTIATE(n)                                                                      \
  template SparseMatrix trace_matrix(const SimplicialComplex<n>&, const BoundaryComplex<n>&, int); \
  template SparseMatrix robin_matrix(const SimplicialComplex<n>&, const BoundaryComplex<n>&, int, const SparseMatrix&);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
