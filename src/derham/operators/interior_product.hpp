#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/kept.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/operators/contraction_row.hpp"
#include "derham/operators/expression.hpp"
#include "derham/operators/inflow.hpp"
#include "derham/operators/leaving_rate.hpp"
#include "derham/operators/not_flat.hpp"
#include "derham/operators/wedge_operator.hpp"

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// The algebraic interior product i_X w = (-1)^(k(n-k)) ⋆(⋆w ∧ X♭) of a k-form, for X♭ of the other side: dual k-forms of
/// every degree with a primal X♭; primal n-forms, and 1-forms in the plane, with a dual X♭, for which there are wedge
/// products. Others do not compile.
///
/// Maps     k-form -> (k-1)-form of the same side   Units   those of X times w over length
/// Laws     of dual forms: i_X i_X w = 0 where X♭ and ⋆w are closed, for then their wedge product is associative
/// Exact    on dual forms for constant X and w; on primal n-forms of constant density; on primal 1-forms in the plane on
///          lattices of equilateral triangles, as dual polygons do not know their shape
/// Throws   GeometryError naming simplices whose dual volume is zero; InputError for forms of different complexes
/// Source   Hirani 2003, chapter 8
template <int n, int k, Side side, Side other>
  requires(k >= 1 && side != other)
[[nodiscard]] Form<n, k - 1, side> interior_product(const HodgeStar<n>& star, const Form<n, 1, other>& X_flat,
                                                    const Form<n, k, side>& w) {
  auto result = star(wedge(star(w), X_flat));
  if (k * (n - k) % 2 != 0) result *= -1;
  return result;
}

/// The same as a part of expressions, on all the forms that it takes. The star and the complex must outlive it.
template <int n, Side other>
class AlgebraicInteriorProduct : public Symbol {
 public:
  AlgebraicInteriorProduct(const HodgeStar<n>& star, Form<n, 1, other> X_flat)
      : star_(&star), X_flat_(std::move(X_flat)) {}
  AlgebraicInteriorProduct(HodgeStar<n>&&, Form<n, 1, other>) = delete;

  template <class F>
    requires(F::dimension == n && F::degree >= 1 && detail::is_primal<F> == (other == Side::dual))
  [[nodiscard]] auto at() const {
    constexpr double sign = F::degree * (n - F::degree) % 2 == 0 ? 1 : -1;
    return (sign * (*star_ * X_flat_ * *star_)).template at<F>();
  }

  /// i_X w.
  template <int k, Side side>
  [[nodiscard]] auto operator()(const Form<n, k, side>& w) const {
    return at<Form<n, k, side>>()(w);
  }

 private:
  const HodgeStar<n>* star_;
  WedgeWith<n, 1, other> X_flat_;
};

/// Source   as above
template <int n, Side other>
[[nodiscard]] AlgebraicInteriorProduct<n, other> interior_product(const HodgeStar<n>& star,
                                                                  const Form<n, 1, other>& X_flat) {
  return {star, X_flat};
}

