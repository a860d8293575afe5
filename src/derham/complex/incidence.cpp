#include "derham/complex/incidence.hpp"

#include "derham/complex/transposed_table.hpp"
#include "derham/core/cancel.hpp"
#include "derham/core/error.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"

#include <algorithm>

namespace derham {
namespace {

/// Rows of `width` indices become columns; rows of the result are increasing because they are filled in order.
Incidence transposed(std::span<const Index> table, Offset width, Index columns) {
  Incidence result;
  result.offsets.resize(static_cast<std::size_t>(columns) + 1);
  reserve_large(result.indices, table.size());
  result.indices.resize(table.size());
  detail::transpose_table<Offset>(table, static_cast<std::size_t>(width), result.offsets, result.indices,
                                  [](Index row, std::size_t) { return row; });
  return result;
}

/// The C(k+1, m+1) faces of dimension m of every k-simplex: faces of faces, each once.
template <int n>
Incidence downward(const SimplicialComplex<n>& K, int k, int m) {
  const auto width = static_cast<std::size_t>(binomial(k + 1, m + 1));
  Incidence result;
  result.offsets.resize(static_cast<std::size_t>(K.size(k)) + 1);
  for (std::size_t i = 0; i < result.offsets.size(); ++i) result.offsets[i] = static_cast<Offset>(i * width);
  result.indices.reserve(static_cast<std::size_t>(K.size(k)) * width);
  std::vector<Index> current, next;
  for (Index i = 0; i < K.size(k); ++i) {
    if (i % 1024 == 0) poll_cancel();
    current.assign(1, i);
    for (int degree = k; degree > m; --degree) {
      next.clear();
      for (const Index s : current) {
        const auto faces = K.faces(degree, s);
        next.insert(next.end(), faces.begin(), faces.end());
      }
      std::ranges::sort(next);
      next.erase(std::unique(next.begin(), next.end()), next.end());
      current.swap(next);
    }
    result.indices.insert(result.indices.end(), current.begin(), current.end());
  }
  return result;
}

}  // namespace

template <int n>
Incidence incidence(const SimplicialComplex<n>& K, int k, int m) {
  if (k < 0 || k > n || m < 0 || m > n)
    throw InputError(text("incidence(", k, ", ", m, ") in a complex of dimension ", n, "; degrees are 0 to ", n));
  if (k >= m) return downward(K, k, m);
  if (m == k + 1) return transposed(K.face_table(m), m + 1, K.size(k));
  return transposed(downward(K, m, k).indices, binomial(m + 1, k + 1), K.size(k));
}

template <int n>
FacetCofaces facet_cofaces(const SimplicialComplex<n>& K) {
  FacetCofaces dual;
  if constexpr (n >= 1) {
    const auto facets = static_cast<std::size_t>(K.size(n - 1));
    dual.first.assign(facets, -1);
    dual.second.assign(facets, -1);
    dual.count.assign(facets, 0);
    for (Index t = 0; t < K.size(n); ++t) {
      for (const Index facet : K.faces(n, t)) {
        const auto f = static_cast<std::size_t>(facet);
        if (dual.count[f] == 0) dual.first[f] = t;
        if (dual.count[f] == 1) dual.second[f] = t;
        ++dual.count[f];
      }
    }
  }
  return dual;
}

#define DERHAM_INSTANTIATE(n)                                          \
  template Incidence incidence(const SimplicialComplex<n>&, int, int); \
  template FacetCofaces facet_cofaces(const SimplicialComplex<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
