// The fast half of the "upper links" construction; docs/performance.md explains it.
#include "derham/complex/block_links.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>

namespace derham {
namespace {

constexpr std::size_t most_met = 250;  // vertices in the stars of one vertex, so that their numbers fit a byte
constexpr Index most_neighbours = 64;  // so that a row of the matrix is a word

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// The top simplex of an entry of TopBlocks::in.
Index top_of(Index entry) { return entry < 0 ? ~entry : entry; }

// Room for `size` elements, without touching those that are there.
template <class T>
void grow(std::vector<T>& values, std::size_t size) {
  if (values.size() < size) values.resize(size + size / 4);
}

// How many of the first `count` of `values` are smaller than each: its place in sorted order, as all are distinct. Always
// looks at all `capacity` values, which the compiler makes a few vectors.
template <int capacity>
std::array<Index, capacity> places(const Index* values, Index count) {
  std::array<Index, capacity> place{};
  for (Index i = 0; i < count; ++i)
    for (std::size_t j = 0; j < capacity; ++j) place[j] += values[j] > values[i];
  return place;
}

}  // namespace

template <int n>
BlockLinks<n>::BlockLinks(const TopBlocks<n>& tops, Index vertex_count)
    : all_(tops), vertex_count_(vertex_count), number_(at(vertex_count), 0),
      position_(at(most_neighbours * most_neighbours)) {}

// A counting sort of the top simplices whose vertex number p lies in the block, by that vertex.
template <int n>
template <int p>
void BlockLinks<n>::group(Index block) {
  constexpr std::size_t ahead = TopBlocks<n>::look_ahead, width = n - p;
  const auto list = all_.in(p, block);
  const Index first = all_.first_vertex(block);
  const auto tuple = [tuples = all_.tuples.data()](Index entry) { return tuples + at(top_of(entry)) * (n + 1) + p; };
  Group& group = groups_[p];
  group.begin.assign(at(all_.last_vertex(block) - first) + 1, 0);
  Index* const count = group.begin.data() + 1;
  for (std::size_t i = 0; i < list.size(); ++i) {
    __builtin_prefetch(tuple(list.data()[i + ahead]));
    ++count[*tuple(list[i]) - first];
  }
  std::partial_sum(group.begin.begin(), group.begin.end(), group.begin.begin());
  next_.assign(group.begin.begin(), group.begin.end());
  group.rest.resize(list.size() * width);
  group.top.resize(list.size());
  group.odd.resize(list.size());
  Index *const next = next_.data(), *const rest = group.rest.data(), *const top = group.top.data();
  std::uint8_t* const odd = group.odd.data();
  for (const Index entry : list) {
    const Index* const vertices = tuple(entry);
    const auto to = at(next[*vertices - first]++);
    for (std::size_t i = 0; i < width; ++i) rest[to * width + i] = vertices[i + 1];
    top[to] = top_of(entry);
    odd[to] = static_cast<std::uint8_t>(entry < 0);
  }
}

// The same for the vertices number 2 of tetrahedra, of which the last edge is all that matters.
template <int n>
void BlockLinks<n>::group_last_edges(Index block) {
  if constexpr (n == 3) {
    const auto edges = all_.last_edges(block);
    const Index first = all_.first_vertex(block);
    Group& group = groups_[2];
    group.begin.assign(at(all_.last_vertex(block) - first) + 1, 0);
    for (const auto& [v, w] : edges) ++group.begin[at(v - first) + 1];
    std::partial_sum(group.begin.begin(), group.begin.end(), group.begin.begin());
    next_.assign(group.begin.begin(), group.begin.end());
    group.rest.resize(edges.size());
    Index *const next = next_.data(), *const rest = group.rest.data();
    for (const auto& [v, w] : edges) rest[next[v - first]++] = w;
  }
}

template <int n>
void BlockLinks<n>::find(Index block) {
  group<0>(block);
  group<1>(block);
  group_last_edges(block);
  std::size_t met = 0;
  for (const Group& group : groups_) met += group.rest.size();
  const Index first = all_.first_vertex(block), vertices = all_.last_vertex(block) - first;
  const auto begins = groups_[0].top.size(), continues = groups_[1].top.size();
  groups_[0].faces.resize(begins * n);
  groups_[1].faces.resize(continues);
  order_.resize(begins);
  edge_begin_.resize(at(vertices) + 1);
  triangle_begin_.resize(at(vertices) + 1);
  grow(neighbours_, met + most_neighbours);
  if constexpr (n == 3) {
    grow(triangles_, 3 * (3 * begins + continues));
    grow(sides_, 2 * (3 * begins + continues));
  }
  edges_ = triangles_found_ = 0;
  defect_ = false;

  for (Index v = 0; v < vertices; ++v) {
    edge_begin_[at(v)] = edges_;
    triangle_begin_[at(v)] = triangles_found_;
    std::array<Star, n> stars{};
    for (std::size_t p = 0; p < n; ++p)
      stars[p] = {groups_[p].begin[at(v)], groups_[p].begin[at(v) + 1] - groups_[p].begin[at(v)]};
    if (!number_neighbours(stars))
      large_link(first + v, stars);
    else if (degree_ <= 8)
      small_link<8>(first + v, stars);
    else if (degree_ <= 16)
      small_link<16>(first + v, stars);
    else
      small_link<most_neighbours>(first + v, stars);
    if (degree_ == 0 && !all_.is_last(first + v)) defect_ = true;
    edges_ += degree_;
  }
  edge_begin_.back() = edges_;
  triangle_begin_.back() = triangles_found_;
  judge_facets();
}

// Numbers the upper neighbours as they are met, and notes the number of each vertex in the stars; false if there are too
// many for small_link.
template <int n>
bool BlockLinks<n>::number_neighbours(const std::array<Star, n>& stars) {
  std::size_t size = 0;
  for (std::size_t p = 0; p < n; ++p) size += at(stars[p].count) * (n - p);
  if (size > most_met) return false;
  met_.resize(most_met);
  Index* const neighbour = neighbours_.data() + edges_;
  std::uint8_t* met = met_.data();
  unsigned degree = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const Index* vertex = groups_[p].rest.data() + at(stars[p].begin) * (n - p);
    const Index* const end = vertex + at(stars[p].count) * (n - p);
    for (; vertex != end; ++vertex) {
      std::uint8_t& number = number_[at(*vertex)];
      const bool is_new = number == 0;
      number = static_cast<std::uint8_t>(is_new ? degree + 1 : number);
      *met++ = static_cast<std::uint8_t>(number - 1);
      neighbour[degree] = *vertex;
      degree += is_new;
    }
  }
  for (unsigned i = 0; i < degree; ++i) number_[at(neighbour[i])] = 0;
  degree_ = static_cast<Index>(degree);
  return degree_ <= most_neighbours;
}