/// The interior product of primal forms with a smooth vector field X: the integrals over the (k-1)-simplices of i_X W w, W
/// the Whitney map, by quadrature. W w jumps across facets; `Trace` says whose value counts. The upwind trace is what stable
/// explicit transport ∂w/∂t = -L_X w needs; on n-forms it is the finite volume flux, which conserves the integral.
///
/// A part of expressions: `Operator<PrimalForm<n, k>, PrimalForm<n, k - 1>> A = i_X` has a matrix, made in one pass.
///
/// X(x) has the m components of space and is called from several threads; it must be periodic as the mesh is. K and the
/// geometry must outlive it.
/// Maps     primal k-form -> primal (k-1)-form, k >= 1     Units   those of X times w over length
/// Exact    for constant X and w, if the order is 0 or more; upwind not where X comes in through the boundary
/// Upwind   takes the top simplex with the smallest largest X·∇λ_v of the vertices v outside of the (k-1)-simplex, as a
///          part of what flows through. Not positive where X comes from that simplex. Positive on walls of a convex
///          domain and on curved surfaces: there the nearest is taken. 0 only if it is above 0.001 and X comes in through
///          a boundary facet around, in the mean, with more than 0.001 of what flows through its top simplex; for k = n,
///          if X comes from neither side
/// Invalid  i_X i_X = 0 holds for constants only, in the limit for others
/// Cost     C(n, k) ((order/2)+1)^(k-1) evaluations for every pair of a (k-1)-simplex and a top simplex around it. The
///          first call of a degree makes the table of these pairs and finds where X comes in; kept, also by copies
/// Source   Bossavit, "Extrusion, contraction: their discretization via Whitney forms", 2003; Heumann & Hiptmair,
///          "Eulerian and semi-Lagrangian methods for convection-diffusion for differential forms", 2011 (upwind);
///          Mullen et al., "Discrete Lie advection of differential forms", 2011 (finite volumes)
template <int n, class Field>
class InteriorProduct : public Symbol {
 public:
  /// Throws   InputError if the geometry does not belong to K or order < 0; TopologyError unless K is pure; GeometryError
  ///          naming flat top simplices, or if there are edge lengths only
  InteriorProduct(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Field X, Trace trace, int order)
      : complex_(&K), geometry_(&geometry), field_(std::move(X)), trace_(trace), order_(order) {
    geometry.require_fits(K);
    if (order < 0) throw InputError(text("a quadrature rule of order ", order, "; orders are 0 and above"));
    if (geometry.source() == MetricSource::lengths)
      throw GeometryError("a vector field in space needs positions, but the geometry has edge lengths only");
    if (!K.is_pure()) throw TopologyError("an interior product, but some simplices are in no top simplex");
    detail::require_not_flat(K, geometry);
  }
  InteriorProduct(SimplicialComplex<n>&&, const Geometry<n>&, Field, Trace, int) = delete;
  InteriorProduct(const SimplicialComplex<n>&, Geometry<n>&&, Field, Trace, int) = delete;

  /// i_X w.
  /// Throws   InputError if the form belongs to another complex, or a value of X has not m components or is not finite
  template <int k>
    requires(k >= 1)
  [[nodiscard]] PrimalForm<n, k - 1> operator()(const PrimalForm<n, k>& w) const {
    if (&w.complex() != complex_) throw InputError("the form and the interior product belong to different complexes");
    PrimalForm<n, k - 1> result(*complex_);
    apply<k>(w.values(), result.values());
    return result;
  }

  /// On primal k-forms, k >= 1.
  template <class F>
    requires(F::dimension == n && F::degree >= 1 && detail::is_primal<F>)
  [[nodiscard]] auto at() const {
    constexpr int k = F::degree;
    const auto i_X = std::make_shared<const InteriorProduct>(*this);
    return Operator<F, PrimalForm<n, k - 1>>(
        *complex_, *complex_, [i_X](auto x, auto y) { i_X->template apply<k>(x, y); },
        [i_X] { return i_X->template matrix<k>(); });
  }

  /// The largest stable time step of w ← w - dt L_X w with upwind traces, Euler's method: below it no value of a density
  /// (k = n) on a top simplex becomes negative, and no function (k = 0) leaves the range of its neighbours. For the degrees
  /// between it is a guide. Infinite where X = 0. Functions keep their range where X comes from a top simplex or from
  /// outside; at walls and on curved surfaces they may leave it and, in long runs, grow.
  /// Units    time: length over that of X
  /// Cost     one pass over the top simplices
  /// Throws   InputError naming a top simplex where a value of X has not m components or is not finite
  [[nodiscard]] double cfl_bound() const
    requires(n >= 1)
  {
    const double fastest = detail::largest_leaving_rate(*complex_, *geometry_, field_, order_);
    return fastest > 0 ? 1 / fastest : std::numeric_limits<double>::infinity();
  }

 private:
  /// What stands around the simplices of one degree.
  struct Surroundings {
    Incidence tops;
    std::vector<char> entered;  // detail::inflow, or empty if nobody asks

