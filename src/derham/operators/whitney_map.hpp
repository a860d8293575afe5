#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/operators/whitney_simplex.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace derham {

/// A point of a top simplex of K: its barycentric coordinates, in the order of the sorted representative.
template <int n>
struct BarycentricPoint {
  Index simplex = -1;  ///< -1: no point of K
  std::array<double, static_cast<std::size_t>(n) + 1> barycentric{};
};

/// The Whitney map W: a discrete k-form becomes the piecewise linear k-form with these integrals. K and the geometry must
/// outlive it.
///
/// On a top simplex, W w = Σ_σ w(σ) W_σ over its k-faces, W_σ = k! Σ_i (-1)^i λ_i dλ_0 ∧ … ∧ omitted dλ_i ∧ … ∧ dλ_k.
/// Values are components in R^d, d the geometry's coordinate_dimension(): those of dx^i ∧ … ∧ dx^j with i < … < j in
/// lexicographic order, C(d, k) of them; 1-forms so are vectors, see also `flux_vectors`. On a surface in space they are
/// tangential; with edge lengths only they are in the frame of every top simplex itself, that of geometry.corners().
/// Laws     R(W w) = w; d(W w) = W(d w); constant forms are reproduced at every point
/// Valid    across facets only the part that can be evaluated on tangent vectors of the facet is continuous: all of a
///          0-form, the tangential part of a 1-form, the normal part of a flux, nothing of an n-form
/// Source   Whitney, "Geometric integration theory", 1957, §IV.27
template <int n>
class WhitneyMap {
 public:
  /// Cost     one look at every top simplex
  /// Throws   InputError if the geometry does not belong to K; GeometryError naming flat top simplices
  WhitneyMap(const SimplicialComplex<n>& K, const Geometry<n>& geometry);
  WhitneyMap(SimplicialComplex<n>&&, const Geometry<n>&) = delete;
  WhitneyMap(const SimplicialComplex<n>&, Geometry<n>&&) = delete;

  /// The components at points, a row of NaN where there is no simplex (-1). On all threads, same bits always.
  /// Shape    (points, C(d, k)) row-major             Units   those of the integrals over length^k
  /// Throws   InputError if the form belongs to another complex, or if a simplex is not in K
  template <int k>
  [[nodiscard]] std::vector<double> at(const PrimalForm<n, k>& w, std::span<const BarycentricPoint<n>> points) const {
    for (const auto& point : points)
      if (point.simplex < -1 || point.simplex >= complex_->size(n))
        throw InputError(text("a point in top simplex ", point.simplex, "; there are ", complex_->size(n)));
    return values(w, static_cast<Offset>(points.size()),
                  [points](Offset i) { return points[static_cast<std::size_t>(i)]; });
  }

  /// The components at one point of top simplex t.
  /// Shape    (C(d, k),)
  template <int k>
  [[nodiscard]] std::vector<double> at(const PrimalForm<n, k>& w, const BarycentricPoint<n>& point) const {
    return at(w, std::span(&point, 1));
  }

  /// The components at the barycentre of every top simplex.
  /// Shape    (|K_n|, C(d, k)) row-major
  template <int k>
  [[nodiscard]] std::vector<double> at_barycenters(const PrimalForm<n, k>& w) const {
    BarycentricPoint<n> center;
    center.barycentric.fill(1.0 / (n + 1));
    return values(w, complex_->size(n), [center](Offset t) mutable {
      center.simplex = static_cast<Index>(t);
      return center;
    });
  }

 private:
  template <int k, class PointOf>
  [[nodiscard]] std::vector<double> values(const PrimalForm<n, k>& w, Offset count, const PointOf& point_of) const {
    if (&w.complex() != complex_) throw InputError("the form and the Whitney map belong to different complexes");
    const auto width = static_cast<std::size_t>(binomial(geometry_->coordinate_dimension(), k));
    std::vector<double> result(static_cast<std::size_t>(count) * width, std::numeric_limits<double>::quiet_NaN());
    parallel_blocks(count, 512, [&](Offset begin, Offset end) {
      detail::WhitneySimplex<n, k> local(geometry_->coordinate_dimension());
      auto point = point_of;
      for (Offset i = begin; i < end; ++i) {
        const BarycentricPoint<n> x = point(i);
        if (x.simplex < 0) continue;
        local.set(*geometry_, w, x.simplex);
        local.evaluate(x.barycentric.data(), result.data() + static_cast<std::size_t>(i) * width);
      }
    });
    return result;
  }

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
};

extern template class WhitneyMap<0>;
extern template class WhitneyMap<1>;
extern template class WhitneyMap<2>;
extern template class WhitneyMap<3>;
extern template class WhitneyMap<4>;

/// The vectors X with i_X(dx^1 ∧ … ∧ dx^m) = ω, for rows of the m components of (m-1)-forms of R^m: what DeRhamMap::flux takes.
/// Shape    (points, m) row-major
/// Throws   InputError unless m >= 1 divides the number of components
[[nodiscard]] std::vector<double> flux_vectors(std::span<const double> components, int m);

}  // namespace derham
