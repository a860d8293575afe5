#include "derham/operators/box_tree.hpp"

#include "derham/core/parallel.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace derham {

BoxTree::BoxTree(std::vector<double> boxes, int m) {
  constexpr std::size_t items_per_leaf = 4;
  const auto width = static_cast<std::size_t>(m);
  order_.resize(boxes.size() / (2 * width));
  std::iota(order_.begin(), order_.end(), Index{0});
  leaves_ = std::bit_ceil(order_.size() / items_per_leaf + 1);
  boxes_.resize(2 * leaves_ * 2 * width);
  // The nodes of a level hold different items.
  for (std::size_t nodes = 1; nodes <= leaves_; nodes *= 2)
    parallel_blocks(static_cast<Offset>(nodes), 1, [&](Offset i, Offset) {
      const auto place = static_cast<std::size_t>(i);
      cut(nodes + place, leaves_ / nodes * place, leaves_ / nodes * (place + 1), boxes, width);
    });
}

/// Sets the box of a node, and puts the items of its first half before the others.
void BoxTree::cut(std::size_t node, std::size_t first_leaf, std::size_t last_leaf, std::span<const double> boxes,
                  std::size_t m) {
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first_item(first_leaf)),
             end = order_.begin() + static_cast<std::ptrdiff_t>(first_item(last_leaf));
  const auto box = [&](Index item) { return boxes.subspan(static_cast<std::size_t>(item) * 2 * m, 2 * m); };
  std::size_t axis = 0;
  double longest = -1;
  for (std::size_t c = 0; c < m; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (auto item = begin; item != end; ++item) {
      low = std::min(low, box(*item)[c]);
      high = std::max(high, box(*item)[m + c]);
    }
    boxes_[node * 2 * m + c] = low;
    boxes_[node * 2 * m + m + c] = high;
    if (high - low > longest) {
      longest = high - low;
      axis = c;
    }
  }
  if (last_leaf - first_leaf < 2) return;
  const auto middle = order_.begin() + static_cast<std::ptrdiff_t>(first_item((first_leaf + last_leaf) / 2));
  const auto center = [&](Index item) { return box(item)[axis] / 2 + box(item)[m + axis] / 2; };
  std::nth_element(begin, middle, end, [&](Index a, Index b) {
    const double x = center(a), y = center(b);
    return x < y || (x == y && a < b);
  });
}

}  // namespace derham
