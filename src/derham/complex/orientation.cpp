#include "derham/complex/orientation.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

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
Orientation coherent_orientation(const SimplicialComplex<n>& K, std::span<const Sign> preferred) {
  const Index tops = K.size(n);
  if (preferred.size() != static_cast<std::size_t>(tops))
    throw InputError(text("there are ", preferred.size(), " preferred signs for ", tops, " top simplices"));
  for (const Sign sign : preferred)
    if (sign != 1 && sign != -1) throw InputError(text("preferred sign is ", int{sign}, "; it must be +1 or -1"));
  Orientation result;
  result.sign.assign(preferred.size(), Sign{0});
  const FacetCofaces dual = facet_cofaces(K);
  std::vector<Index> component(preferred.size()), parent(preferred.size(), -1), queue;
  queue.reserve(preferred.size());

  for (Index root = 0; root < tops; ++root) {
    if (result.sign[static_cast<std::size_t>(root)] != 0) continue;
    result.sign[static_cast<std::size_t>(root)] = preferred[static_cast<std::size_t>(root)];
    component[static_cast<std::size_t>(root)] = result.components;
    queue.assign(1, root);
    for (std::size_t head = 0; head < queue.size() && n > 0; ++head) {
      const Index t = queue[head];
      const auto facets = K.faces(n, t);
      for (std::size_t j = 0; j < facets.size(); ++j) {
        const auto facet = static_cast<std::size_t>(facets[j]);
        if (dual.count[facet] != 2) continue;
        const Index u = dual.first[facet] == t ? dual.second[facet] : dual.first[facet];
        const auto across = K.faces(n, u);
        const auto i = static_cast<std::size_t>(std::ranges::find(across, facets[j]) - across.begin());
        // the entries sign(t)(-1)^(n-j) and sign(u)(-1)^(n-i) of the facet's row must be opposite
        const Sign needed = static_cast<Sign>((i + j) % 2 == 0 ? -result.sign[static_cast<std::size_t>(t)]
                                                               : result.sign[static_cast<std::size_t>(t)]);
        Sign& sign = result.sign[static_cast<std::size_t>(u)];
        if (sign == 0) {
          sign = needed;
          component[static_cast<std::size_t>(u)] = result.components;
          parent[static_cast<std::size_t>(u)] = t;
          queue.push_back(u);
        } else if (sign != needed && result.orientable) {
          result.orientable = false;
          result.one_sided = cycle_through(parent, t, u);
        }
      }
    }
    ++result.components;
  }
  if (!result.orientable) std::ranges::fill(result.sign, Sign{1});
  if (result.components > 1) result.component = std::move(component);
  return result;
}

template Orientation coherent_orientation(const SimplicialComplex<0>&, std::span<const Sign>);
template Orientation coherent_orientation(const SimplicialComplex<1>&, std::span<const Sign>);
template Orientation coherent_orientation(const SimplicialComplex<2>&, std::span<const Sign>);
template Orientation coherent_orientation(const SimplicialComplex<3>&, std::span<const Sign>);
template Orientation coherent_orientation(const SimplicialComplex<4>&, std::span<const Sign>);
template Orientation coherent_orientation(const SimplicialComplex<5>&, std::span<const Sign>);
template Orientation coherent_orientation(const SimplicialComplex<6>&, std::span<const Sign>);

}  // namespace derham
