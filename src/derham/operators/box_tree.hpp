#pragma once

#include "derham/core/types.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// A balanced binary tree of bounding boxes over items with boxes of their own, to find those near a point. Built by median
/// cuts across the longest side; the same for any number of threads.
class BoxTree {
 public:
  BoxTree() = default;

  /// `boxes` shape (items, 2, m): lowest, then highest coordinates.
  /// Cost     N log N; memory 4m + 1 numbers for every four items, and one index an item
  BoxTree(std::vector<double> boxes, int m);

  /// Calls visit(item) for every item whose box, or that of at most four items together, holds the point.
  template <class Visit>
  void for_each_near(std::span<const double> point, Visit&& visit) const {
    for_each_within(
        point, [] { return 0.0; }, visit);
  }

  /// Calls visit(item) for the items of every box that is not farther from the point than the root of reach(), nearer boxes
  /// first; reach() may shrink meanwhile.
  template <class Reach, class Visit>
  void for_each_within(std::span<const double> point, Reach&& reach, Visit&& visit) const {
    if (order_.empty()) return;
    struct Pending {
      std::size_t node;
      double square;
    };
    std::array<Pending, 130> stack{};
    std::size_t size = 0;
    stack[size++] = {1, squared_distance(1, point)};
    while (size > 0) {
      const auto [node, square] = stack[--size];
      if (!(square <= reach())) continue;
      if (node >= leaves_) {
        for (std::size_t i = first_item(node - leaves_); i < first_item(node - leaves_ + 1); ++i) visit(order_[i]);
        continue;
      }
      Pending a{2 * node, squared_distance(2 * node, point)}, b{2 * node + 1, squared_distance(2 * node + 1, point)};
      if (a.square <= b.square) std::swap(a, b);
      stack[size++] = a;
      stack[size++] = b;
    }
  }

 private:
  [[nodiscard]] std::size_t first_item(std::size_t leaf) const noexcept { return order_.size() * leaf / leaves_; }

  /// From the box of a node; NaN where the point is.
  [[nodiscard]] double squared_distance(std::size_t node, std::span<const double> point) const noexcept {
    const double* const low = boxes_.data() + node * 2 * point.size();
    const double* const high = low + point.size();
    double sum = 0;
    for (std::size_t c = 0; c < point.size(); ++c) {
      const double x = point[c], outside = x < low[c] ? low[c] - x : x > high[c] ? x - high[c] : x - x;
      sum += outside * outside;
    }
    return sum;
  }

  void cut(std::size_t node, std::size_t first_leaf, std::size_t last_leaf, std::span<const double> boxes,
           std::size_t m);

  std::vector<Index> order_;   // items, leaf after leaf
  std::size_t leaves_ = 1;     // a power of two; node i has the children 2i and 2i+1, the root is 1
  std::vector<double> boxes_;  // (2 leaves_, 2, m), of nodes; number 0 is not used
};

}  // namespace derham
