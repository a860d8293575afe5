#include "derham/forms/dual_wedge.hpp"

#include "derham/boundary/rings.hpp"
#include "derham/boundary/stencil.hpp"
#include "derham/complex/local_faces.hpp"
#include "derham/core/parallel.hpp"

#include <algorithm>
#include <vector>

namespace derham {
namespace {

constexpr Offset grain = 1 << 13;  // simplices per block of a parallel loop

std::size_t index(Index i) { return static_cast<std::size_t>(i); }

/// Calls f(t, i) for every top simplex t and every k-face i of it, t increasing.
template <int n, int k, class F>
void for_faces_of_tops(const SimplicialComplex<n>& K, F&& f) {
  for (Index t = 0; t < K.size(n); ++t) {
    const auto face = face_indices(K, t);
    for_each_mask<n>([&]<unsigned mask>() {
      if constexpr (mask_degree(mask) == k) f(t, face[mask]);
    });
  }
}

/// The sides of the dual polygon of a vertex, counter-clockwise, and whether each is oriented so. Empty at the boundary.
struct PolygonSide {
  Index edge;
  double sign;
};

/// The edge that two triangles about vertex v share.
Index shared_edge(const SimplicialComplex<2>& K, Index v, Index left, Index right) {
  for (const Index e : K.faces<2>(left)) {
    const auto ends = K.simplex<1>(e);
    if (ends[0] != v && ends[1] != v) continue;
    for (const Index other : K.faces<2>(right))
      if (other == e) return e;
  }
  return -1;
}

/// Whether the positively oriented triangle t is (v, …, w): then who goes about v counter-clockwise leaves t across vw.
bool ends_with(const SimplicialComplex<2>& K, Index t, Index v, Index w) {
  const auto corner = K.simplex<2>(t);
  Index third = corner[0];
  for (const Index c : corner)
    if (c != v && c != w) third = c;
  return K.at({v, third, w}).sign > 0;
}

std::vector<PolygonSide> dual_polygon(const SimplicialComplex<2>& K, const Rings<2>& rings, Index v) {
  const Ring ring = rings.ring(v);
  std::vector<PolygonSide> sides;
  if (!ring.closed) return sides;
  bool counter_clockwise = true;
  for (std::size_t i = 0; i < ring.tops.size(); ++i) {
    const Index e = shared_edge(K, v, ring.tops[i], ring.tops[(i + 1) % ring.tops.size()]);
    const auto ends = K.simplex<1>(e);
    const bool first = ends[0] == v;
    // A dual edge crosses its edge from the right to the left: counter-clockwise about the edge's first end.
    sides.push_back({e, first ? 1.0 : -1.0});
    counter_clockwise = ends_with(K, ring.tops[i], v, first ? ends[1] : ends[0]);
  }
  if (!counter_clockwise) std::ranges::reverse(sides);
  return sides;
}

/// What a ∧ b weighs the value of a on side i of a polygon with.
double side_weight(std::span<const PolygonSide> sides, std::size_t i, const Form<2, 1, Side::dual>& b) {
  const std::size_t m = sides.size();
  const auto value = [&](std::size_t j) { return sides[j % m].sign * b[sides[j % m].edge]; };
  double sum = 0;
  for (std::size_t s = 1; 2 * s < m; ++s)
    sum += (0.5 - static_cast<double>(s) / static_cast<double>(m)) * (value(i + s) - value(i + m - s));
  return sides[i].sign * sum;
}

}  // namespace

template <int n>
void detail::scale_by_vertex_means(const SimplicialComplex<n>& K, int k, std::span<const double> f,
                                   std::span<const double> x, std::span<double> y) {
  with_degree<0, n>(k, [&]<int m>(std::integral_constant<int, m>) {
    parallel_blocks(K.size(m), grain, [&](Offset first, Offset last) {
      for (auto i = static_cast<Index>(first); i < last; ++i) {
        double sum = 0;
        for (const Index v : K.template simplex<m>(i)) sum += f[index(v)];
        y[index(i)] = sum / (m + 1) * x[index(i)];
      }
    });
  });
}

template <int n>
void detail::scale_by_top_means(const SimplicialComplex<n>& K, int k, std::span<const double> g,
                                std::span<const double> x, std::span<double> y) {
  require_tops_about_all(K);
  std::vector<double> sum(y.size());
  std::vector<Index> tops(y.size());
  with_degree<0, n>(k, [&]<int m>(std::integral_constant<int, m>) {
    for_faces_of_tops<n, m>(K, [&](Index t, Index i) {
      sum[index(i)] += g[index(t)];
      ++tops[index(i)];
    });
  });
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = sum[i] / static_cast<double>(tops[i]) * x[i];
}

Form<2, 2, Side::dual> wedge(const Form<2, 1, Side::dual>& a, const Form<2, 1, Side::dual>& b) {
  if (&a.complex() != &b.complex()) throw InputError("the forms belong to different complexes");
  const WedgeTerms terms = wedge_terms(b);
  Form<2, 2, Side::dual> result(a.complex());
  for (Index v = 0; v < result.size(); ++v)
    for (auto j = static_cast<std::size_t>(terms.offsets[index(v)]);
         j < static_cast<std::size_t>(terms.offsets[index(v) + 1]); ++j)
      result[v] += terms.weight[j] * a[terms.index[j]];
  return result;
}

WedgeTerms wedge_terms(const Form<2, 1, Side::dual>& b) {
  const auto& K = b.complex();
  if (!K.is_orientable())
    throw TopologyError("the complex is not orientable, so its dual cells have no coherent orientation");
  const Rings<2> rings(K);
  WedgeTerms result;
  result.offsets.push_back(0);
  for (Index v = 0; v < K.size(0); ++v) {
    const auto sides = dual_polygon(K, rings, v);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      result.index.push_back(sides[i].edge);
      result.weight.push_back(side_weight(sides, i, b));
    }
    result.offsets.push_back(static_cast<Offset>(result.index.size()));
  }
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                            \
  template void detail::scale_by_vertex_means(const SimplicialComplex<n>&, int, std::span<const double>, \
                                              std::span<const double>, std::span<double>);               \
  template void detail::scale_by_top_means(const SimplicialComplex<n>&, int, std::span<const double>,    \
                                           std::span<const double>, std::span<double>);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
