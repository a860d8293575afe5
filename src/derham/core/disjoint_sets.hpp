#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace derham {

/// A partition of 0 … size-1 that grows coarser: "union-find" with path halving.
class DisjointSets {
 public:
  /// Every element on its own.
  explicit DisjointSets(Index size = 0) { reset(size); }
  void reset(Index size) {
    parent_.resize(static_cast<std::size_t>(size));
    std::iota(parent_.begin(), parent_.end(), Index{0});
    count_ = size;
  }

  /// The smallest element of the set of `i`.
  [[nodiscard]] Index root(Index i) noexcept {
    while (parent(i) != i) {
      parent(i) = parent(parent(i));
      i = parent(i);
    }
    return i;
  }

  /// Joins the sets of a and b. False if they are the same one already.
  bool unite(Index a, Index b) noexcept {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parent(std::max(a, b)) = std::min(a, b);
    --count_;
    return true;
  }

  /// Number of sets.
  [[nodiscard]] Index count() const noexcept { return count_; }

 private:
  Index& parent(Index i) noexcept { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<Index> parent_;
  Index count_ = 0;
};

}  // namespace derham
