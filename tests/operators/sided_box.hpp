#pragma once

#include "derham/boundary/boundary_complex.hpp"
#include "derham/operators/boundary_metric.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/tagged_facets.hpp"
#include "operators/spaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

// A box with its sides as tagged parts, and forms with constant derivative on it, for boundary conditions.
namespace derham::test {

/// A box whose sides are parts: "0-" is where coordinate 0 is 0, "0+" where it is largest, ….
template <int n>
MeshData with_sides(MeshData mesh) {
  const SimplicialComplex<n> K(mesh.simplices);
  const auto on_side = [&](Index f, std::size_t axis, double value) {
    for (const Index v : K.simplex(n - 1, f))
      if (std::abs(mesh.points[static_cast<std::size_t>(v) * n + axis] - value) > 1e-12) return false;
    return true;
  };
  if constexpr (n > 1) mesh.lower.resize(n);
  for (std::size_t axis = 0; axis < n; ++axis) {
    double length = 0;
    for (std::size_t v = axis; v < mesh.points.size(); v += n) length = std::max(length, mesh.points[v]);
    for (const double value : {0.0, length}) {
      MeshPart part{
          std::to_string(axis) + (value == 0 ? "-" : "+"), static_cast<std::int64_t>(mesh.parts.size()), n - 1, {}};
      for (Index f = 0; f < K.size(n - 1); ++f) {
        if (!on_side(f, axis, value)) continue;
        if constexpr (n == 1) {
          part.members.push_back(f);
        } else {
          part.members.push_back(static_cast<Index>(mesh.lower[n - 1].size()));
          mesh.lower[n - 1].push_back(K.simplex(n - 1, f));
        }
      }
      mesh.parts.push_back(part);
    }
  }
  return mesh;
}

template <int n>
struct SidedBox : Space<n> {
  explicit SidedBox(const MeshData& unsided) : SidedBox(0, with_sides<n>(unsided)) {}

  struct Side {
    std::vector<Index> facets;
    std::array<double, n> normal;
  };
  BoundaryComplex<n> B;
  Geometry<n - 1> metric;
  std::vector<Side> sides;

 private:
  SidedBox(int, const MeshData& mesh)
      : Space<n>(mesh), B(boundary_complex(this->K)), metric(boundary_geometry(this->K, this->g, B)) {
    for (std::size_t s = 0; s < 2 * static_cast<std::size_t>(n); ++s) {
      sides.push_back({tagged_facets(this->K, mesh, mesh.parts[s]), {}});
      sides.back().normal[s / 2] = s % 2 == 0 ? -1 : 1;
    }
  }
};

/// An alternating form with constant components, those of dx^i ∧ … ∧ dx^j in lexicographic order, of p vectors of R^n.
template <int n, int p>
struct ConstantForm {
  std::vector<double> components;

  [[nodiscard]] double operator()(const std::array<const double*, static_cast<std::size_t>(p)>& vectors) const {
    double sum = 0;
    const auto columns = subsets<p>(n);
    for (std::size_t i = 0; i < columns.size(); ++i) sum += components[i] * minor_of<p>(vectors, columns[i]);
    return sum;
  }

  /// i_X of it, on p-1 vectors given as rows.
  [[nodiscard]] double contracted(const double* X, std::span<const double> rows) const {
    std::array<const double*, static_cast<std::size_t>(p)> vectors{X};
    for (std::size_t i = 1; i < p; ++i) vectors[i] = rows.data() + (i - 1) * n;
    return (*this)(vectors);
  }
};

template <int n, int p>
ConstantForm<n, p> random_constant(std::uint64_t seed) {
  return {support::random_values(static_cast<Offset>(subsets<p>(n).size()), seed)};
}

/// The k-form a + i_x b with constant a and b: du = (k+1) b is constant and u a Whitney form on every simplex, affine for
/// functions, of Nédélec and Raviart and Thomas for fields. On ∂K it has i_ν du = (k+1) i_ν b.
template <int n, int k>
struct KoszulForm {
  ConstantForm<n, k> a = random_constant<n, k>(11);
  ConstantForm<n, k + 1> b = random_constant<n, k + 1>(12);

  /// Itself on a complex of dimension n or n-1.
  template <int N>
  [[nodiscard]] PrimalForm<N, k> on(const SimplicialComplex<N>& K, const Geometry<N>& g) const {
    return DeRhamMap<N>(K, g, 2).template form<k>([this](std::span<const double> x, std::span<const double> rows) {
      std::array<const double*, static_cast<std::size_t>(k)> vectors{};
      for (std::size_t i = 0; i < k; ++i) vectors[i] = rows.data() + i * n;
      return a(vectors) + b.contracted(x.data(), rows);
    });
  }

  /// i_ν du on ∂K for a constant ν.
  [[nodiscard]] PrimalForm<n - 1, k> normal_derivative(const SidedBox<n>& box,
                                                       const std::array<double, n>& normal) const {
    return DeRhamMap<n - 1>(box.B.complex, box.metric, 0)
        .template form<k>([&](std::span<const double>, std::span<const double> rows) {
          return (k + 1) * b.contracted(normal.data(), rows);
        });
  }
};

}  // namespace derham::test
