#include "derham/forms/wedge.hpp"

#include "derham/boundary/matrix_free.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/complex/local_faces.hpp"
#include "derham/core/parallel.hpp"

#include <array>
#include <bit>
#include <utility>

// This follows Whitney, "On products in a complex", 1938. The p!q! permutations that give the same front p-face, back
// q-face and common vertex give the same term; a term is kept once. With F the front face, v the vertex that it shares
// with the back face and F' the vertices that are not in F, all as bit masks of the vertices of one simplex, a ∧ b is
//   p!q!/(p+q+1)! Σ_F a(F) Σ_{v in F} ± b(F' + v).

namespace derham {
namespace {

using detail::with_degree;

constexpr Offset grain = 1 << 13;  // simplices per block of a parallel loop

/// Where the simplices of a complex and their faces are listed, whatever its dimension.
struct Tables {
  std::array<const Index*, max_dimension + 1> simplices{}, faces{};

  template <int n>
  explicit Tables(const SimplicialComplex<n>& K) {
    for (int k = 0; k <= n; ++k) simplices[static_cast<std::size_t>(k)] = K.simplices(k).data();
    for (int k = 1; k <= n; ++k) faces[static_cast<std::size_t>(k)] = K.face_table(k).data();
  }
};

/// The sign of the vertices of `low` in increasing order followed by those of `high`.
constexpr int shuffle_sign(unsigned low, unsigned high) {
  int inversions = 0;
  for (unsigned rest = high; rest != 0; rest &= rest - 1)
    inversions += std::popcount(low & ~((1U << std::countr_zero(rest)) - 1));
  return inversions % 2 == 0 ? 1 : -1;
}

/// The sign of the permutation (front without the shared vertex, that vertex, back without it) times those that bring
/// front and back in increasing order: the places of the shared vertex cancel.
constexpr int term_sign(unsigned front, unsigned back) { return shuffle_sign(front & ~back, back & ~front); }

/// Bit number `place` of those that are set.
constexpr unsigned nth_bit(unsigned mask, int place) {
  for (; place > 0; --place) mask &= mask - 1;
  return mask & (~mask + 1);
}

/// Σ_{v in front} ± b(complement + v).
template <unsigned front, unsigned whole, class B>
[[gnu::always_inline]] inline double back_sum(B&& b) {
  constexpr unsigned complement = whole & ~front;
  return [&]<int... i>(std::integer_sequence<int, i...>) {
    const auto term = [&]<int j>() {
      constexpr unsigned back = complement | nth_bit(front, j);
      return term_sign(front, back) > 0 ? b.template operator()<back>() : -b.template operator()<back>();
    };
    return (term.template operator()<i>() + ...);
  }(std::make_integer_sequence<int, std::popcount(front)>());
}

/// The value of a ∧ b on one sorted simplex; a and b give the values on its faces, by their masks.
template <int p, int q, class A, class B>
[[gnu::always_inline]] inline double product(A&& a, B&& b) {
  constexpr unsigned whole = full_mask<p + q>;
  double sum = 0;
  for_each_mask<p + q>([&]<unsigned front>() {
    if constexpr (mask_degree(front) == p) sum += a.template operator()<front>() * back_sum<front, whole>(b);
  });
  constexpr Offset terms = factorial(p + q + 1) / (factorial(p) * factorial(q));
  return sum / static_cast<double>(terms);
}

template <int p, int q>
void multiply(const Tables& K, Offset simplices, const Sign* signs, const double* __restrict a,
              const double* __restrict b, double* __restrict y) {
  constexpr int m = p + q;
  parallel_blocks(simplices, grain, [=](Offset first, Offset last) {
    const auto row = [&]<int k>(Index i) { return K.faces[k] + static_cast<Offset>(i) * (k + 1); };
    for (Offset i = first; i < last; ++i) {
      const Index* const vertices = K.simplices[m] + i * (m + 1);
      const auto face = local_faces<m>(static_cast<Index>(i), row);
      const auto value = [&]<unsigned mask>(const double* x) {
        if constexpr (mask_degree(mask) == 0)
          return x[vertices[std::countr_zero(mask)]];
        else
          return x[face[mask]];
      };
      const double wedge = product<p, q>([&]<unsigned mask>() { return value.template operator()<mask>(a); },
                                         [&]<unsigned mask>() { return value.template operator()<mask>(b); });
      y[i] = detail::negated_if(signs != nullptr && signs[i] < 0, wedge);
    }
  });
}

}  // namespace

template <int n>
void apply_wedge(const SimplicialComplex<n>& K, int p, std::span<const double> a, int q, std::span<const double> b,
                 std::span<double> y) {
  detail::require_degree(n, p, 0, n);
  detail::require_degree(n, q, 0, n - p);
  detail::require_shape("a", a.size(), K.size(p), 1);
  detail::require_shape("b", b.size(), K.size(q), 1);
  detail::require_shape("y", y.size(), K.size(p + q), 1);
  // Values of top degree refer to the positive orientation: one sign for each of a, b and y that has that degree.
  const bool odd = ((p == n) + (q == n) + (p + q == n)) % 2 != 0;
  const Sign* const signs = odd ? K.orientation().sign.data() : nullptr;
  const Tables tables(K);
  with_degree<0, n>(p, [&]<int P>(std::integral_constant<int, P>) {
    with_degree<0, n - P>(q, [&]<int Q>(std::integral_constant<int, Q>) {
      multiply<P, Q>(tables, K.size(P + Q), signs, a.data(), b.data(), y.data());
    });
  });
}

#define DERHAM_INSTANTIATE(n)                                                                                        \
  template void apply_wedge(const SimplicialComplex<n>&, int, std::span<const double>, int, std::span<const double>, \
                            std::span<double>);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
