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

/// How often the values on a front and a back face are counted.
template <int p, int q>
constexpr double terms = static_cast<double>(factorial(p + q + 1)) / static_cast<double>(factorial(p) * factorial(q));

/// The value of a ∧ b on one sorted simplex; a and b give the values on its faces, by their masks.
template <int p, int q, class A, class B>
[[gnu::always_inline]] inline double product(A&& a, B&& b) {
  constexpr unsigned whole = full_mask<p + q>;
  double sum = 0;
  for_each_mask<p + q>([&]<unsigned front>() {
    if constexpr (mask_degree(front) == p) sum += a.template operator()<front>() * back_sum<front, whole>(b);
  });
  return sum / terms<p, q>;
}

/// The row of i in the face table of degree k.
struct FaceRow {
  const Tables& K;
  template <int k>
  [[gnu::always_inline]] const Index* operator()(Index i) const noexcept {
    return K.faces[k] + static_cast<Offset>(i) * (k + 1);
  }
};

/// Where the value on a face of m-simplex i is in its form.
template <unsigned mask, int m>
[[gnu::always_inline]] inline Index place(const Tables& K, Offset i, const FaceArray<m, Index>& face) noexcept {
  if constexpr (mask_degree(mask) == 0)
    return K.simplices[m][i * (m + 1) + std::countr_zero(mask)];
  else
    return face[mask];
}

template <int p, int q>
void multiply(const Tables& K, Offset simplices, const Sign* signs, const double* __restrict a,
              const double* __restrict b, double* __restrict y) {
  constexpr int m = p + q;
  parallel_blocks(simplices, grain, [=](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) {
      const auto face = local_faces<m>(static_cast<Index>(i), FaceRow{K});
      const double wedge = product<p, q>([&]<unsigned mask>() { return a[place<mask, m>(K, i, face)]; },
                                         [&]<unsigned mask>() { return b[place<mask, m>(K, i, face)]; });
      y[i] = detail::negated_if(signs != nullptr && signs[i] < 0, wedge);
    }
  });
}

/// `index` and `weight` (simplices, C(p+q+1, p+1)).
template <int p, int q>
void weigh(const Tables& K, Offset simplices, const Sign* signs, const double* b, Index* index, double* weight) {
  constexpr int m = p + q;
  parallel_blocks(simplices, grain, [=](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) {
      const auto face = local_faces<m>(static_cast<Index>(i), FaceRow{K});
      Offset at = i * binomial(m + 1, p + 1);
      for_each_mask<m>([&]<unsigned front>() {
        if constexpr (mask_degree(front) == p) {
          const double sum =
              back_sum<front, full_mask<m>>([&]<unsigned mask>() { return b[place<mask, m>(K, i, face)]; });
          index[at] = place<front, m>(K, i, face);
          weight[at++] = detail::negated_if(signs != nullptr && signs[i] < 0, sum / terms<p, q>);
        }
      });
    }
  });
}

/// Values of top degree refer to the positive orientation: one sign for each of a, b and a ∧ b that has that degree.
template <int n>
const Sign* signs_of_product(const SimplicialComplex<n>& K, int p, int q) {
  const bool odd = ((p == n) + (q == n) + (p + q == n)) % 2 != 0;
  return odd ? K.orientation().sign.data() : nullptr;
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
  const Sign* const signs = signs_of_product(K, p, q);
  const Tables tables(K);
  with_degree<0, n>(p, [&]<int P>(std::integral_constant<int, P>) {
    with_degree<0, n - P>(q, [&]<int Q>(std::integral_constant<int, Q>) {
      multiply<P, Q>(tables, K.size(P + Q), signs, a.data(), b.data(), y.data());
    });
  });
}

template <int n>
WedgeTerms wedge_terms(const SimplicialComplex<n>& K, int p, int q, std::span<const double> b) {
  detail::require_degree(n, p, 0, n);
  detail::require_degree(n, q, 0, n - p);
  detail::require_shape("b", b.size(), K.size(q), 1);
  const Sign* const signs = signs_of_product(K, p, q);
  const Tables tables(K);
  const Offset rows = K.size(p + q), width = binomial(p + q + 1, p + 1);
  WedgeTerms result{std::vector<Offset>(static_cast<std::size_t>(rows) + 1),
                    std::vector<Index>(static_cast<std::size_t>(rows * width)),
                    std::vector<double>(static_cast<std::size_t>(rows * width))};
  for (Offset i = 0; i <= rows; ++i) result.offsets[static_cast<std::size_t>(i)] = i * width;
  with_degree<0, n>(p, [&]<int P>(std::integral_constant<int, P>) {
    with_degree<0, n - P>(q, [&]<int Q>(std::integral_constant<int, Q>) {
      weigh<P, Q>(tables, rows, signs, b.data(), result.index.data(), result.weight.data());
    });
  });
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                                        \
  template void apply_wedge(const SimplicialComplex<n>&, int, std::span<const double>, int, std::span<const double>, \
                            std::span<double>);                                                                      \
  template WedgeTerms wedge_terms(const SimplicialComplex<n>&, int, int, std::span<const double>);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
