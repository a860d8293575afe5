#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/simplex_metric.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/quadrature.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// The de Rham map R: a smooth k-form becomes the form of its integrals over the k-simplices, by a quadrature rule that is
/// exact on polynomials of degree `order` along every simplex. K and the geometry must outlive it.
///
/// Fields are functions of a point, a span of its m coordinates, and are called from several threads at once. Vertices of
/// a mesh given by corners are taken in the chart of the first top simplex, so fields must be periodic as the mesh is.
/// Values of top degree are those on the positively oriented simplex.
/// Law      R(dω) = d(Rω) up to the error of the rule: to round-off for polynomials it is exact on
/// Cost     (order/2 + 1)^k calls for every k-simplex, on all threads; the same bits for any number of them
/// Source   Whitney, "Geometric integration theory", 1957, §IV.27
template <int n>
class DeRhamMap {
 public:
  /// Throws   InputError if the geometry does not belong to K or order < 0; GeometryError if it has no coordinates
  DeRhamMap(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int order)
      : complex_(&K), geometry_(&geometry), order_(order) {
    geometry.require_fits(K);
    if (order < 0) throw InputError(text("a quadrature rule of order ", order, "; orders are 0 and above"));
    if (geometry.source() == MetricSource::lengths)
      throw GeometryError(
          "a field is integrated over simplices in space, but the geometry has edge lengths only; "
          "give positions");
  }
  DeRhamMap(SimplicialComplex<n>&&, const Geometry<n>&, int) = delete;
  DeRhamMap(const SimplicialComplex<n>&, Geometry<n>&&, int) = delete;

  [[nodiscard]] int order() const noexcept { return order_; }

  /// A function f(x) as 0-form: its values at the vertices, whatever the order.
  template <class F>
  [[nodiscard]] PrimalForm<n, 0> function(F&& f) const {
    return integrals<0>([&f](Index, Edges<0>) { return [&f](Point x) -> double { return f(x); }; });
  }

  /// A density f(x) as n-form: f dx^1 ∧ … ∧ dx^n if m = n, so that d(flux(X)) is that of div X; otherwise f times the
  /// volume form of K's own orientation.
  /// Throws   TopologyError if m > n and K is not orientable
  template <class F>
  [[nodiscard]] PrimalForm<n, n> density(F&& f) const {
    const int m = geometry_->ambient_dimension();
    if (m > n && !complex_->is_orientable())
      throw TopologyError(
          "a density is a form of top degree only on an orientable complex; this one has a one-sided "
          "cycle (see orientation().one_sided)");
    return integrals<n>([&f, m, this](Index t, Edges<n> edges) {
      const double volume = m == n ? minor_of<n>(edges.rows, columns()) : complex_->sign(n, t) * edges.content(m);
      return [&f, volume](Point x) -> double { return volume * f(x); };
    });
  }

  /// A vector field X(x) of m components as 1-form: ∫ X·dl along every edge.
  /// Throws   InputError if a value of X does not have m components
  template <class F>
    requires(n >= 1)
  [[nodiscard]] PrimalForm<n, 1> circulation(F&& X) const {
    return components<1>(std::forward<F>(X));
  }

  /// A vector field X(x) of m = n components as (n-1)-form i_X(dx^1 ∧ … ∧ dx^n): its flux through every facet, to the side
  /// from which (X, edges) is positive.
  /// Throws   InputError as above; GeometryError unless m = n
  template <class F>
    requires(n >= 1)
  [[nodiscard]] PrimalForm<n, n - 1> flux(F&& X) const {
    if (geometry_->ambient_dimension() != n)
      throw GeometryError(text("the flux of a vector field needs a complex of the dimension of space; this one has ", n,
                               " in space of ", geometry_->ambient_dimension()));
    return integrals<n - 1>([&X](Index, Edges<n - 1> edges) {
      return [&X, edges](Point x) {
        const auto& value = X(x);
        require_components(value.size(), n);
        std::array<double, n> first{};
        for (std::size_t c = 0; c < n; ++c) first[c] = value[c];
        std::array<const double*, n> rows{first.data()};
        std::ranges::copy(edges.rows, rows.begin() + 1);
        return minor_of<n>(rows, columns());
      };
    });
  }

  /// A k-form given by its values ω(x, edges) on k vectors at a point; `edges` has shape (k, m) row-major. It must be
  /// multilinear and antisymmetric in them.
  template <int k, class F>
  [[nodiscard]] PrimalForm<n, k> form(F&& w) const {
    const auto width = static_cast<std::size_t>(geometry_->ambient_dimension());
    return integrals<k>([&w, width](Index, Edges<k> edges) {
      const std::span<const double> values(edges.data, k * width);
      return [&w, values](Point x) -> double { return w(x, values); };
    });
  }

  /// A k-form given by its C(m, k) components ω(x), those of dx^i ∧ … ∧ dx^j with i < … < j in lexicographic order.
  /// Throws   InputError if a value of ω does not have C(m, k) components
  template <int k, class F>
  [[nodiscard]] PrimalForm<n, k> components(F&& w) const {
    const auto columns = subsets<k>(geometry_->ambient_dimension());
    return integrals<k>([&](Index, Edges<k> edges) {
      return [&w, &columns, edges](Point x) {
        const auto& value = w(x);
        require_components(value.size(), columns.size());
        double sum = 0;
        for (std::size_t i = 0; i < columns.size(); ++i) sum += value[i] * minor_of<k>(edges.rows, columns[i]);
        return sum;
      };
    });
  }

