// This follows Cuthill & McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969.
#include "derham/complex/renumbering.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <numeric>

namespace derham {
namespace {

std::size_t index(Offset i) { return static_cast<std::size_t>(i); }

/// The rows about each vertex.
struct Stars {
  std::vector<Offset> begin;  // (vertices+1,)
  std::vector<Index> rows;

  Stars(const SimplexList& list, Index vertex_count) : begin(index(vertex_count) + 2, 0) {
    for (const Index v : list.vertices()) {
      if (v < 0 || v >= vertex_count)
        throw InputError(text("vertex id ", v, " in a mesh of ", vertex_count, " vertices"));
      ++begin[index(v) + 2];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    rows.resize(list.vertices().size());
    for (Offset row = 0; row < list.size(); ++row)
      for (const Index v : list[row]) rows[index(begin[index(v) + 1]++)] = static_cast<Index>(row);
    begin.pop_back();
  }
  [[nodiscard]] Offset count(Index v) const { return begin[index(v) + 1] - begin[index(v)]; }
  [[nodiscard]] std::span<const Index> operator[](Index v) const {
    return std::span(rows).subspan(index(begin[index(v)]), index(count(v)));
  }
};

/// Breadth-first search through vertices that share a row, again and again in the same or in other components.
class Search {
 public:
  Search(const SimplexList& rows, const Stars& stars)
      : rows_(rows), stars_(stars), vertex_seen_(stars.begin.size() - 1, 0), row_seen_(index(rows.size()), 0) {}

  /// Appends to `order` the component of `start`, of which nothing was reached in this round. Where its last layer begins.
  std::size_t append(Index start, std::vector<Index>& order) {
    std::size_t layer = order.size(), layer_end = layer + 1;
    order.push_back(start);
    vertex_seen_[index(start)] = round_;
    for (std::size_t head = layer; head < order.size(); ++head) {
      if (head == layer_end) {
        layer = head;
        layer_end = order.size();
      }
      const std::size_t found = order.size();
      for (const Index row : stars_[order[head]]) {
        if (row_seen_[index(row)] == round_) continue;
        row_seen_[index(row)] = round_;
        for (const Index v : rows_[row]) {
          if (vertex_seen_[index(v)] == round_) continue;
          vertex_seen_[index(v)] = round_;
          order.push_back(v);
        }
      }
      std::ranges::sort(order.begin() + static_cast<std::ptrdiff_t>(found), order.end(), {},
                        [&](Index v) { return std::pair(stars_.count(v), v); });
    }
    return layer;
  }

  void next_round() { ++round_; }
  [[nodiscard]] bool reached(Index v) const { return vertex_seen_[index(v)] == round_; }

 private:
  const SimplexList& rows_;
  const Stars& stars_;
  std::vector<char> vertex_seen_, row_seen_;  // the last round that reached it
  char round_ = 1;
};

}  // namespace

Renumbering reverse_cuthill_mckee(const SimplexList& rows, Index vertex_count) {
  const Stars stars(rows, vertex_count);
  Search search(rows, stars);
  std::vector<Index> starts, order;
  order.reserve(index(vertex_count));
  // Of each component a vertex of few rows among those that are farthest from its first one.
  for (Index v = 0; v < vertex_count; ++v) {
    if (search.reached(v) || stars.count(v) == 0) continue;
    const auto last = search.append(v, order);
    starts.push_back(*std::ranges::min_element(order.begin() + static_cast<std::ptrdiff_t>(last), order.end(), {},
                                               [&](Index w) { return stars.count(w); }));
  }
  search.next_round();
  order.clear();
  for (const Index start : starts) search.append(start, order);

  std::vector<Index> new_vertex(index(vertex_count), -1);
  const auto used = static_cast<Index>(order.size());
  for (Index i = 0; i < used; ++i) new_vertex[index(order[index(i)])] = used - 1 - i;
  Index last = used;
  for (Index& v : new_vertex)
    if (v < 0) v = last++;
  return with_rows_in_order(std::move(new_vertex), rows);
}

}  // namespace derham
