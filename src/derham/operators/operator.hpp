#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/form.hpp"
#include "derham/operators/linear_map.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <utility>

namespace derham {

/// What stands in expressions for operators on several kinds of forms, as d does (expression.hpp), derives from this and has a
/// member `at<From>()`, the Operator on forms of type From, only for those types that it takes.
struct Symbol {};

/// A linear map of discrete forms: `Operator<PrimalForm<3, 1>, PrimalForm<3, 2>> curl`. Made from functions, from
/// expressions in d and ⋆ (see expression.hpp), or by composition `B * A` (first A), sums and multiples, which compile only
/// if the degrees and sides fit. The complexes, and what the functions refer to, must outlive it; copies are cheap.
///
/// Cost     applied matrix-free: that of its parts, and a vector for every product and sum
template <class Domain, class Codomain>
class Operator {
 public:
  using From = Domain;
  using To = Codomain;
  using FromComplex = SimplicialComplex<From::dimension>;
  using ToComplex = SimplicialComplex<To::dimension>;

  /// y = A x, given values; it must overwrite y and may run at the same time in several threads.
  using Apply = std::function<void(std::span<const double> x, std::span<double> y)>;
  /// Its matrix. When it is left out, the matrix is made by feeding the identity, column by column.
  using Assemble = std::function<SparseMatrix()>;

  Operator(const FromComplex& from, const ToComplex& to, Apply apply, Assemble assemble = {})
      : Operator(from, to,
                 detail::linear_map(From(from).size(), To(to).size(), std::move(apply), std::move(assemble))) {}

  /// What an expression means on forms of type From (expression.hpp); it must end in forms of type To.
  template <class Expression>
    requires(!std::same_as<std::remove_cvref_t<Expression>, Operator>) && requires(Expression&& expression) {
      {
        operator_part(std::forward<Expression>(expression)).template at<Domain>()
      } -> std::same_as<Operator<Domain, Codomain>>;
    }
  Operator(Expression&& expression)  // NOLINT(*-explicit-constructor,*-reference-overload): as a formula is written
      : Operator(operator_part(std::forward<Expression>(expression)).template at<From>()) {}

  /// A w.
  /// Throws   InputError if the form is of another complex; and what the parts throw
  [[nodiscard]] To operator()(const From& w) const {
    if (&w.complex() != from_) throw InputError("the form and the operator belong to different complexes");
    To result(*to_);
    map_->apply(w.values(), result.values());
    return result;
  }

  /// The matrix, composed from those of the parts. Made at the first call and kept, also by copies.
  /// Shape    (|To|,) × (|From|,), rows compressed
  [[nodiscard]] const SparseMatrix& matrix() const { return map_->matrix(); }

  /// The same map, applied by its matrix: faster than long compositions that are applied often.
  [[nodiscard]] Operator assembled() const { return Operator(*from_, *to_, detail::by_matrix(map_)); }

  [[nodiscard]] const FromComplex& from() const noexcept { return *from_; }
  [[nodiscard]] const ToComplex& to() const noexcept { return *to_; }

  /// First A, then B.
  /// Throws   InputError unless B begins on the complex where A ends
  template <class Start>
  friend Operator<Start, To> operator*(const Operator& B, const Operator<Start, From>& A) {
    if (&A.to() != &B.from()) throw InputError("the operators belong to different complexes");
    return Operator<Start, To>(A.from(), B.to(), detail::product(B.map_, A.map()));
  }
  friend Operator operator+(const Operator& A, const Operator& B) { return combination(A, 1, B); }
  friend Operator operator-(const Operator& A, const Operator& B) { return combination(A, -1, B); }
  friend Operator operator*(double factor, const Operator& A) {
    return Operator(*A.from_, *A.to_, detail::multiple(factor, A.map_));
  }
  friend Operator operator*(const Operator& A, double factor) { return factor * A; }
  friend Operator operator-(const Operator& A) { return -1.0 * A; }

  // For the operators above.
  Operator(const FromComplex& from, const ToComplex& to, std::shared_ptr<const detail::LinearMap> map)
      : from_(&from), to_(&to), map_(std::move(map)) {}
  [[nodiscard]] const std::shared_ptr<const detail::LinearMap>& map() const noexcept { return map_; }

  /// Itself, as a part of an expression: only on what it maps from.
  template <std::same_as<From> F>
  [[nodiscard]] const Operator& at() const {
    return *this;
  }

 private:
  static Operator combination(const Operator& A, double factor, const Operator& B) {
    if (A.from_ != B.from_ || A.to_ != B.to_) throw InputError("the operators belong to different complexes");
    return Operator(*A.from_, *A.to_, detail::sum(A.map_, factor, B.map_));
  }

  const FromComplex* from_;
  const ToComplex* to_;
  std::shared_ptr<const detail::LinearMap> map_;
};

namespace detail {
template <class F>
struct DualOf;
template <int n, int k, Side side>
struct DualOf<Form<n, k, side>> {
  using Type = Form<n, n - k, side == Side::primal ? Side::dual : Side::primal>;
};
}  // namespace detail

/// Forms of the complementary degree on the other side: those that `pair` pairs with forms of type F by Σ a_i b_i.
template <class F>
using DualOf = typename detail::DualOf<F>::Type;

/// Aᵀ between the dual spaces: Σ (A u)_i v_i = Σ u_i (Aᵀ v)_i. Applied by its matrix, made at the first call.
template <class From, class To>
[[nodiscard]] Operator<DualOf<To>, DualOf<From>> transposed(const Operator<From, To>& A) {
  return {A.to(), A.from(), detail::transposed_map(A.map())};
}

/// The identity on forms of one kind.
template <class F>
[[nodiscard]] Operator<F, F> identity(const SimplicialComplex<F::dimension>& K) {
  return Operator<F, F>(K, K, detail::identity_map(F(K).size()));
}
template <class F>
void identity(const SimplicialComplex<F::dimension>&&) = delete;

}  // namespace derham
