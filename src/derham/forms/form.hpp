#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/core/types.hpp"

#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// Which complex a form lives on: the simplices, or the dual cells.
enum class Side : std::uint8_t { primal, dual };

/// A discrete k-form on an oriented n-complex K (a cochain): one number per k-simplex (primal) or per dual k-cell
/// (dual), the integral of the form over it. The dual k-cells are counted by the primal (n-k)-simplices they are dual
/// to. Degree and side are part of the type, so that operators cannot be composed wrongly. K must outlive the form.
///
/// Shape    values (|K_k|,) for primal, (|K_{n-k}|,) for dual forms; top simplices are positively oriented
/// Source   Elcott & Schröder, "Building your own DEC at home", §3.1, §6.2
template <int n, int k, Side side = Side::primal>
class Form {
  static_assert(0 <= k && k <= n, "a form has a degree between 0 and the dimension of its complex");

 public:
  static constexpr int dimension = n;
  static constexpr int degree = k;
  /// Degree of the simplices that index the values.
  static constexpr int simplex_degree = side == Side::primal ? k : n - k;

  /// The zero form.
  explicit Form(const SimplicialComplex<n>& K)
      : complex_(&K), values_(static_cast<std::size_t>(K.size(simplex_degree))) {}

  /// Throws InputError if the number of values is not that of the simplices.
  Form(const SimplicialComplex<n>& K, std::vector<double> values) : complex_(&K), values_(std::move(values)) {
    if (values_.size() != static_cast<std::size_t>(K.size(simplex_degree)))
      throw InputError(text("a form of degree ", k, " needs ", K.size(simplex_degree), " values, one per ",
                            simplex_degree, "-simplex, and was given ", values_.size()));
  }

  Form(SimplicialComplex<n>&&) = delete;
  Form(SimplicialComplex<n>&&, std::vector<double>) = delete;

  [[nodiscard]] const SimplicialComplex<n>& complex() const noexcept { return *complex_; }
  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(values_.size()); }
  [[nodiscard]] std::span<const double> values() const noexcept { return values_; }
  [[nodiscard]] std::span<double> values() noexcept { return values_; }
  [[nodiscard]] double operator[](Index i) const noexcept { return values_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double& operator[](Index i) noexcept { return values_[static_cast<std::size_t>(i)]; }

  /// The value on a simplex given by any alias, with the alias's sign: w({j, i}) = -w({i, j}).
  /// Throws   InputError if the alias is not a k-simplex of K
  /// Source   Elcott & Schröder, §3.2
  [[nodiscard]] double operator()(std::initializer_list<Index> alias) const
    requires(side == Side::primal)
  {
    if (alias.size() != static_cast<std::size_t>(k) + 1)
      throw InputError(text("an alias of ", alias.size(), " vertices; a ", k, "-form is evaluated on ", k + 1));
    const SignedIndex found = complex_->at(alias);
    return found.sign * (*this)[found.index];
  }

  /// Sums and multiples. Throws InputError for forms of different complexes.
  Form& operator+=(const Form& other) { return add(other, 1); }
  Form& operator-=(const Form& other) { return add(other, -1); }
  Form& operator*=(double factor) {
    for (double& value : values_) value *= factor;
    return *this;
  }
  Form& operator/=(double divisor) {
    for (double& value : values_) value /= divisor;
    return *this;
  }
  friend Form operator+(Form a, const Form& b) { return std::move(a += b); }
  friend Form operator-(Form a, const Form& b) { return std::move(a -= b); }
  friend Form operator*(double factor, Form a) { return std::move(a *= factor); }
  friend Form operator*(Form a, double factor) { return std::move(a *= factor); }
  friend Form operator/(Form a, double divisor) { return std::move(a /= divisor); }
  friend Form operator-(Form a) { return std::move(a *= -1); }
  friend bool operator==(const Form& a, const Form& b) { return a.complex_ == b.complex_ && a.values_ == b.values_; }

 private:
  Form& add(const Form& other, double factor) {
    if (complex_ != other.complex_) throw InputError("the forms belong to different complexes");
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += factor * other.values_[i];
    return *this;
  }

  const SimplicialComplex<n>* complex_;
  std::vector<double> values_;
};

template <int n, int k>
using PrimalForm = Form<n, k, Side::primal>;
template <int n, int k>
using DualForm = Form<n, k, Side::dual>;

}  // namespace derham
