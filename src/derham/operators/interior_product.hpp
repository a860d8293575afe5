#pragma once

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/dual_wedge.hpp"
#include "derham/forms/exterior_derivative.hpp"
#include "derham/forms/wedge.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/hodge/hodge_star.hpp"
#include "derham/operators/not_flat.hpp"
#include "derham/operators/quadrature.hpp"
#include "derham/operators/whitney_simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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
/// Source   Hirani 2003, lemma 8.2.1
template <int n, int k, Side side, Side other>
  requires(k >= 1 && side != other)
[[nodiscard]] Form<n, k - 1, side> interior_product(const HodgeStar<n>& star, const Form<n, 1, other>& X_flat,
                                                    const Form<n, k, side>& w) {
  auto result = star(wedge(star(w), X_flat));
  if (k * (n - k) % 2 != 0) result *= -1;
  return result;
}

/// Which of the values on the top simplices around a simplex an interior product takes.
enum class Trace : std::uint8_t {
  mean,   ///< their mean, weighted by volume
  upwind  ///< that of the top simplex where X comes from; 0 where X comes in from outside
};

/// The interior product of primal forms with a smooth vector field X: the integrals over the (k-1)-simplices of i_X W w, W
/// the Whitney map, by quadrature. W w jumps across facets; `Trace` says whose value counts. The upwind trace is what stable
/// explicit transport ∂w/∂t = -L_X w needs; on n-forms it is the finite volume flux, which conserves the integral.
///
/// X(x) has the m components of space and is called from several threads; it must be periodic as the mesh is. K and the
/// geometry must outlive it.
/// Maps     primal k-form -> primal (k-1)-form, k >= 1     Units   those of X times w over length
/// Exact    for constant X and w, if the order is 0 or more; upwind not where X comes in through the boundary
/// Invalid  i_X i_X = 0 holds for constants only, in the limit for others; upwind below degree n on curved surfaces in
///          space, where no top simplex around a vertex or edge may be the one that X comes from
/// Cost     C(n, k) ((order/2)+1)^(k-1) evaluations for every pair of a (k-1)-simplex and a top simplex around it
/// Source   Bossavit, "Extrusion, contraction: their discretization via Whitney forms", 2003; Heumann & Hiptmair,
///          "Eulerian and semi-Lagrangian methods for convection-diffusion for differential forms", 2011 (upwind);
///          Mullen et al., "Discrete Lie advection of differential forms", 2011 (finite volumes)
template <int n, class Field>
class InteriorProduct {
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
  /// Throws   InputError if the form belongs to another complex, or a value of X has not m components
  template <int k>
    requires(k >= 1)
  [[nodiscard]] PrimalForm<n, k - 1> operator()(const PrimalForm<n, k>& w) const {
    if (&w.complex() != complex_) throw InputError("the form and the interior product belong to different complexes");
    PrimalForm<n, k - 1> result(*complex_);
    const auto rule = simplex_rule<k - 1>(order_);
    const Incidence tops = incidence(*complex_, k - 1, n);
    parallel_blocks(result.size(), 128, [&](Offset begin, Offset end) {
      Local<k> local(geometry_->coordinate_dimension());
      std::vector<Trial> trials;
      for (auto s = static_cast<Index>(begin); s < end; ++s) {
        trials.clear();
        for (const Index t : tops[s]) try_top<k>(w, s, t, rule, local, trials);
        result[s] = chosen(trials, rule.weights) / static_cast<double>(factorial(k - 1));
      }
    });
    return result;
  }

  /// The largest stable time step of w ← w - dt L_X w with upwind traces, Euler's method: below it no value of a density
  /// (k = n) on a top simplex becomes negative, and no function (k = 0) leaves the range of its neighbours. For the degrees
  /// between it is a guide. Infinite where X = 0.
  /// Units    time: length over that of X
  /// Cost     one pass over the top simplices
  [[nodiscard]] double cfl_bound() const
    requires(n >= 1)
  {
    const auto rule = simplex_rule<n - 1>(order_);
    std::vector<double> rate(static_cast<std::size_t>(complex_->size(n)));
    parallel_blocks(complex_->size(n), 128, [&](Offset begin, Offset end) {
      Local<1> local(geometry_->coordinate_dimension());
      for (auto t = static_cast<Index>(begin); t < end; ++t)
        rate[static_cast<std::size_t>(t)] = leaving_rate(t, rule, local);
    });
    const double fastest = rate.empty() ? 0 : *std::ranges::max_element(rate);
    return fastest > 0 ? 1 / fastest : std::numeric_limits<double>::infinity();
  }

 private:
  /// The value at one node of the rule, in one top simplex; how far X points out of its interior backwards, <= 0 if it comes from it.
  struct Trial {
    double value, upstream, volume;
  };

  /// Room for one top simplex.
  template <int k>
  struct Local {
    explicit Local(int d)
        : whitney(d), frame(d), columns(subsets<k>(d)), components(columns.size()),
          edges(static_cast<std::size_t>(k * d)), x(static_cast<std::size_t>(d)) {}
    detail::WhitneySimplex<n, k> whitney;
    SimplexFrame<n> frame;
    std::vector<std::array<int, static_cast<std::size_t>(k)>> columns;
    std::vector<double> components, edges, x;  // edges: X, then those of the (k-1)-simplex, (k, d)
  };

