#pragma once

#include "derham/complex/local_faces.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/simplex_frame.hpp"
#include "derham/operators/whitney_simplex.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

// Internal to this room.
namespace derham::detail {

/// subsets<k>(n), at compile time.
template <int n, int k>
constexpr auto lexicographic_subsets() noexcept {
  std::array<std::array<int, static_cast<std::size_t>(k)>, static_cast<std::size_t>(binomial(n, k))> result{};
  for (unsigned mask = 0, count = 0; mask < (1U << n); ++mask) {
    if (std::popcount(mask) != k) continue;
    for (std::size_t v = 0, i = 0; v < n; ++v)
      if ((mask >> v) & 1U) result[count][i++] = static_cast<int>(v);
    ++count;
  }
  std::ranges::sort(result);
  return result;
}

/// The mass matrix of one n-simplex is linear in the products ⟨dλ_S, A dλ_T⟩ of constant forms, S and T sets of k of the
/// vertices 1, …, n: as dλ_0 = -Σ dλ_j, these give all others. The coefficients are the same for all simplices.
template <int n, int k>
struct LocalMass {
  static constexpr std::size_t faces = static_cast<std::size_t>(binomial(n + 1, k + 1));
  static constexpr std::size_t sets = static_cast<std::size_t>(binomial(n, k));
  static constexpr std::size_t products = sets * (sets + 1) / 2;

  /// Place of the product of two sets, p <= q.
  static constexpr std::size_t pair(std::size_t p, std::size_t q) noexcept { return q * (q + 1) / 2 + p; }

  /// dλ_S as a combination of those without vertex 0.
  static constexpr std::array<int, sets> reduced(unsigned mask) noexcept {
    constexpr auto without_zero = masks_of_upper();
    std::array<int, sets> result{};
    if (!(mask & 1U)) {
      for (std::size_t p = 0; p < sets; ++p) result[p] = without_zero[p] == mask ? 1 : 0;
      return result;
    }
    for (int j = 1; j <= n; ++j) {
      const unsigned rest = mask & ~1U, set = rest | (1U << j);
      if (set == rest) continue;
      for (std::size_t p = 0; p < sets; ++p)
        if (without_zero[p] == set) result[p] = -place_sign(set, j);
    }
    return result;
  }

  /// Sets of k of the vertices 1, …, n.
  static constexpr std::array<unsigned, sets> masks_of_upper() noexcept {
    std::array<unsigned, sets> result{};
    for (unsigned mask = 0, i = 0; mask <= full_mask<n>; mask += 2)
      if (std::popcount(mask) == k) result[i++] = mask;
    return result;
  }

  /// [a][product][b]: M_ab = Σ coefficient · product, where products hold (k!)²|T|/((n+1)(n+2)).
  using Table = std::array<std::array<std::array<double, faces>, products>, faces>;
  static Table table() noexcept {
    constexpr auto face = masks_of<n, k + 1>();
    Table result{};
    for (std::size_t a = 0; a < faces; ++a)
      for (std::size_t b = 0; b < faces; ++b)
        for (int v = 0; v <= n; ++v)
          for (int w = 0; w <= n; ++w) {
            if (!((face[a] >> v) & 1U) || !((face[b] >> w) & 1U)) continue;
            const int sign = place_sign(face[a], v) * place_sign(face[b], w) * (v == w ? 2 : 1);
            const auto S = reduced(face[a] & ~(1U << v)), T = reduced(face[b] & ~(1U << w));
            for (std::size_t p = 0; p < sets; ++p)
              for (std::size_t q = 0; q < sets; ++q)
                result[a][pair(p < q ? p : q, p < q ? q : p)][b] += sign * S[p] * T[q];
          }
    return result;
  }

  /// The products for the simplex of a frame; `tensor` (sets, sets) acts on components in the frame, nullptr is 1.
  static void multiply(const SimplexFrame<n>& frame, double factor, const double* tensor, double* result) noexcept {
    constexpr auto upper = masks_of_upper();
    const auto& gradient = frame.gradients();
    std::array<std::array<double, sets>, sets> form{}, weighed{};
    for (std::size_t p = 0; p < sets; ++p) {
      std::array<const double*, static_cast<std::size_t>(k)> rows{};
      for (std::size_t v = 1, i = 0; v <= n; ++v)
        if ((upper[p] >> v) & 1U) rows[i++] = gradient[v].data();
      for (std::size_t c = 0; c < sets; ++c) form[p][c] = minor_of<k>(rows, columns[c]);
    }
    weighed = form;
    if (tensor != nullptr)
      for (std::size_t p = 0; p < sets; ++p)
        for (std::size_t c = 0; c < sets; ++c) {
          weighed[p][c] = 0;
          for (std::size_t e = 0; e < sets; ++e) weighed[p][c] += form[p][e] * tensor[e * sets + c];
        }
    factor *= frame.volume() * static_cast<double>(factorial(k) * factorial(k)) / ((n + 1) * (n + 2));
    for (std::size_t q = 0; q < sets; ++q)
      for (std::size_t p = 0; p <= q; ++p) {
        double sum = 0;
        for (std::size_t c = 0; c < sets; ++c) sum += weighed[p][c] * form[q][c];
        result[pair(p, q)] = factor * sum;
      }
  }

 private:
  static constexpr auto columns = lexicographic_subsets<n, k>();
};

}  // namespace derham::detail
