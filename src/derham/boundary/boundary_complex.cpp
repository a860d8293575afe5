#include "derham/boundary/boundary_complex.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>

namespace derham {

template <int n>
  requires(n >= 1)
BoundaryComplex<n> boundary_complex(const SimplicialComplex<n>& K) {
  if (!K.is_pure()) {
    const auto [k, i] = K.maximal_lower().front();
    throw TopologyError(text("simplex ", tuple_text(K.simplex(k, i)), " is in no ", n,
                             "-simplex; the boundary is defined for pure complexes only. Remove it first"));
  }
  const FacetCofaces dual = facet_cofaces(K);
  std::vector<Index> facets;
  for (Index f = 0; f < K.size(n - 1); ++f)
    if (dual.count[static_cast<std::size_t>(f)] == 1) facets.push_back(f);

  BoundaryComplex<n> result;
  auto& vertices = result.inclusion[0];
  for (const Index f : facets) vertices.insert(vertices.end(), K.simplex(n - 1, f).begin(), K.simplex(n - 1, f).end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  // Each row is written in the order that K's orientation induces; coherence makes every row positive.
  std::vector<Index> rows;
  for (const Index f : facets) {
    const Index t = dual.first[static_cast<std::size_t>(f)];
    const auto across = K.faces(n, t);
    const auto j = static_cast<int>(std::ranges::find(across, f) - across.begin());
    const auto begin = static_cast<std::ptrdiff_t>(rows.size());
    for (const Index v : K.simplex(n - 1, f))
      rows.push_back(static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin()));
    if (n >= 2 && K.sign(n, t) * face_sign(n - j) < 0)
      std::iter_swap(rows.begin() + begin, rows.begin() + begin + (n >= 2 ? 1 : 0));
  }
  result.complex = SimplicialComplex<n - 1>(SimplexList(n - 1, std::move(rows)), static_cast<Index>(vertices.size()));

  std::array<Index, static_cast<std::size_t>(n)> tuple{};
  for (int k = 1; k < n; ++k) {
    for (Index i = 0; i < result.complex.size(k); ++i) {
      const auto simplex = result.complex.simplex(k, i);
      std::ranges::transform(simplex, tuple.begin(), [&](Index v) { return vertices[static_cast<std::size_t>(v)]; });
      result.inclusion[static_cast<std::size_t>(k)].push_back(
          K.find(std::span<const Index>(tuple.data(), simplex.size())).index);
    }
  }
  return result;
}

template BoundaryComplex<1> boundary_complex(const SimplicialComplex<1>&);
template BoundaryComplex<2> boundary_complex(const SimplicialComplex<2>&);
template BoundaryComplex<3> boundary_complex(const SimplicialComplex<3>&);
template BoundaryComplex<4> boundary_complex(const SimplicialComplex<4>&);
template BoundaryComplex<5> boundary_complex(const SimplicialComplex<5>&);
template BoundaryComplex<6> boundary_complex(const SimplicialComplex<6>&);

}  // namespace derham
