#include "derham/boundary/rings.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cstdint>

namespace derham {

template <int n>
Rings<n>::Rings(const SimplicialComplex<n>& K) : K_(K), cofaces_(facet_cofaces(K)), star_(incidence(K, n - 2, n)) {}

/// The two facets of `top` that contain `simplex`: those opposite its vertices outside `simplex`.
template <int n>
std::array<Index, 2> Rings<n>::facets_about(Index simplex, Index top) const {
  const auto vertices = K_.simplex(n - 2, simplex);
  const auto corners = K_.simplex(n, top);
  std::array<Index, 2> facets{};
  std::size_t matched = 0, found = 0;
  for (int j = 0; j <= n; ++j) {
    if (matched < vertices.size() && vertices[matched] == corners[static_cast<std::size_t>(j)])
      ++matched;
    else
      facets[found++] = K_.face_opposite(n, top, j);
  }
  return facets;
}

/// Crosses the facet ahead; false at the boundary and at a facet with more than two cofaces.
template <int n>
bool Rings<n>::advance(Index simplex, Place& place) const {
  const auto facet = static_cast<std::size_t>(place.facet);
  if (cofaces_.count[facet] != 2) return false;
  const Index next = cofaces_.first[facet] == place.top ? cofaces_.second[facet] : cofaces_.first[facet];
  const auto facets = facets_about(simplex, next);
  place = {next, facets[0] == place.facet ? facets[1] : facets[0]};
  return true;
}

template <int n>
Ring Rings<n>::walk(Index simplex, Index top) const {
  const auto ahead = facets_about(simplex, top);
  const std::array<Place, 2> starts{Place{top, ahead[0]}, Place{top, ahead[1]}};
  Ring ring;
  Place place = starts[0];
  while (!ring.closed && advance(simplex, place)) ring.closed = place.top == top;
  if (ring.closed) {
    std::array<Place, 2> neighbours = starts;
    for (Place& neighbour : neighbours) static_cast<void>(advance(simplex, neighbour));
    place = neighbours[0].top < neighbours[1].top ? starts[0] : starts[1];
  } else {
    Place other_end = starts[1];
    while (advance(simplex, other_end)) {
    }
    if (other_end.top < place.top) place = other_end;
    const auto facets = facets_about(simplex, place.top);  // turn round at the end
    place.facet = facets[0] == place.facet ? facets[1] : facets[0];
  }
  const Index first = place.top;
  do ring.tops.push_back(place.top);
  while (advance(simplex, place) && place.top != first);
  return ring;
}

template <int n>
std::vector<Ring> Rings<n>::rings(Index i) const {
  if (i < 0 || i >= K_.size(n - 2))
    throw InputError(text("there is no simplex ", i, " of degree ", n - 2, "; there are ", K_.size(n - 2)));
  const auto star = star_[i];
  std::vector<Ring> result;
  std::vector<char> visited(star.size(), 0);
  for (std::size_t s = 0; s < star.size(); ++s) {
    if (visited[s]) continue;
    result.push_back(walk(i, star[s]));
    for (const Index top : result.back().tops)
      visited[static_cast<std::size_t>(std::ranges::lower_bound(star, top) - star.begin())] = 1;
  }
  return result;
}

template <int n>
Ring Rings<n>::ring(Index i) const {
  std::vector<Ring> all = rings(i);
  if (all.size() != 1)
    throw TopologyError(text("the top simplices about ", tuple_text(K_.simplex(n - 2, i)), " form ", all.size(),
                             " rings instead of one; check_manifold tells how to mend it"));
  return std::move(all.front());
}

template <int n>
bool Rings<n>::is_single_ring(Index i) const {
  const auto star = star_[i];
  if (star.empty()) return false;
  const Index first = star.front();
  const auto ahead = facets_about(i, first);
  std::size_t visited = 1;
  for (const Index facet : ahead) {
    Place place{first, facet};
    while (advance(i, place)) {
      if (place.top == first) return visited == star.size();
      ++visited;
    }
  }
  return visited == star.size();
}

template class Rings<2>;
template class Rings<3>;
template class Rings<4>;
template class Rings<5>;
template class Rings<6>;

}  // namespace derham