  /// The points where fields are evaluated for k-forms, for who evaluates many at a time.
  /// Shape    (|K_k|, nodes of the rule, m) row-major
  template <int k>
  [[nodiscard]] std::vector<double> nodes() const {
    const auto rule = simplex_rule<k>(order_);
    const auto m = static_cast<std::size_t>(geometry_->ambient_dimension());
    const std::size_t size = rule.points.size() * m;
    std::vector<double> result(static_cast<std::size_t>(complex_->size(k)) * size);
    parallel_blocks(complex_->size(k), 256, [&](Offset begin, Offset end) {
      for (auto i = static_cast<Index>(begin); i < end; ++i) {
        const auto corners = geometry_->template corners<k>(*complex_, i);
        double* const first = result.data() + static_cast<std::size_t>(i) * size;
        for (std::size_t q = 0; q < rule.points.size(); ++q) place<k>(rule.points[q], corners, {first + q * m, m});
      }
    });
    return result;
  }

  /// As `components`, of a field given by its values at the nodes: the same bits.
  /// Shape    values (|K_k|, nodes of the rule, C(m, k)) row-major
  /// Throws   InputError on another number of values
  template <int k>
  [[nodiscard]] PrimalForm<n, k> components_at_nodes(std::span<const double> values) const {
    const auto columns = subsets<k>(geometry_->ambient_dimension());
    const std::size_t nodes = simplex_rule<k>(order_).points.size(), width = columns.size();
    const std::size_t expected = static_cast<std::size_t>(complex_->size(k)) * nodes * width;
    if (values.size() != expected)
      throw InputError(text(values.size(), " values at nodes; expected ", expected, ", ", complex_->size(k), " times ",
                            nodes, " times ", width));
    return integrals<k>([&](Index i, Edges<k> edges) {
      const double* next = values.data() + static_cast<std::size_t>(i) * nodes * width;
      return [&columns, edges, next](Point) mutable {
        double sum = 0;
        for (const auto& column : columns) sum += *next++ * minor_of<k>(edges.rows, column);
        return sum;
      };
    });
  }

 private:
  using Point = std::span<const double>;

  /// The edges of a k-simplex from its first corner.
  template <int k>
  struct Edges {
    const double* data;  // (k, m)
    std::array<const double*, static_cast<std::size_t>(k)> rows;

    /// k! volume in R^m.
    [[nodiscard]] double content(int m) const {
      std::vector<double> used_up(data, data + k * m);
      const double unit = normalize(used_up);  // squares stay in the range of doubles
      TriangularMatrix<k> r;
      triangularize<k>(used_up.data(), m, r);
      double product = 1;
      for (std::size_t i = 0; i < k; ++i) product *= r[i][i] * unit;
      return product;
    }
  };

  static constexpr std::array<int, n> columns() noexcept {
    std::array<int, n> all{};
    for (std::size_t c = 0; c < n; ++c) all[c] = static_cast<int>(c);
    return all;
  }

  static void require_components(std::size_t given, std::size_t expected) {
    if (given != expected) throw InputError(text("a field of ", given, " components; expected ", expected));
  }

  /// The point x with these barycentric coordinates.
  template <int k>
  static void place(const typename SimplexRule<k>::Point& barycentric,
                    const std::array<const double*, static_cast<std::size_t>(k) + 1>& corners, std::span<double> x) {
    for (std::size_t c = 0; c < x.size(); ++c) {
      x[c] = 0;
      for (std::size_t v = 0; v <= k; ++v) x[c] += barycentric[v] * corners[v][c];
    }
  }

  /// `on_simplex(i, edges)` gives the function of a point whose mean over simplex i, divided by k!, is the integral.
  template <int k, class OnSimplex>
  [[nodiscard]] PrimalForm<n, k> integrals(OnSimplex&& on_simplex) const {
    const auto rule = simplex_rule<k>(order_);
    const auto m = static_cast<std::size_t>(geometry_->ambient_dimension());
    PrimalForm<n, k> result(*complex_);
    parallel_blocks(result.size(), 256, [&](Offset begin, Offset end) {
      std::vector<double> edges(k * m + 1), x(m);
      Edges<k> rows{edges.data(), {}};
      for (std::size_t e = 0; e < k; ++e) rows.rows[e] = edges.data() + e * m;
      for (auto i = static_cast<Index>(begin); i < end; ++i) {
        const auto corners = geometry_->template corners<k>(*complex_, i);
        for (std::size_t e = 0; e < k; ++e)
          for (std::size_t c = 0; c < m; ++c) edges[e * m + c] = corners[e + 1][c] - corners[0][c];
        auto value = on_simplex(i, rows);  // called once for every node, in their order
        double mean = 0;
        for (std::size_t q = 0; q < rule.points.size(); ++q) {
          place<k>(rule.points[q], corners, x);
          mean += rule.weights[q] * value(Point(x));
        }
        result[i] = complex_->sign(k, i) * mean / static_cast<double>(factorial(k));
      }
    });
    return result;
  }

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  int order_;
};

}  // namespace derham
