#include "derham/forms/refined_form.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/core/parallel.hpp"

#include <algorithm>
#include <vector>

// With B the barycentric coordinates of the vertices of a k-simplex t within a simplex that contains it, ∫_t W_s is the
// minor of B of the columns s: W_s/k! is the contraction of dλ_0 ∧ … ∧ dλ_k with the radial field, and B is linear.

namespace derham {
namespace {

constexpr Offset grain = 1 << 11;  // simplices per block of a parallel loop

template <int size>
using Matrix = std::array<std::array<int, size>, size>;

/// By the first row; most entries are zero.
template <int size>
int determinant(const Matrix<size>& A) {
  if constexpr (size == 1) {
    return A[0][0];
  } else {
    int sum = 0;
    for (std::size_t j = 0; j < size; ++j) {
      if (A[0][j] == 0) continue;
      Matrix<size - 1> minor{};
      for (std::size_t row = 1; row < size; ++row)
        for (std::size_t column = 0, c = 0; column < size; ++column)
          if (column != j) minor[row - 1][c++] = A[row][column];
      sum += (j % 2 == 0 ? 1 : -1) * A[0][j] * determinant<size - 1>(minor);
    }
    return sum;
  }
}

/// Twice the barycentric coordinates of a fine k-simplex in the sorted vertices of its carrier, column by column.
template <int n, int k>
std::array<std::array<int, k + 1>, n + 1> doubled_coordinates(const Refinement<n>& refinement, Index i,
                                                              std::span<const Index> carrier) {
  std::array<std::array<int, k + 1>, n + 1> columns{};
  const auto vertices = refinement.fine().template simplex<k>(i);
  for (std::size_t row = 0; row <= k; ++row)
    for (const Index end : refinement.ends(vertices[row])) {
      const auto place = std::ranges::lower_bound(carrier, end) - carrier.begin();
      ++columns[static_cast<std::size_t>(place)][row];
    }
  return columns;
}

template <int n, int k>
ProlongationRow row_of(const Refinement<n>& refinement, Index i) {
  const auto& K = refinement.coarse();
  const RowTarget carrier = refinement.carrier(k, i);
  const auto vertices = K.simplex(carrier.degree, carrier.index);
  const auto columns = doubled_coordinates<n, k>(refinement, i, vertices);
  constexpr double unit = 1.0 / (1 << (k + 1));
  ProlongationRow row;
  for (unsigned mask = 1; mask < 1U << vertices.size(); ++mask) {
    if (std::popcount(mask) != k + 1) continue;
    Matrix<k + 1> minor{};
    std::array<Index, k + 1> face{};
    for (std::size_t v = 0, c = 0; v < vertices.size(); ++v)
      if ((mask >> v & 1U) != 0) {
        face[c] = vertices[v];
        minor[c++] = columns[v];
      }
    const int value = determinant<k + 1>(minor);
    if (value == 0) continue;
    const SignedIndex found = K.find(face);
    row.simplex[row.size] = found.index;
    row.weight[row.size++] = unit * value * found.sign * refinement.fine().sign(k, i);
  }
  return row;
}

/// The sum of 2^k values, which are overwritten; without rounding when all are equal, so that R P = 1 for any numbers.
double sum_by_halves(std::span<double> values) {
  for (std::size_t half = values.size() / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) values[i] += values[i + half];
  return values[0];
}

}  // namespace

template <int n>
ProlongationRow prolongation_row(const Refinement<n>& refinement, int k, Index i) {
  detail::require_degree(n, k, 0, n);
  ProlongationRow row;
  detail::with_degree<0, n>(k, [&]<int m>(std::integral_constant<int, m>) { row = row_of<n, m>(refinement, i); });
  return row;
}

template <int n>
void apply_prolongation(const Refinement<n>& refinement, int k, std::span<const double> x, std::span<double> y) {
  const auto& fine = refinement.fine();
  detail::require_degree(n, k, 0, n);
  detail::require_shape("x", x.size(), refinement.coarse().size(k), 1);
  detail::require_shape("y", y.size(), fine.size(k), 1);
  detail::with_degree<0, n>(k, [&]<int m>(std::integral_constant<int, m>) {
    parallel_blocks(fine.size(m), grain, [&](Offset first, Offset last) {
      for (auto i = static_cast<Index>(first); i < last; ++i) {
        const ProlongationRow row = row_of<n, m>(refinement, i);
        double sum = 0;
        for (std::size_t j = 0; j < row.size; ++j) sum += row.weight[j] * x[static_cast<std::size_t>(row.simplex[j])];
        y[static_cast<std::size_t>(i)] = sum;
      }
    });
  });
}

template <int n>
void apply_restriction(const Refinement<n>& refinement, int k, std::span<const double> x, std::span<double> y) {
  const auto& K = refinement.coarse();
  const auto& fine = refinement.fine();
  detail::require_degree(n, k, 0, n);
  detail::require_shape("x", x.size(), fine.size(k), 1);
  detail::require_shape("y", y.size(), K.size(k), 1);
  parallel_blocks(K.size(k), grain, [&](Offset first, Offset last) {
    const auto width = static_cast<std::size_t>(k) + 1;
    std::vector<Index> pieces;
    for (auto i = static_cast<Index>(first); i < last; ++i) {
      pieces.clear();
      refinement.append_pieces(K.simplex(k, i), pieces);
      std::array<double, 1 << n> value{};
      for (std::size_t p = 0; p * width < pieces.size(); ++p) {
        const SignedIndex piece = fine.find(std::span<const Index>(pieces).subspan(p * width, width));
        value[p] = piece.sign * x[static_cast<std::size_t>(piece.index)];
      }
      y[static_cast<std::size_t>(i)] = K.sign(k, i) * sum_by_halves(std::span(value).first(std::size_t{1} << k));
    }
  });
}

#define DERHAM_INSTANTIATE(n)                                                                              \
  template ProlongationRow prolongation_row(const Refinement<n>&, int, Index);                             \
  template void apply_prolongation(const Refinement<n>&, int, std::span<const double>, std::span<double>); \
  template void apply_restriction(const Refinement<n>&, int, std::span<const double>, std::span<double>);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