    [[nodiscard]] bool enters(Index s) const { return !entered.empty() && entered[static_cast<std::size_t>(s)]; }
  };

  template <int k>
  [[nodiscard]] const Surroundings& around() const {
    return (*around_)[k - 1].get([this] {
      Surroundings result{incidence(*complex_, k - 1, n), {}};
      if (trace_ == Trace::upwind && k < n)
        result.entered = detail::inflow<n, k - 1>(*complex_, *geometry_, field_, order_);
      return result;
    });
  }

  template <int k>
  void apply(std::span<const double> w, std::span<double> y) const {
    const Surroundings& surroundings = around<k>();
    parallel_blocks(complex_->size(k - 1), 128, [&](Offset begin, Offset end) {
      detail::ContractionRow<n, k> contraction(*complex_, *geometry_, trace_, order_);
      for (auto s = static_cast<Index>(begin); s < end; ++s) {
        double sum = 0;
        for (const auto& [simplex, weight] : contraction.of(field_, s, surroundings.tops[s], surroundings.enters(s)))
          sum += weight * w[static_cast<std::size_t>(simplex)];
        y[static_cast<std::size_t>(s)] = sum;
      }
    });
  }

  template <int k>
  [[nodiscard]] SparseMatrix matrix() const {
    const Surroundings& surroundings = around<k>();
    detail::ContractionRow<n, k> contraction(*complex_, *geometry_, trace_, order_);
    return detail::matrix_of_rows(complex_->size(k - 1), complex_->size(k), [&](Index s, auto&& add) {
      for (const auto& [simplex, weight] : contraction.of(field_, s, surroundings.tops[s], surroundings.enters(s)))
        add(simplex, weight);
    });
  }

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  Field field_;
  Trace trace_;
  int order_;
  std::shared_ptr<std::array<Kept<Surroundings>, n>> around_ = std::make_shared<std::array<Kept<Surroundings>, n>>();
};

/// L_X w = d i_X w + i_X dw, for an interior product i_X of any kind: Cartan's formula is the definition, so that
/// d L_X = L_X d whatever i_X is, and the integral of L_X w over a closed M is zero for n-forms.
/// Exact    as i_X is: L_X f = X·∇f; of constant forms along constant fields 0
/// Throws   what i_X and d throw
template <class Contraction, int n, int k, Side side>
[[nodiscard]] Form<n, k, side> lie_derivative(const Contraction& i_X, const Form<n, k, side>& w) {
  if constexpr (k == 0) {
    return i_X(d(w));
  } else if constexpr (k == n) {
    return d(i_X(w));
  } else {
    return d(i_X(w)) + i_X(d(w));
  }
}

/// The same as a part of expressions.
template <int n, class Contraction>
class LieDerivative : public Symbol {
 public:
  LieDerivative(const Derivative<n>& d, Contraction i_X) : d_(d), i_X_(std::move(i_X)) {}

  template <class F>
  [[nodiscard]] auto at() const {
    if constexpr (F::degree == 0) {
      return (i_X_ * d_).template at<F>();
    } else if constexpr (F::degree == n) {
      return (d_ * i_X_).template at<F>();
    } else {
      return (d_ * i_X_ + i_X_ * d_).template at<F>();
    }
  }

  /// L_X w.
  template <int k, Side side>
  [[nodiscard]] Form<n, k, side> operator()(const Form<n, k, side>& w) const {
    return at<Form<n, k, side>>()(w);
  }

 private:
  Derivative<n> d_;
  Contraction i_X_;
};

/// L_X = d i_X + i_X d of forms of every degree, for expressions: transport by Euler's method is
/// `Operator<Density, Density> step = identity<Density>(K) - dt * lie_derivative(d, i_X)`.
template <int n, class Contraction>
  requires detail::is_symbol<Contraction>
[[nodiscard]] LieDerivative<n, Contraction> lie_derivative(const Derivative<n>& d, const Contraction& i_X) {
  return {d, i_X};
}

}  // namespace derham
