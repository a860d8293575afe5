#pragma once

#include "derham/boundary/eigen.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/operators/operator.hpp"

#include <concepts>
#include <type_traits>
#include <utility>

namespace derham {

// Expressions in d and ⋆ without degrees: `Operator<Velocity, Pressure> step = -dt * star * d * star`. The degrees follow
// from what the expression is assigned to, or applied to; where they cannot, it does not compile.

namespace detail {
template <class F>
inline constexpr bool is_primal = false;
template <int n, int k>
inline constexpr bool is_primal<PrimalForm<n, k>> = true;
}  // namespace detail

/// d of forms on K of every degree and side, as a part of expressions. K must outlive it.
/// Throws   on dual forms TopologyError if K is not orientable
template <int n>
class Derivative : public Symbol {
 public:
  explicit Derivative(const SimplicialComplex<n>& K) : complex_(&K) {}
  explicit Derivative(SimplicialComplex<n>&&) = delete;

  /// The derivative of forms of type F.
  template <class F>
    requires(F::dimension == n && F::degree < n)
  [[nodiscard]] auto at() const {
    constexpr int k = F::degree;
    using Image = Form<n, k + 1, detail::is_primal<F> ? Side::primal : Side::dual>;
    const auto* const K = complex_;
    if constexpr (detail::is_primal<F>) {
      return Operator<F, Image>(
          *K, *K, [K](auto x, auto y) { apply_coboundary(*K, k, x, y); },
          [K] { return SparseMatrix(to_eigen(coboundary_matrix(*K, k))); });
    } else {
      detail::require_dual_cells(*K);
      constexpr bool minus = (n - k) % 2 != 0;
      return Operator<F, Image>(
          *K, *K, [K](auto x, auto y) { detail::apply_boundary(*K, n - k, minus, x, y, 1); },
          [K] { return SparseMatrix((minus ? -1.0 : 1.0) * to_eigen(boundary_matrix(*K, n - k))); });
    }
  }

  template <int k, Side side>
  [[nodiscard]] auto operator()(const Form<n, k, side>& w) const {
    return d(w);
  }

 private:
  const SimplicialComplex<n>* complex_;
};

namespace detail {

/// ⋆ as a part of expressions.
template <int n>
struct Star {
  const HodgeStar<n>* star;

  template <class F>
    requires(F::dimension == n)
  [[nodiscard]] auto at() const {
    constexpr int k = F::simplex_degree;
    using Image = Form<n, n - F::degree, is_primal<F> ? Side::dual : Side::primal>;
    const auto* const S = star;
    const auto& K = S->complex();
    if constexpr (is_primal<F>) {
      return Operator<F, Image>(
          K, K, [S](auto x, auto y) { S->apply(k, x, y); }, [S] { return diagonal_matrix(S->diagonal(k)); });
    } else {
      constexpr double sign = k * (n - k) % 2 == 0 ? 1 : -1;
      const auto inverse = [S] {
        auto diagonal = S->inverse_diagonal(k);
        for (double& entry : diagonal) entry *= sign;
        return diagonal;
      };
      return Operator<F, Image>(
          K, K,
          [S](auto x, auto y) {
            S->apply_inverse(k, x, y);
            if (sign < 0)
              for (double& value : y) value = -value;
          },
          [inverse] { return diagonal_matrix(inverse()); });
    }
  }
};

/// What composed expressions have in common: they can be applied.
template <class Part>
struct Expression : Symbol {
  template <int n, int k, Side side>
  [[nodiscard]] auto operator()(const Form<n, k, side>& w) const {
    return static_cast<const Part&>(*this).template at<Form<n, k, side>>()(w);
  }
};

/// First A, then B.
template <class B, class A>
struct Composed : Expression<Composed<B, A>> {
  B left;
  A right;
  Composed(B b, A a) : left(std::move(b)), right(std::move(a)) {}
  template <class F>
  [[nodiscard]] auto at() const {
    const auto first = right.template at<F>();
    return left.template at<typename std::decay_t<decltype(first)>::To>() * first;
  }
};

/// A + factor B.
template <class A, class B>
struct Added : Expression<Added<A, B>> {
  A left;
  B right;
  double factor;
  Added(A a, B b, double f) : left(std::move(a)), right(std::move(b)), factor(f) {}
  template <class F>
  [[nodiscard]] auto at() const {
    return left.template at<F>() + factor * right.template at<F>();
  }
};

template <class A>
struct Scaled : Expression<Scaled<A>> {
  double factor;
  A part;
  Scaled(double f, A a) : factor(f), part(std::move(a)) {}
  template <class F>
  [[nodiscard]] auto at() const {
    return factor * part.template at<F>();
  }
};

template <class T>
inline constexpr bool is_operator = false;
template <class From, class To>
inline constexpr bool is_operator<Operator<From, To>> = true;

template <class T>
inline constexpr bool is_symbol = std::derived_from<T, Symbol>;
template <int n>
inline constexpr bool is_symbol<HodgeStar<n>> = true;

}  // namespace detail

/// How an operator or a symbol is kept in an expression: as it is, and a Hodge star by reference.
template <class T>
  requires(detail::is_operator<T> || detail::is_symbol<T>)
[[nodiscard]] const T& operator_part(const T& part) {
  return part;
}
template <int n>
[[nodiscard]] detail::Star<n> operator_part(const HodgeStar<n>& star) {
  return {&star};
}
template <int n>
void operator_part(const HodgeStar<n>&&) = delete;  // a star must outlive the expression

namespace detail {
template <class T>
using Part = std::decay_t<decltype(operator_part(std::declval<T>()))>;

template <class T>
concept SymbolPart = is_symbol<std::remove_cvref_t<T>>;

/// Two parts of which one at least has no degree yet.
template <class A, class B>
concept Symbols = (SymbolPart<A> && (SymbolPart<B> || is_operator<std::remove_cvref_t<B>>)) ||
                  (is_operator<std::remove_cvref_t<A>> && SymbolPart<B>);
}  // namespace detail

/// Composition (first A), sums, differences and multiples of expressions.
template <class B, class A>
  requires detail::Symbols<B, A>
[[nodiscard]] detail::Composed<detail::Part<B>, detail::Part<A>> operator*(B&& b, A&& a) {
  return {operator_part(std::forward<B>(b)), operator_part(std::forward<A>(a))};
}
template <class A, class B>
  requires detail::Symbols<A, B>
[[nodiscard]] detail::Added<detail::Part<A>, detail::Part<B>> operator+(A&& a, B&& b) {
  return {operator_part(std::forward<A>(a)), operator_part(std::forward<B>(b)), 1};
}
template <class A, class B>
  requires detail::Symbols<A, B>
[[nodiscard]] detail::Added<detail::Part<A>, detail::Part<B>> operator-(A&& a, B&& b) {
  return {operator_part(std::forward<A>(a)), operator_part(std::forward<B>(b)), -1};
}
template <detail::SymbolPart A>
[[nodiscard]] detail::Scaled<detail::Part<A>> operator*(double factor, A&& a) {
  return {factor, operator_part(std::forward<A>(a))};
}
template <detail::SymbolPart A>
[[nodiscard]] detail::Scaled<detail::Part<A>> operator-(A&& a) {
  return {-1, operator_part(std::forward<A>(a))};
}

}  // namespace derham
