#include "derham/boundary/matrix.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <numeric>

namespace derham {
namespace {

template <int n>
void require_degree(int k, int low, int high) {
  if (k < low || k > high)
    throw InputError(text("degree ", k, " in a complex of dimension ", n, "; allowed are ", low, " to ", high));
}

void require_length(const char* name, std::size_t found, Index expected) {
  if (found != static_cast<std::size_t>(expected))
    throw InputError(text(name, " has ", found, " entries; there are ", expected, " simplices"));
}

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

SignMatrix transposed(const SignMatrix& matrix) {
  SignMatrix result;
  result.rows = matrix.cols;
  result.cols = matrix.rows;
  result.offsets.assign(static_cast<std::size_t>(result.rows) + 1, 0);
  for (const Index j : matrix.columns) ++result.offsets[static_cast<std::size_t>(j) + 1];
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.columns.resize(matrix.columns.size());
  result.values.resize(matrix.values.size());
  std::vector<Offset> next(result.offsets.begin(), result.offsets.end() - 1);
  for (Index i = 0; i < matrix.rows; ++i) {
    const auto begin = static_cast<std::size_t>(matrix.offsets[static_cast<std::size_t>(i)]);
    const auto end = static_cast<std::size_t>(matrix.offsets[static_cast<std::size_t>(i) + 1]);
    for (std::size_t p = begin; p < end; ++p) {
      const auto q = static_cast<std::size_t>(next[static_cast<std::size_t>(matrix.columns[p])]++);
      result.columns[q] = i;
      result.values[q] = matrix.values[p];
    }
  }
  return result;
}

}  // namespace

template <int n>
SignMatrix boundary_matrix(const SimplicialComplex<n>& K, int k) {
  require_degree<n>(k, 0, n);
  if (k > 0) return transposed(face_matrix(K, k));
  SignMatrix zero;
  zero.cols = K.size(0);
  return zero;
}

template <int n>
SignMatrix coboundary_matrix(const SimplicialComplex<n>& K, int k) {
  require_degree<n>(k, 0, n);
  if (k < n) return face_matrix(K, k + 1);
  SignMatrix zero;
  zero.cols = K.size(n);
  return zero;
}

template <int n>
void apply_coboundary(const SimplicialComplex<n>& K, int k, std::span<const double> x, std::span<double> y) {
  require_degree<n>(k, 0, n - 1);
  require_length("x", x.size(), K.size(k));
  require_length("y", y.size(), K.size(k + 1));
  parallel_blocks(K.size(k + 1), 1 << 14, [&](Offset first, Offset last) {
    for (Index i = static_cast<Index>(first); i < last; ++i) {
      const auto faces = K.faces(k + 1, i);
      double sum = 0;
      for (std::size_t j = 0; j < faces.size(); ++j)
        sum += entry(K, k + 1, i, j) * x[static_cast<std::size_t>(faces[j])];
      y[static_cast<std::size_t>(i)] = sum;
    }
  });
}

template <int n>
void apply_boundary(const SimplicialComplex<n>& K, int k, std::span<const double> x, std::span<double> y) {
  require_degree<n>(k, 1, n);
  require_length("x", x.size(), K.size(k));
  require_length("y", y.size(), K.size(k - 1));
  std::ranges::fill(y, 0.0);
  for (Index i = 0; i < K.size(k); ++i) {
    const auto faces = K.faces(k, i);
    for (std::size_t j = 0; j < faces.size(); ++j)
      y[static_cast<std::size_t>(faces[j])] += entry(K, k, i, j) * x[static_cast<std::size_t>(i)];
  }
}

#define DERHAM_INSTANTIATE(n)                                                                                   \
  template SignMatrix boundary_matrix(const SimplicialComplex<n>&, int);                                        \
  template SignMatrix coboundary_matrix(const SimplicialComplex<n>&, int);                                      \
  template void apply_coboundary(const SimplicialComplex<n>&, int, std::span<const double>, std::span<double>); \
  template void apply_boundary(const SimplicialComplex<n>&, int, std::span<const double>, std::span<double>);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