template <int n>
void BlockLinks<n>::add_triangle(Index vertex, Index i, Index j) {
  const Index* const neighbour = neighbours_.data() + edges_;
  Index* const triangle = triangles_.data() + at(triangles_found_) * 3;
  triangle[0] = vertex;
  triangle[1] = neighbour[i];
  triangle[2] = neighbour[j];
  Index* const side = sides_.data() + at(triangles_found_) * 2;
  side[0] = edges_ + i;
  side[1] = edges_ + j;
  ++triangles_found_;
}

// At most `side` neighbours.
template <int n>
template <int side>
void BlockLinks<n>::small_link(Index vertex, const std::array<Star, n>& stars) {
  Index* const neighbour = neighbours_.data() + edges_;
  const auto rank = places<side>(neighbour, degree_);
  std::array<Index, side> met{};
  std::copy_n(neighbour, side, met.begin());
  for (std::size_t i = 0; i < at(degree_); ++i) neighbour[rank[i]] = met[i];

  constexpr int bits = std::countr_zero(static_cast<unsigned>(side));
  const auto first = stars[0], second = stars[1];
  const std::uint8_t* number = met_.data();
  const auto next = [&] { return rank[*number++]; };
  // Sorting keys of the top simplices: the ranks of their vertices, then their number in the star.
  constexpr int most_keys = 32, key_bits = 5;
  std::array<Index, most_keys> key{};
  const auto set_key = [&](Index q, Index ranks) {
    if (q < most_keys) key[at(q)] = ranks << key_bits | q;
  };
  Index* const face = groups_[0].faces.data() + at(first.begin) * n;
  Index* const last_face = groups_[1].faces.data() + second.begin;

  if constexpr (n == 2) {
    for (Index q = 0; q < first.count; ++q) {
      const Index b = next(), c = next();
      face[2 * q] = edges_ + b;
      face[2 * q + 1] = edges_ + c;
      set_key(q, b << bits | c);
    }
    for (Index q = 0; q < second.count; ++q) last_face[q] = edges_ + next();
  } else {
    // The matrix, row after row, as a string of bits. The faces are the places of pairs in it, then their numbers.
    constexpr std::size_t words = std::size_t{side} * side / 64;
    std::array<std::uint64_t, words> matrix{};
    const auto add = [&](Index i, Index j) {
      const Index pair = i << bits | j;
      matrix[words == 1 ? 0 : at(pair) / 64] |= std::uint64_t{1} << (at(pair) % 64);
      return pair;
    };
    for (Index q = 0; q < first.count; ++q) {
      const Index b = next(), c = next(), d = next();
      face[3 * q] = add(b, c);
      face[3 * q + 1] = add(b, d);
      face[3 * q + 2] = add(c, d);
      set_key(q, (b << bits | c) << bits | d);
    }
    for (Index q = 0; q < second.count; ++q) {
      const Index c = next(), d = next();
      last_face[q] = add(c, d);
    }
    Index* const position = position_.data();
    for (std::size_t w = 0; w < words; ++w) {
      for (std::uint64_t row = matrix[w]; row != 0; row &= row - 1) {
        const auto pair = w * 64 + at(std::countr_zero(row));
        position[pair] = triangles_found_;
        add_triangle(vertex, static_cast<Index>(pair >> bits), static_cast<Index>(pair & (side - 1)));
      }
    }
    for (Index i = 0; i < 3 * first.count; ++i) face[i] = position[at(face[i])];
    for (Index i = 0; i < second.count; ++i) last_face[i] = position[at(last_face[i])];
  }

  if (first.count > most_keys) return sort_tops(first);
  const Index count = first.count;
  std::array<Index, most_keys> ranks{};
  const auto sort_keys = [&](const auto& place) {
    for (std::size_t q = 0; q < at(count); ++q) {
      order_[at(first.begin + place[q])] = groups_[0].top[at(first.begin) + q];
      ranks[at(place[q])] = key[q] >> key_bits;
    }
  };
  if (count <= 8)
    sort_keys(places<8>(key.data(), count));
  else if (count <= 16)
    sort_keys(places<16>(key.data(), count));
  else
    sort_keys(places<most_keys>(key.data(), count));
  for (std::size_t q = 1; q < at(count); ++q) defect_ |= ranks[q] == ranks[q - 1];
}

