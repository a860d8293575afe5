#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/forms/form.hpp"
#include "derham/operators/linear_map.hpp"

#include <array>
#include <span>
#include <vector>

namespace derham {

/// The primal forms that are prescribed on a part Γ of K: 0 there, those of the relative complex (K, Γ), or with data. What
/// is on Γ is essential (Dirichlet for functions, no tangential part for 1-forms, no flux for (n-1)-forms); on the rest of
/// the boundary the natural conditions of the dual derivative hold, with the data of `boundary_load`. K must outlive it.
/// Law      d takes forms that vanish on Γ to such forms
/// Source   Hatcher, "Algebraic topology", §2.1 (relative chains); Arnold, Falk, Winther 2006, §2 (the forms)
template <int n>
class FormSpace {
 public:
  /// All forms: nothing is prescribed (absolute).
  explicit FormSpace(const SimplicialComplex<n>& K) : FormSpace(K, {}) {}

  /// Γ is the closure of these facets: those of `tagged_facets`, or any, inside of K too.
  /// Cost     linear in the number of simplices
  /// Throws   InputError unless facets are in [0, |K_{n-1}|)
  FormSpace(const SimplicialComplex<n>& K, std::span<const Index> facets);

  /// Γ is the whole boundary: the facets with one coface (relative).
  [[nodiscard]] static FormSpace relative(const SimplicialComplex<n>& K);
  static FormSpace relative(SimplicialComplex<n>&&) = delete;

  FormSpace(SimplicialComplex<n>&&) = delete;
  FormSpace(SimplicialComplex<n>&&, std::span<const Index>) = delete;

  [[nodiscard]] const SimplicialComplex<n>& complex() const noexcept { return *complex_; }

  /// The k-simplices that are not in Γ, increasing: the unknowns; and those in Γ.
  /// Throws   InputError unless 0 <= k <= n
  [[nodiscard]] std::span<const Index> free(int k) const&;
  [[nodiscard]] std::span<const Index> prescribed(int k) const&;
  void free(int) const&& = delete;
  void prescribed(int) const&& = delete;

  /// Eᵀw: the values on the free simplices.
  /// Shape    (|free(k)|,)
  template <int k>
  [[nodiscard]] std::vector<double> restricted(const PrimalForm<n, k>& w) const {
    require_same(w.complex());
    std::vector<double> result;
    for (const Index i : free(k)) result.push_back(w[i]);
    return result;
  }

  /// E x + the part of `data` on Γ: the form with these values on the free simplices.
  /// Throws   InputError on a wrong length or for data of another complex
  template <int k>
  [[nodiscard]] PrimalForm<n, k> extended(std::span<const double> x, PrimalForm<n, k> data) const {
    require_same(data.complex());
    require_length(k, x.size());
    for (std::size_t i = 0; i < x.size(); ++i) data[free(k)[i]] = x[i];
    return data;
  }

  /// E x: with 0 on Γ.
  template <int k>
  [[nodiscard]] PrimalForm<n, k> extended(std::span<const double> x) const {
    return extended(x, PrimalForm<n, k>(*complex_));
  }

  /// E as a matrix: extension by zero. d, a mass, dᵀ⋆d or Robin terms A are E_jᵀ A E_k on these forms, and a system A x = b with
  /// data g becomes EᵀAE x = Eᵀ(b - A g). Not so what has a δ inside: weak_laplace_de_rham(star, space, k).
  /// Shape    |K_k| × |free(k)|
  [[nodiscard]] SparseMatrix extension(int k) const;

 private:
  void require_degree(int k) const;
  void require_same(const SimplicialComplex<n>& K) const;
  void require_length(int k, std::size_t length) const;

  const SimplicialComplex<n>* complex_;
  std::array<std::vector<Index>, n + 1> free_, prescribed_;
};

extern template class FormSpace<1>;
extern template class FormSpace<2>;
extern template class FormSpace<3>;
extern template class FormSpace<4>;

}  // namespace derham
