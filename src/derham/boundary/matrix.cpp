#include "derham/boundary/matrix.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/complex/cofaces.hpp"

namespace derham {
namespace {

/// Sign of position j of the face table of simplex i of degree k.
template <int n>
Sign entry(const SimplicialComplex<n>& K, int k, Index i, std::size_t j) {
  return static_cast<Sign>(K.sign(k, i) * face_sign(k - static_cast<int>(j)));
}

/// The boundary table of degree k as rows: one row per k-simplex.
template <int n>
SignMatrix face_matrix(const SimplicialComplex<n>& K, int k) {
  const auto width = static_cast<std::size_t>(k) + 1;
  SignMatrix matrix;
  matrix.rows = K.size(k);
  matrix.cols = K.size(k - 1);
  matrix.offsets.resize(static_cast<std::size_t>(matrix.rows) + 1);
  for (std::size_t i = 0; i < matrix.offsets.size(); ++i) matrix.offsets[i] = static_cast<Offset>(i * width);
  const auto faces = K.face_table(k);
  matrix.columns.assign(faces.begin(), faces.end());
  matrix.values.reserve(faces.size());
  for (Index i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < width; ++j) matrix.values.push_back(entry(K, k, i, j));
  return matrix;
}

/// ∂_k: one row per (k-1)-simplex, with its cofaces.
template <int n>
SignMatrix coface_matrix(const SimplicialComplex<n>& K, int k) {
  const Cofaces cofaces(K, k - 1);
  SignMatrix matrix;
  matrix.rows = K.size(k - 1);
  matrix.cols = K.size(k);
  matrix.offsets.assign(cofaces.offsets().begin(), cofaces.offsets().end());
  matrix.columns.reserve(cofaces.packed().size());
  matrix.values.reserve(cofaces.packed().size());
  for (Index i = 0; i < matrix.rows; ++i)
    for (const auto [coface, sign] : cofaces[i]) {
      matrix.columns.push_back(coface);
      matrix.values.push_back(static_cast<Sign>(sign * K.sign(k, coface)));
    }
  return matrix;
}

}  // namespace

template <int n>
SignMatrix boundary_matrix(const SimplicialComplex<n>& K, int k) {
  detail::require_degree(n, k, 0, n);
  if (k > 0) return coface_matrix(K, k);
  SignMatrix zero;
  zero.cols = K.size(0);
  return zero;
}

template <int n>
SignMatrix coboundary_matrix(const SimplicialComplex<n>& K, int k) {
  detail::require_degree(n, k, 0, n);
  if (k < n) return face_matrix(K, k + 1);
  SignMatrix zero;
  zero.cols = K.size(n);
  return zero;
}

#define DERHAM_INSTANTIATE(n)                                            \
  template SignMatrix boundary_matrix(const SimplicialComplex<n>&, int); \
  template SignMatrix coboundary_matrix(const SimplicialComplex<n>&, int);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
