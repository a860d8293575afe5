// Upper links of any size, for the few vertices that the fast path of block_links.cpp does not take.
#include "derham/complex/block_links.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace derham {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

template <int n>
void BlockLinks<n>::add_triangle(Index vertex, Index i, Index j) {
  const Index* const neighbour = neighbours_.data() + edges_;
  Index* const triangle = triangles_.data() + at(triangles_found_) * 3;
  triangle[0] = vertex;
  triangle[1] = neighbour[i];
  triangle[2] = neighbour[j];
  Index* const face = triangle_faces_.data() + at(triangles_found_) * 3;
  face[0] = edges_ + i;
  face[1] = edges_ + j;
  ++triangles_found_;
}

// Any number of neighbours.
template <int n>
void BlockLinks<n>::large_link(Index vertex, const Stars& stars) {
  if (!large_) large_ = std::make_unique<UpperLink<n>>(vertex_count_);
  UpperLink<n>& link = *large_;
  const auto for_each_rest = [&](std::size_t places, auto&& body) {
    for (std::size_t p = 0; p < places; ++p)
      for (Index q = 0; q < stars[p].count; ++q)
        body(p, at(q), std::span(groups_[p].rest).subspan(at(stars[p].begin + q) * (n - p), n - p));
  };
  link.clear();
  for_each_rest(n, [&](std::size_t, std::size_t, std::span<const Index> rest) { link.add_vertices(rest); });
  link.close_vertices();
  degree_ = link.count(1);
  for (Index i = 0; i < degree_; ++i) neighbours_[at(edges_ + i)] = link.vertex(i);
  const Index base = n == 2 ? edges_ : triangles_found_;
  if constexpr (n == 3) {
    for_each_rest(2, [&](std::size_t, std::size_t, std::span<const Index> rest) { link.add_tuples(rest); });
    link.close_tuples();
    link.for_each(2, [&](const auto& ranks) { add_triangle(vertex, ranks[0], ranks[1]); });
  }
  // Of the first vertices the faces that omit one of the others, the last of them first.
  for_each_rest(2, [&](std::size_t p, std::size_t q, std::span<const Index> rest) {
    const int faces = p == 0 ? n : 1;
    for (int f = 0; f < faces; ++f) {
      typename UpperLink<n>::Ranks ranks{};
      std::size_t known = 0;
      for (std::size_t i = 0; i < rest.size(); ++i)
        if (p == 1 || i + 1 + at(f) != n) ranks[known++] = link.rank(rest[i]);
      groups_[p].faces[(at(stars[p].begin) + q) * at(faces) + at(f)] = base + link.position(n - 1, ranks);
    }
  });
  judge_facets(stars, base, n == 2 ? degree_ : triangles_found_ - base);
}

template <int n>
void BlockLinks<n>::sort_tops(Star star) {
  const auto rest = [&](Index q) { return std::span<const Index>(groups_[0].rest).subspan(at(star.begin + q) * n, n); };
  const auto order = std::span(order_).subspan(at(star.begin), at(star.count));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, [&](Index a, Index b) { return std::ranges::lexicographical_compare(rest(a), rest(b)); });
  for (std::size_t i = 1; i < order.size(); ++i) defect_ |= std::ranges::equal(rest(order[i - 1]), rest(order[i]));
  for (Index& q : order) q = TopBlocks<n>::top_of(groups_[0].top[at(star.begin + q)]);
}

// Whether the facets of a vertex, `count` from `first` on, have one coface, or two with opposite signs.
template <int n>
void BlockLinks<n>::judge_facets(const Stars& stars, Index first, Index count) {
  constexpr std::uint8_t plus = 1, minus = 2;
  facet_states_.assign(at(count), 0);
  const auto meet = [&](Index facet, bool odd) {
    std::uint8_t& state = facet_states_[at(facet - first)];
    const auto mine = odd ? minus : plus;
    coherent_ &= (state & mine) == 0;
    state |= mine;
  };
  for (std::size_t p = 0; p < 2; ++p) {
    const std::size_t faces = p == 0 ? n : 1;
    for (std::size_t i = at(stars[p].begin); i < at(stars[p].begin + stars[p].count); ++i)
      for (std::size_t f = 0; f < faces; ++f) {
        const std::size_t omitted = p == 0 ? n - f : 0;
        meet(groups_[p].faces[i * faces + f], (groups_[p].top[i] < 0) != (omitted % 2 != 0));
      }
  }
}

template class BlockLinks<2>;
template class BlockLinks<3>;

}  // namespace derham
