#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/hodge/star_kind.hpp"

#include <span>
#include <vector>

namespace derham {

/// The diagonal Hodge star of every degree: where metric meets topology. K must outlive it.
///
/// star[i] = vol(dual cell of simplex i) / vol(simplex i), signed: the integral density of a form is kept. The dual cells are
/// circumcentric, or of another StarKind. A material, a number a_T for every top simplex T, weighs the part of every dual cell
/// in T with a_T, in every degree: for k = 1 as conductances side by side, for k = n-1 as resistances in a row.
/// Maps     primal k-form -> dual (n-k)-form        Shape   (|K_k|,) the diagonal
/// Matrix   diagonal; all entries positive iff no dual volume is zero or negative (see dual_report)
/// Units    length^(n-2k), times the material's
/// Source   Elcott & Schröder, "Building your own DEC at home", §6.2; Hirani 2003, chapter 4
template <int n>
class HodgeStar {
 public:
  /// Cost     one pass over the top simplices
  /// Throws   TopologyError if K is not orientable (names a one-sided cycle); GeometryError if a top simplex is
  ///          degenerate or an entry out of the range of doubles (names it)
  HodgeStar(const SimplicialComplex<n>& K, const Geometry<n>& geometry);
  HodgeStar(SimplicialComplex<n>&&, const Geometry<n>&) = delete;

  /// The star of a kind: `HodgeStar<3>(K, geometry, PowerCircumcentric{weights}, material)`.
  /// Cost     that of the dual volumes: power_dual, barycentric_dual_volumes; for Circumcentric{} without a material as above
  /// Throws   as above; InputError if weights or material do not fit, or the material holds tensors
  HodgeStar(const SimplicialComplex<n>& K, const Geometry<n>& geometry, StarKind kind, const Material& material = {});
  HodgeStar(SimplicialComplex<n>&&, const Geometry<n>&, StarKind, const Material& = {}) = delete;

  [[nodiscard]] const SimplicialComplex<n>& complex() const noexcept { return *complex_; }
  [[nodiscard]] const StarKind& kind() const noexcept { return kind_; }
  [[nodiscard]] const Material& material() const noexcept { return material_; }

  /// The diagonal of degree k, shape (|K_k|,). Throws InputError unless 0 <= k <= n, and k is 0 or n if the star is lumped.
  [[nodiscard]] std::span<const double> diagonal(int k) const;

  /// 1/star[i], shape (|K_k|,). Throws GeometryError naming the k-simplices whose dual volume is zero.
  [[nodiscard]] std::vector<double> inverse_diagonal(int k) const;

  /// y = ⋆_k x: each value times its entry of the diagonal. On several threads, same bits always.
  /// Shape    x, y (|K_k|, columns) row-major; y may be x
  /// Throws   InputError unless 0 <= k <= n and columns >= 1, or on a wrong length
  void apply(int k, std::span<const double> x, std::span<double> y, Index columns = 1) const;

  /// y = ⋆_k^-1 x: each value times the inverse of its entry.
  /// Shape    as above
  /// Throws   as above; GeometryError naming the k-simplices whose dual volume is zero, and then y is not meaningful
  void apply_inverse(int k, std::span<const double> x, std::span<double> y, Index columns = 1) const {
    apply_inverse(k, false, x, y, columns);
  }

  /// ⋆ of a primal k-form.
  /// Throws   InputError if the form belongs to another complex
  template <int k>
  [[nodiscard]] Form<n, n - k, Side::dual> operator()(const Form<n, k, Side::primal>& w) const {
    require_same(w.complex());
    Form<n, n - k, Side::dual> result(*complex_);
    apply(k, w.values(), result.values());
    return result;
  }

  /// ⋆ of a dual j-form: with k = n-j, the primal k-form (-1)^(k(n-k)) ⋆_k^-1 w. Hence ⋆⋆ = (-1)^(k(n-k)).
  /// Throws   GeometryError naming simplices whose dual volume is zero; InputError as above
  template <int j>
  [[nodiscard]] Form<n, n - j, Side::primal> operator()(const Form<n, j, Side::dual>& w) const {
    return inverse(w, j * (n - j) % 2 != 0);
  }

  /// ⋆_k^-1 of a dual (n-k)-form, without the sign of the dual -> primal star: inverse(⋆w) = w.
  /// Throws   as above
  template <int j>
  [[nodiscard]] Form<n, n - j, Side::primal> inverse(const Form<n, j, Side::dual>& w) const {
    return inverse(w, false);
  }

 private:
  template <int j>
  [[nodiscard]] Form<n, n - j, Side::primal> inverse(const Form<n, j, Side::dual>& w, bool minus) const {
    require_same(w.complex());
    Form<n, n - j, Side::primal> result(*complex_);
    apply_inverse(n - j, minus, w.values(), result.values(), 1);
    return result;
  }

  void require_same(const SimplicialComplex<n>& K) const {
    if (&K != complex_) throw InputError("the form and the Hodge star belong to different complexes");
  }

  /// y = -⋆_k^-1 x when `minus`.
  void apply_inverse(int k, bool minus, std::span<const double> x, std::span<double> y, Index columns) const;

  const SimplicialComplex<n>* complex_;
  StarKind kind_;
  Material material_;
  ByDegree<n> diagonal_;
};

extern template class HodgeStar<0>;
extern template class HodgeStar<1>;
extern template class HodgeStar<2>;
extern template class HodgeStar<3>;
extern template class HodgeStar<4>;

}  // namespace derham
