#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace derham {

/// A k-chain with integer coefficients: a formal sum of positively oriented k-simplices of K, kept as the increasing
/// list of those with a coefficient other than zero. K must outlive the chain.
template <int n, int k>
class Chain {
  static_assert(0 <= k && k <= n, "a chain has a degree between 0 and the dimension of its complex");

 public:
  static constexpr int degree = k;

  struct Term {
    Index simplex;
    std::int64_t coefficient;
    friend bool operator==(const Term&, const Term&) = default;
  };

  /// The zero chain.
  explicit Chain(const SimplicialComplex<n>& K) : complex_(&K) {}

  /// The sum of `terms`, in any order, repeated simplices added up.
  /// Throws   InputError if a simplex is outside [0, |K_k|)
  Chain(const SimplicialComplex<n>& K, std::vector<Term> terms);

  Chain(SimplicialComplex<n>&&) = delete;
  Chain(SimplicialComplex<n>&&, std::vector<Term>) = delete;

  /// Adds coefficient times an oriented simplex given by any alias: (2, 1) counts as minus (1, 2).
  /// Cost     O(s log s) in the number of terms: to build long chains give all terms at once
  /// Throws   InputError if the alias is not in K
  void add(std::span<const Index> alias, std::int64_t coefficient = 1);
  void add(std::initializer_list<Index> alias, std::int64_t coefficient = 1) {
    add(std::span<const Index>(alias.begin(), alias.size()), coefficient);
  }

  /// Coefficient of an alias; 0 if it is not in the chain. Throws InputError if it is not in K.
  [[nodiscard]] std::int64_t operator()(std::initializer_list<Index> alias) const;

  [[nodiscard]] const SimplicialComplex<n>& complex() const noexcept { return *complex_; }
  [[nodiscard]] std::span<const Term> terms() const noexcept { return terms_; }
  [[nodiscard]] bool is_zero() const noexcept { return terms_.empty(); }

  /// Sums and multiples. Throws InputError for chains of different complexes, LimitError where a coefficient exceeds 64 bits.
  Chain& operator+=(const Chain& other);
  Chain& operator-=(const Chain& other);
  Chain& operator*=(std::int64_t factor);
  friend Chain operator+(Chain a, const Chain& b) { return a += b; }
  friend Chain operator-(Chain a, const Chain& b) { return a -= b; }
  friend Chain operator*(std::int64_t factor, Chain a) { return a *= factor; }
  friend Chain operator-(Chain a) { return a *= -1; }
  friend bool operator==(const Chain& a, const Chain& b) { return a.complex_ == b.complex_ && a.terms_ == b.terms_; }

 private:
  void normalize();

  const SimplicialComplex<n>* complex_;
  std::vector<Term> terms_;
};

/// ∂ of a chain, exact. Law: boundary(boundary(c)) is zero.
/// Cost     O(s log s) in the number of terms
/// Source   Elcott & Schröder, "Building your own DEC at home", §4
template <int n, int k>
  requires(k >= 1)
[[nodiscard]] Chain<n, k - 1> boundary(const Chain<n, k>& chain);

/// The sum of all top simplices, positively oriented. On a closed oriented manifold its boundary is zero.
/// Throws   TopologyError if K is not orientable
template <int n>
[[nodiscard]] Chain<n, n> fundamental_chain(const SimplicialComplex<n>& K);

}  // namespace derham
