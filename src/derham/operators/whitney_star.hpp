#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/material.hpp"
#include "derham/operators/operator.hpp"
#include "derham/operators/whitney_mass.hpp"

#include <Eigen/SparseCore>

#include <concepts>
#include <memory>
#include <span>

namespace derham {

/// A symmetric positive definite matrix with its Cholesky factor, which is made once and serves any number of solutions. Copies
/// share both.
class MassInverse {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /// Cost     a sparse factorisation with minimum degree ordering; for a solid the factor is much larger than the matrix
  /// Throws   InputError unless the matrix is square; GeometryError if it is not positive definite
  /// Source   Eigen's SimplicialLLT
  explicit MassInverse(const Matrix& matrix);

  [[nodiscard]] const Matrix& matrix() const noexcept;

  /// y = M x and y = M⁻¹ x.
  /// Shape    x, y (rows, columns) row-major; y may be x
  /// Throws   InputError on a wrong length, or unless columns >= 1
  void apply(std::span<const double> x, std::span<double> y, Index columns = 1) const;
  void apply_inverse(std::span<const double> x, std::span<double> y, Index columns = 1) const;

 private:
  struct Factored;
  std::shared_ptr<const Factored> factored_;
};

/// The Hodge star of k-forms that the Whitney mass is, with its inverse by factorisation. K must outlive it.
/// Maps     primal k-form -> dual (n-k)-form, as HodgeStar does, with whitney_mass in place of the diagonal
/// Matrix   symmetric, positive definite on every mesh
/// A part of expressions on these two kinds of forms; the matrix of the inverse is made column by column, and dense.
/// Law      star(star(w)) = (-1)^(k(n-k)) w up to rounding times the condition
template <int n, int k>
class WhitneyStar : public Symbol {
 public:
  using Primal = Form<n, k, Side::primal>;
  using Dual = Form<n, n - k, Side::dual>;

  /// Cost     assembly and factorisation
  /// Throws   as whitney_mass; TopologyError if K is not orientable; GeometryError naming a top simplex whose material
  ///          is not positive
  WhitneyStar(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const Material& material = {})
      : complex_(&require_orientable(K)), mass_(whitney_mass(K, geometry, k, require_sound(material, K, geometry))) {}
  WhitneyStar(SimplicialComplex<n>&&, const Geometry<n>&, const Material& = {}) = delete;

  [[nodiscard]] const SimplicialComplex<n>& complex() const noexcept { return *complex_; }
  [[nodiscard]] const MassInverse& mass() const noexcept { return mass_; }

  /// ⋆ of a primal k-form. Throws InputError if the form belongs to another complex.
  [[nodiscard]] Dual operator()(const Primal& w) const {
    require_same(w.complex());
    Dual result(*complex_);
    mass_.apply(w.values(), result.values());
    return result;
  }

  /// ⋆ of a dual (n-k)-form, (-1)^(k(n-k)) M⁻¹ w. Throws as above.
  [[nodiscard]] Primal operator()(const Dual& w) const {
    Primal result = inverse(w);
    if constexpr (k * (n - k) % 2 != 0)
      for (double& value : result.values()) value = -value;
    return result;
  }

  /// M⁻¹ of a dual (n-k)-form, without the sign: inverse(⋆w) = w. Throws as above.
  [[nodiscard]] Primal inverse(const Dual& w) const {
    require_same(w.complex());
    Primal result(*complex_);
    mass_.apply_inverse(w.values(), result.values());
    return result;
  }

  template <std::same_as<Primal> F>
  [[nodiscard]] Operator<Primal, Dual> at() const {
    return {*complex_, *complex_, [mass = mass_](auto x, auto y) { mass.apply(x, y); },
            [mass = mass_] { return mass.matrix(); }};
  }
  template <std::same_as<Dual> F>
  [[nodiscard]] Operator<Dual, Primal> at() const {
    constexpr double sign = k * (n - k) % 2 == 0 ? 1 : -1;
    return sign *
           Operator<Dual, Primal>(*complex_, *complex_, [mass = mass_](auto x, auto y) { mass.apply_inverse(x, y); });
  }

 private:
  static const Material& require_sound(const Material& material, const SimplicialComplex<n>& K,
                                       const Geometry<n>& geometry) {
    require_fits(material, K, geometry);
    require_positive(material, K);
    return material;
  }
  static const SimplicialComplex<n>& require_orientable(const SimplicialComplex<n>& K) {
    if (!K.is_orientable())
      throw TopologyError(
          "a Hodge star between primal and dual forms needs an orientable complex; use whitney_mass alone");
    return K;
  }
  void require_same(const SimplicialComplex<n>& K) const {
    if (&K != complex_) throw InputError("the form and the Hodge star belong to different complexes");
  }

  const SimplicialComplex<n>* complex_;
  MassInverse mass_;
};

}  // namespace derham
