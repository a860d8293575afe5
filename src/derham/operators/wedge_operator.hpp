#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/core/parallel.hpp"
#include "derham/forms/dual_wedge.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/operators/expression.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace derham {

namespace detail {

template <class A, class B>
concept Wedgeable = requires(const A& a, const B& b) { wedge(a, b); };

/// a ∧ b, or b ∧ a for a function b that has a product in this order only.
template <class A, class B>
[[nodiscard]] auto wedge_in_some_order(const A& a, const B& b) {
  if constexpr (Wedgeable<A, B>)
    return wedge(a, b);
  else
    return wedge(b, a);
}

[[nodiscard]] inline SparseMatrix matrix_of_terms(Index rows, Index columns, const WedgeTerms& terms) {
  return matrix_of_rows(rows, columns, [&](Index i, auto&& add) {
    const auto row = static_cast<std::size_t>(i);
    for (auto j = static_cast<std::size_t>(terms.offsets[row]); j < static_cast<std::size_t>(terms.offsets[row + 1]);
         ++j)
      add(terms.index[j], terms.weight[j]);
  });
}

/// y_i = x_i times the mean of the function `f`, primal or dual, about k-simplex i.
template <bool primal, int n>
void scale_by_means(const SimplicialComplex<n>& K, int k, std::span<const double> f, std::span<const double> x,
                    std::span<double> y) {
  if constexpr (primal)
    scale_by_vertex_means(K, k, f, x, y);
  else
    scale_by_top_means(K, k, f, x, y);
}

/// The matrix of f -> y of that.
template <bool primal, int k, int n>
[[nodiscard]] SparseMatrix matrix_of_means(const SimplicialComplex<n>& K, std::span<const double> x) {
  if constexpr (!primal) require_tops_about_all(K);
  const Incidence about = incidence(K, k, primal ? 0 : n);
  return matrix_of_rows(K.size(k), K.size(primal ? 0 : n), [&](Index i, auto&& add) {
    for (const Index j : about[i]) add(j, x[static_cast<std::size_t>(i)] / static_cast<double>(about[i].size()));
  });
}

}  // namespace detail

/// a -> a ∧ b with a fixed form b, as a part of expressions, for every kind of forms a that has a wedge product with b. The
/// complex must outlive it.
/// Matrix   of primal forms C(p+q+1, p+1) entries a row
/// Throws   as the products; of dual 1-forms when the operator is made
template <int n, int q, Side side>
class WedgeWith : public Symbol {
 public:
  using Factor = Form<n, q, side>;
  explicit WedgeWith(Factor b) : factor_(std::make_shared<const Factor>(std::move(b))) {}

  template <class F>
    requires(detail::Wedgeable<F, Factor> || (q == 0 && detail::Wedgeable<Factor, F>))
  [[nodiscard]] auto at() const {
    if constexpr (detail::is_primal<F> && detail::is_primal<Factor>)
      return of_primal<F>();
    else if constexpr (F::degree == 1 && q == 1)
      return of_dual_polygons<F>();
    else if constexpr (F::degree == 0 && detail::Wedgeable<F, Factor>)
      return of_functions<F>();
    else
      return by_a_function<F>();
  }

  /// a ∧ b.
  template <int p, Side s>
  [[nodiscard]] auto operator()(const Form<n, p, s>& a) const {
    return detail::wedge_in_some_order(a, *factor_);
  }

 private:
  template <class F>
  using Map =
      Operator<F, decltype(detail::wedge_in_some_order(std::declval<const F&>(), std::declval<const Factor&>()))>;

  template <class F>
  [[nodiscard]] Map<F> of_primal() const {
    constexpr int p = F::degree;
    const auto& K = factor_->complex();
    return {K, K, [b = factor_](auto x, auto y) { apply_wedge(b->complex(), p, x, q, b->values(), y); },
            [b = factor_] {
              const auto& L = b->complex();
              return detail::matrix_of_terms(L.size(p + q), L.size(p), wedge_terms(L, p, q, b->values()));
            }};
  }

  template <class F>
  [[nodiscard]] Map<F> of_dual_polygons() const {
    const auto& K = factor_->complex();
    const SparseMatrix A = detail::matrix_of_terms(K.size(0), K.size(1), wedge_terms(*factor_));
    return {K, K, [A](auto x, auto y) { detail::multiply(A, x, y); }, [A] { return A; }};
  }

  /// Functions times the factor.
  template <class F>
  [[nodiscard]] Map<F> of_functions() const {
    constexpr bool primal = detail::is_primal<F>;
    constexpr int k = Factor::simplex_degree;
    const auto& K = factor_->complex();
    return {K, K, [b = factor_](auto x, auto y) { detail::scale_by_means<primal>(b->complex(), k, x, b->values(), y); },
            [b = factor_] { return detail::matrix_of_means<primal, k>(b->complex(), b->values()); }};
  }

  /// Times the factor, which is a function.
  template <class F>
  [[nodiscard]] Map<F> by_a_function() const {
    constexpr int k = F::simplex_degree;
    const auto& K = factor_->complex();
    const auto scale = [b = factor_](std::span<const double> x, std::span<double> y) {
      detail::scale_by_means<detail::is_primal<Factor>>(b->complex(), k, b->values(), x, y);
    };
    return {K, K, scale, [scale, size = static_cast<std::size_t>(K.size(k))] {
              std::vector<double> ones(size, 1.0), means(size);
              scale(ones, means);
              return detail::diagonal_matrix(means);
            }};
  }

  std::shared_ptr<const Factor> factor_;
};

}  // namespace derham