  /// X at the point of these barycentric coordinates, written to `to`.
  void evaluate_field(const std::array<const double*, n + 1>& corners, const std::array<double, n + 1>& lambda,
                      std::vector<double>& x, double* to) const {
    for (std::size_t c = 0; c < x.size(); ++c) {
      x[c] = 0;
      for (std::size_t v = 0; v <= n; ++v) x[c] += lambda[v] * corners[v][c];
    }
    const auto value = field_(std::span<const double>(x));
    if (value.size() != x.size())
      throw InputError(text("a field of ", value.size(), " components; expected ", x.size()));
    for (std::size_t c = 0; c < x.size(); ++c) to[c] = value[c];
  }

  template <int k, class Rule>
  void try_top(const PrimalForm<n, k>& w, Index s, Index t, const Rule& rule, Local<k>& local,
               std::vector<Trial>& trials) const {
    const auto d = local.x.size();
    const auto corners = geometry_->corners(*complex_, t);
    local.whitney.set(*geometry_, w, t);
    local.frame.set(corners);
    const auto place = places<k>(s, t);
    for (std::size_t i = 1; i < k; ++i)
      for (std::size_t c = 0; c < d; ++c) local.edges[i * d + c] = corners[place[i]][c] - corners[place[0]][c];
    std::array<const double*, static_cast<std::size_t>(k)> rows{};
    for (std::size_t i = 0; i < k; ++i) rows[i] = local.edges.data() + i * d;
    for (const auto& point : rule.points) {
      std::array<double, n + 1> lambda{};
      for (std::size_t i = 0; i < k; ++i) lambda[place[i]] = point[i];
      evaluate_field(corners, lambda, local.x, local.edges.data());
      local.whitney.evaluate(lambda.data(), local.components.data());
      double value = 0;
      for (std::size_t c = 0; c < local.columns.size(); ++c)
        value += local.components[c] * minor_of<k>(rows, local.columns[c]);
      trials.push_back({value, upstream<k>(local, place), local.frame.volume()});
    }
  }

  /// Where the vertices of (k-1)-simplex s are in top simplex t.
  template <int k>
  [[nodiscard]] std::array<std::size_t, static_cast<std::size_t>(k)> places(Index s, Index t) const {
    std::array<std::size_t, static_cast<std::size_t>(k)> result{};
    const auto all = complex_->template simplex<n>(t);
    const auto own = complex_->template simplex<k - 1>(s);
    for (std::size_t i = 0; i < k; ++i)
      result[i] = static_cast<std::size_t>(std::ranges::find(all, own[i]) - all.begin());
    return result;
  }

  /// The largest cosine of X with the ∇λ_v that vanish on s: not positive if X comes from inside.
  template <int k>
  [[nodiscard]] double upstream(const Local<k>& local,
                                const std::array<std::size_t, static_cast<std::size_t>(k)>& place) const {
    const std::size_t d = local.x.size();
    double speed = 0, largest = -1;
    for (std::size_t c = 0; c < d; ++c) speed += local.edges[c] * local.edges[c];
    speed = std::sqrt(speed);
    for (std::size_t v = 0; v <= n; ++v) {
      if (std::ranges::find(place, v) != place.end()) continue;
      double along = 0, square = 0;
      for (const double g : local.frame.gradients()[v]) square += g * g;
      for (std::size_t c = 0; c < d; ++c) along += local.edges[c] * local.frame.gradient(v, c);
      largest = std::max(largest, speed > 0 ? along / (speed * std::sqrt(square)) : 0);
    }
    return largest;
  }

  /// The sum over the rule of the trials, top simplex by top simplex, that the trace takes.
  [[nodiscard]] double chosen(const std::vector<Trial>& trials, const std::vector<double>& weights) const {
    constexpr double parallel = 1e-12;  // a cosine: X runs along the facet
    double result = 0;
    for (std::size_t q = 0; q < weights.size(); ++q) {
      double sum = 0, volume = 0;
      for (std::size_t i = q; i < trials.size(); i += weights.size()) {
        if (trace_ == Trace::upwind && trials[i].upstream > parallel) continue;
        sum += trials[i].volume * trials[i].value;
        volume += trials[i].volume;
      }
      if (volume > 0) result += weights[q] * sum / volume;
    }
    return result;
  }

  /// What leaves top simplex t in a unit of time, relative to what is there; at least X·∇λ_v at its vertices.
  template <class Rule>
  [[nodiscard]] double leaving_rate(Index t, const Rule& rule, Local<1>& local) const {
    const auto corners = geometry_->corners(*complex_, t);
    local.frame.set(corners);
    const auto towards = [&](std::size_t v, const std::array<double, n + 1>& lambda) {
      evaluate_field(corners, lambda, local.x, local.edges.data());
      double along = 0;
      for (std::size_t c = 0; c < local.x.size(); ++c) along += local.edges[c] * local.frame.gradient(v, c);
      return along;
    };
    double leaving = 0, largest = 0;
    for (std::size_t v = 0; v <= n; ++v) {
      std::array<double, n + 1> lambda{};
      lambda[v] = 1;
      largest = std::max(largest, towards(v, lambda));
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        for (std::size_t i = 0, at = 0; i <= n; ++i) lambda[i] = i == v ? 0 : rule.points[q][at++];
        leaving += n * rule.weights[q] * std::max(0.0, -towards(v, lambda));
      }
    }
    return std::max(leaving, largest);
  }

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  Field field_;
  Trace trace_;
  int order_;
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

}  // namespace derham
