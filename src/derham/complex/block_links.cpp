// The fast half of the "upper links" construction; docs/performance.md explains it.
#include "derham/complex/block_links.hpp"

#include "derham/complex/counted_places.hpp"
#include "derham/complex/facet_bits.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>

namespace derham {
namespace {

constexpr Index most_neighbours = 64;  // so that a row of the matrix is a word
constexpr Index most_met = 254;        // vertices in the stars of one vertex, so that their numbers fit a byte
constexpr std::size_t most_keys = 32;  // top simplices that are put in order by counting

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Room for `size` elements, without touching those that are there.
template <class T>
void grow(std::vector<T>& values, std::size_t size) {
  if (values.size() < size) values.resize(size + size / 4);
}

// body.template operator()<side>() with the smallest side of a matrix for so many neighbours; false if there is none.
template <class Body>
bool with_side(Index degree, Body&& body) {
  if (degree <= 8)
    body.template operator()<8>();
  else if (degree <= 16)
    body.template operator()<16>();
  else if (degree <= most_neighbours)
    body.template operator()<most_neighbours>();
  return degree <= most_neighbours;
}

}  // namespace

template <int n>
BlockLinks<n>::BlockLinks(const TopBlocks<n>& tops, Index vertex_count)
    : all_(tops), vertex_count_(vertex_count), number_(at(vertex_count), 0),
      position_(at(most_neighbours * most_neighbours)) {}

template <int n>
void BlockLinks<n>::find(Index block) {
  group<0>(block);
  group<1>(block);
  if constexpr (n == 3) group<2>(block);
  const Index first = all_.first_vertex(block), vertices = all_.last_vertex(block) - first;
  make_room(vertices);
  defect_ = false;
  const auto for_each_vertex = [&](auto&& body) {
    for (Index v = 0; v < vertices; ++v) {
      edges_ = edge_begin_[at(v)];
      degree_ = edge_begin_[at(v) + 1] - edges_;
      body(v);
    }
  };

  edge_begin_[0] = 0;
  for (Index v = 0; v < vertices; ++v) {
    edges_ = edge_begin_[at(v)];
    const Stars at_v = stars(v);
    Index met = 0;
    for (int p = 0; p < n; ++p) met += at_v[at(p)].count * (n - p);
    if (met <= most_met)
      number_neighbours<false>(at_v);
    else
      number_neighbours<true>(at_v);
    if (degree_ == 0 && !all_.is_last(first + v)) defect_ = true;
    edge_begin_[at(v) + 1] = edges_ + degree_;
  }
  grow(rank_, at(edge_count() + most_neighbours));
  for_each_vertex([&](Index) { with_side(degree_, [&]<int side>() { rank_neighbours<side>(); }); });
  triangles_found_ = 0;
  for_each_vertex([&](Index v) {
    triangle_begin_[at(v)] = triangles_found_;
    if (!with_side(degree_, [&]<int side>() { small_link<side>(first + v, stars(v)); }))
      large_link(first + v, stars(v));
  });
  triangle_begin_.back() = triangles_found_;
  for_each_vertex([&](Index v) {
    const Star star = stars(v)[0];
    if (degree_ <= most_neighbours && at(star.count) <= most_keys)
      order_tops(star);
    else
      sort_tops(star);
  });
}

// A counting sort of the top simplices whose vertex number p lies in the block, by that vertex.
template <int n>
template <int p>
void BlockLinks<n>::group(Index block) {
  const Index first = all_.first_vertex(block);
  const auto size = at(all_.count(p, block));
  Group& group = groups_[p];
  group.begin.assign(at(all_.last_vertex(block) - first) + 1, 0);
  Index* const count = group.begin.data() + 1;
  all_.template for_each<p>(block, [&](const Index* vertices, Index) { ++count[vertices[0] - first]; });
  std::partial_sum(group.begin.begin(), group.begin.end(), group.begin.begin());
  next_.assign(group.begin.begin(), group.begin.end());
  group.rest.resize(size * (n - p));
  if (p < 2) group.top.resize(size);
  Index *const next = next_.data(), *const rest = group.rest.data(), *const top = group.top.data();
  all_.template for_each<p>(block, [&](const Index* vertices, Index entry) {
    const auto to = at(next[vertices[0] - first]++);
    for (std::size_t i = 0; i < n - p; ++i) rest[to * (n - p) + i] = vertices[i + 1];
    if constexpr (p < 2) top[to] = entry;
  });
}

template <int n>
void BlockLinks<n>::make_room(Index vertices) {
  const auto begins = groups_[0].top.size(), continues = groups_[1].top.size(), most = 3 * begins + continues;
  if (n == 3 && most > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw LimitError(text("up to ", most, " triangles begin at ", vertices,
                          " consecutive vertices and do not fit the index type; build derham with DERHAM_INDEX64=ON"));
  std::size_t met = 0;
  for (const Group& group : groups_) met += group.rest.size();
  for (std::size_t p = 0; p < 2; ++p) groups_[p].number.resize(groups_[p].rest.size());
  groups_[0].faces.resize(begins * n);
  groups_[1].faces.resize(continues);
  order_.resize(begins);
  key_.resize(begins + most_keys);
  edge_begin_.resize(at(vertices) + 1);
  triangle_begin_.resize(at(vertices) + 1);
  grow(neighbours_, met + most_neighbours);
  if constexpr (n == 3) {
    grow(triangles_, 3 * most);
    grow(triangle_faces_, 3 * most);
  }
}

template <int n>
auto BlockLinks<n>::stars(Index v) const -> Stars {
  Stars stars{};
  for (std::size_t p = 0; p < n; ++p)
    stars[p] = {groups_[p].begin[at(v)], groups_[p].begin[at(v) + 1] - groups_[p].begin[at(v)]};
  return stars;
}

// Numbers the upper neighbours as they are met, and notes the number of each vertex in the stars. If there may be `many` of
// them, numbers beyond a byte are not kept: nobody will ask for them.
template <int n>
template <bool many>
void BlockLinks<n>::number_neighbours(const Stars& stars) {
  Index* const neighbour = neighbours_.data() + edges_;
  std::uint8_t* const numbers = number_.data();
  std::size_t degree = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const auto begin = at(stars[p].begin) * (n - p), end = begin + at(stars[p].count) * (n - p);
    const Index* const rest = groups_[p].rest.data();
    std::uint8_t* const met = groups_[p].number.data();
    for (auto i = begin; i < end; ++i) {
      std::uint8_t& number = numbers[rest[i]];
      const bool is_new = number == 0;
      const std::size_t fresh = many ? std::min<std::size_t>(degree + 1, most_met + 1) : degree + 1;
      number = is_new ? static_cast<std::uint8_t>(fresh) : number;
      if (p < 2) met[i] = number;
      neighbour[degree] = rest[i];
      degree += is_new;
    }
  }
  for (std::size_t i = 0; i < degree; ++i) numbers[neighbour[i]] = 0;
  degree_ = static_cast<Index>(degree);
}

// Sorts at most `side` neighbours, and notes the rank of each.
template <int n>
template <int side>
void BlockLinks<n>::rank_neighbours() {
  Index* const neighbour = neighbours_.data() + edges_;
  std::uint8_t* const rank = rank_.data() + edges_;
  const auto place = counted_places<side>(neighbour, at(degree_));
  std::array<Index, side> met{};
  std::copy_n(neighbour, side, met.begin());
  for (std::size_t i = 0; i < at(degree_); ++i) {
    neighbour[place[i]] = met[i];
    rank[i] = static_cast<std::uint8_t>(place[i]);
  }
}

// At most `side` neighbours.
template <int n>
template <int side>
void BlockLinks<n>::small_link(Index vertex, const Stars& stars) {
  constexpr int bits = std::countr_zero(static_cast<unsigned>(side));
  const auto [begin, count] = stars[0];
  const auto [second_begin, second_count] = stars[1];
  const std::uint8_t* number = groups_[0].number.data() + at(begin) * n;
  const auto next = [&number, rank = rank_.data() + edges_] { return Index{rank[*number++ - 1]}; };
  const Index *first = groups_[0].top.data() + begin, *second = groups_[1].top.data() + second_begin;
  const auto odd = [](Index entry) { return entry < 0 ? ~std::uint64_t{0} : std::uint64_t{0}; };
  Index *face = groups_[0].faces.data() + at(begin) * n, *last_face = groups_[1].faces.data() + second_begin;
  std::int32_t* key = key_.data() + begin;

  if constexpr (n == 2) {
    FacetBits<1> edges;
    for (Index q = 0; q < count; ++q, face += 2) {
      const Index b = next(), c = next();
      edges.add(b, c, odd(*first++));
      face[0] = edges_ + b;
      face[1] = edges_ + c;
      *key++ = static_cast<std::int32_t>(b << bits | c);
    }
    number = groups_[1].number.data() + second_begin;
    for (Index q = 0; q < second_count; ++q) {
      const Index c = next();
      edges.add(c, odd(*second++));
      *last_face++ = edges_ + c;
    }
    coherent_ &= edges.are_coherent();
  } else {
    // The matrix, row after row, as a string of bits. The faces are the places of pairs in it, then their numbers.
    std::array<std::uint64_t, std::size_t{side} * side / 64> matrix{};
    FacetBits<matrix.size()> pairs;
    for (Index q = 0; q < count; ++q, face += 3) {
      const Index b = next() << bits, c = next(), d = next();
      face[0] = b | c;
      face[1] = b | d;
      face[2] = c << bits | d;
      pairs.add(face[0], face[1], face[2], odd(*first++));
      *key++ = static_cast<std::int32_t>(face[0] << bits | d);
    }
    number = groups_[1].number.data() + at(second_begin) * 2;
    for (Index q = 0; q < second_count; ++q) {
      const Index c = next() << bits, d = next();
      last_face[q] = c | d;
      pairs.add(last_face[q], odd(*second++));
    }
    coherent_ &= pairs.are_coherent();
    for (std::size_t word = 0; word < matrix.size(); ++word) matrix[word] = pairs.met(word);
    add_triangles<side>(vertex, matrix);
    const auto find_number = [position = position_.data()](Index& pair) { pair = position[at(pair)]; };
    for (Index q = 0; q < count; ++q) {
      face -= 3;
      find_number(face[0]), find_number(face[1]), find_number(face[2]);
    }
    for (Index q = 0; q < second_count; ++q) find_number(last_face[q]);
  }
}

// The triangles of the pairs of ranks whose bits are set, in order.
template <int n>
template <int side>
void BlockLinks<n>::add_triangles(Index vertex, const std::array<std::uint64_t, std::size_t{side} * side / 64>& pairs) {
  constexpr int bits = std::countr_zero(static_cast<unsigned>(side));
  const Index* const neighbour = neighbours_.data() + edges_;
  Index* const position = position_.data();
  Index found = triangles_found_;
  Index *triangle = triangles_.data() + at(found) * 3, *face = triangle_faces_.data() + at(found) * 3;
  const Index edges = edges_;
  for (std::size_t word = 0; word < pairs.size(); ++word)
    for (std::uint64_t left = pairs[word]; left != 0; left &= left - 1) {
      const auto pair = word * 64 + at(std::countr_zero(left)), i = pair >> bits, j = pair & (side - 1);
      position[pair] = found++;
      triangle[0] = vertex;
      triangle[1] = neighbour[i];
      triangle[2] = neighbour[j];
      triangle += 3;
      face[0] = edges + static_cast<Index>(i);
      face[1] = edges + static_cast<Index>(j);
      face += 3;
    }
  triangles_found_ = found;
}

// Puts the top simplices of a star in the order of their keys.
template <int n>
void BlockLinks<n>::order_tops(Star star) {
  const auto count = at(star.count);
  const Index* const top = groups_[0].top.data() + star.begin;
  const std::int32_t* const key = key_.data() + star.begin;
  Index* const order = order_.data() + star.begin;
  const auto put = [&](const auto& place) {
    std::size_t sum = 0;
    for (std::size_t q = 0; q < count; ++q) {
      order[place[q]] = TopBlocks<n>::top_of(top[q]);
      sum += static_cast<std::size_t>(place[q]);
    }
    defect_ |= 2 * sum != count * (count - 1);
  };
  if (count <= 8)
    put(counted_places<8>(key, count));
  else if (count <= 16)
    put(counted_places<16>(key, count));
  else
    put(counted_places<most_keys>(key, count));
}

template class BlockLinks<2>;
template class BlockLinks<3>;

}  // namespace derham
