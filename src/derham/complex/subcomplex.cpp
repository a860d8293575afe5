#include "derham/complex/subcomplex.hpp"

#include <algorithm>

namespace derham {
namespace {

void sort_unique(std::vector<Index>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

void require_inside(const std::vector<Index>& indices, int k, Index size) {
  for (const Index i : indices)
    if (i < 0 || i >= size) throw InputError(text("there is no ", k, "-simplex ", i, "; there are ", size));
}

}  // namespace

template <int n>
bool SimplexSet<n>::contains(int k, Index i) const noexcept {
  return std::ranges::binary_search(indices[static_cast<std::size_t>(k)], i);
}

template <int n>
SimplexSet<n> closure(const SimplicialComplex<n>& K, SimplexSet<n> set) {
  for (int k = 0; k <= n; ++k) require_inside(set.indices[static_cast<std::size_t>(k)], k, K.size(k));
  for (int k = n; k >= 1; --k) {
    auto& lower = set.indices[static_cast<std::size_t>(k) - 1];
    for (const Index i : set.indices[static_cast<std::size_t>(k)]) {
      const auto faces = K.faces(k, i);
      lower.insert(lower.end(), faces.begin(), faces.end());
    }
    sort_unique(lower);
  }
  return set;
}

template <int n>
SimplexSet<n> star(const CofaceLists<n>& cofaces, SimplexSet<n> set) {
  for (int k = 0; k < n; ++k) {
    const auto degree = static_cast<std::size_t>(k);
    require_inside(set.indices[degree], k, cofaces.table[degree].rows());
    auto& upper = set.indices[static_cast<std::size_t>(k) + 1];
    for (const Index i : set.indices[static_cast<std::size_t>(k)]) {
      const auto row = cofaces.table[static_cast<std::size_t>(k)][i];
      upper.insert(upper.end(), row.begin(), row.end());
    }
    sort_unique(upper);
  }
  return set;
}

template <int n>
SimplexSet<n> link(const SimplicialComplex<n>& K, const CofaceLists<n>& cofaces, const SimplexSet<n>& set) {
  const SimplexSet<n> outer = closure(K, star(cofaces, set)), inner = star(cofaces, closure(K, set));
  SimplexSet<n> result;
  for (std::size_t k = 0; k <= n; ++k)
    std::ranges::set_difference(outer.indices[k], inner.indices[k], std::back_inserter(result.indices[k]));
  return result;
}

template <int n>
SimplexSet<n> boundary_simplices(const SimplicialComplex<n>& K) {
  SimplexSet<n> set;
  if constexpr (n >= 1) {
    const FacetCofaces dual = facet_cofaces(K);
    for (Index f = 0; f < K.size(n - 1); ++f)
      if (dual.count[static_cast<std::size_t>(f)] == 1) set.indices[n - 1].push_back(f);
  }
  return closure(K, std::move(set));
}

#define DERHAM_INSTANTIATE(n)                                                                            \
  template struct SimplexSet<n>;                                                                         \
  template SimplexSet<n> closure(const SimplicialComplex<n>&, SimplexSet<n>);                            \
  template SimplexSet<n> star(const CofaceLists<n>&, SimplexSet<n>);                                     \
  template SimplexSet<n> link(const SimplicialComplex<n>&, const CofaceLists<n>&, const SimplexSet<n>&); \
  template SimplexSet<n> boundary_simplices(const SimplicialComplex<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