// Any number of neighbours.
template <int n>
void BlockLinks<n>::large_link(Index vertex, const std::array<Star, n>& stars) {
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
  sort_tops(stars[0]);
}

template <int n>
void BlockLinks<n>::sort_tops(Star star) {
  const auto rest = [&](Index q) { return std::span<const Index>(groups_[0].rest).subspan(at(star.begin + q) * n, n); };
  const auto order = std::span(order_).subspan(at(star.begin), at(star.count));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, [&](Index a, Index b) { return std::ranges::lexicographical_compare(rest(a), rest(b)); });
  for (std::size_t i = 1; i < order.size(); ++i) defect_ |= std::ranges::equal(rest(order[i - 1]), rest(order[i]));
  for (Index& q : order) q = groups_[0].top[at(star.begin + q)];
}

// All cofaces of a facet that begins in the block begin, or have their second vertex, at its first vertex: they are at hand.
template <int n>
void BlockLinks<n>::judge_facets() {
  constexpr std::uint8_t untouched = 0, closed = 3;  // else 1 or 2, for the entry +1 or -1 of the first coface
  facet_states_.assign(at(n == 2 ? edge_count() : triangle_count()), untouched);
  bool flaw = false;
  const auto meet = [&](Index facet, unsigned odd) {
    std::uint8_t& state = facet_states_[at(facet)];
    const auto mine = static_cast<std::uint8_t>(1 + odd);
    flaw |= state == closed || state == mine;
    state = state == untouched ? mine : closed;
  };
  const Group &first = groups_[0], &second = groups_[1];
  for (std::size_t i = 0; i < first.top.size(); ++i)
    for (unsigned f = 0; f < n; ++f) meet(first.faces[i * n + f], (first.odd[i] ^ (n - f)) & 1U);  // omits vertex n - f
  for (std::size_t i = 0; i < second.top.size(); ++i) meet(second.faces[i], second.odd[i]);        // omits vertex 0
  coherent_ = !flaw;
}

template class BlockLinks<2>;
template class BlockLinks<3>;

}  // namespace derham
