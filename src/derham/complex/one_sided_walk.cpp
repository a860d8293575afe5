#include "derham/complex/one_sided_walk.hpp"

#include "derham/complex/incidence.hpp"

#include <algorithm>

namespace derham {
namespace {

/// The closed walk s … root … t of the search tree, shortened to its last common simplex; s and t share a facet.
std::vector<Index> cycle_through(const std::vector<Index>& parent, Index s, Index t) {
  std::vector<Index> from_s{s}, from_t{t};
  while (parent[static_cast<std::size_t>(from_s.back())] >= 0)
    from_s.push_back(parent[static_cast<std::size_t>(from_s.back())]);
  while (parent[static_cast<std::size_t>(from_t.back())] >= 0)
    from_t.push_back(parent[static_cast<std::size_t>(from_t.back())]);
  while (from_s.size() > 1 && from_t.size() > 1 && from_s[from_s.size() - 2] == from_t[from_t.size() - 2]) {
    from_s.pop_back();
    from_t.pop_back();
  }
  from_s.insert(from_s.end(), from_t.rbegin() + 1, from_t.rend());
  return from_s;
}

}  // namespace

template <int n>
std::vector<Index> one_sided_walk(const SimplicialComplex<n>& K) {
  const FacetCofaces dual = facet_cofaces(K);
  const auto tops = static_cast<std::size_t>(K.size(n));
  std::vector<Sign> sign(tops, 0);
  std::vector<Index> parent(tops, -1), queue;
  for (Index root = 0; root < K.size(n); ++root) {
    if (sign[static_cast<std::size_t>(root)] != 0) continue;
    sign[static_cast<std::size_t>(root)] = 1;
    queue.assign(1, root);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index t = queue[head];
      const auto facets = K.faces(n, t);
      for (std::size_t j = 0; j < facets.size(); ++j) {
        const auto facet = static_cast<std::size_t>(facets[j]);
        if (dual.count[facet] != 2) continue;
        const Index u = dual.first[facet] == t ? dual.second[facet] : dual.first[facet];
        const auto across = K.faces(n, u);
        const auto i = static_cast<std::size_t>(std::ranges::find(across, facets[j]) - across.begin());
        // the entries sign(t)(-1)^(n-j) and sign(u)(-1)^(n-i) of the facet's row must be opposite
        const Sign sign_t = sign[static_cast<std::size_t>(t)];
        const Sign needed = (i + j) % 2 == 0 ? static_cast<Sign>(-sign_t) : sign_t;
        Sign& sign_u = sign[static_cast<std::size_t>(u)];
        if (sign_u == -needed) return cycle_through(parent, t, u);
        if (sign_u != 0) continue;
        sign_u = needed;
        parent[static_cast<std::size_t>(u)] = t;
        queue.push_back(u);
      }
    }
  }
  return {};
}

template std::vector<Index> one_sided_walk(const SimplicialComplex<1>&);
template std::vector<Index> one_sided_walk(const SimplicialComplex<2>&);
template std::vector<Index> one_sided_walk(const SimplicialComplex<3>&);
template std::vector<Index> one_sided_walk(const SimplicialComplex<4>&);
template std::vector<Index> one_sided_walk(const SimplicialComplex<5>&);
template std::vector<Index> one_sided_walk(const SimplicialComplex<6>&);

}  // namespace derham
