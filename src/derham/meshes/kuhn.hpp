#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

// This follows Freudenthal 1942 and Kuhn 1960: a cube is cut along its main diagonal into n! simplices, one for each
// order in which the axes are walked. Neighbouring cubes cut their common face alike.

namespace derham::meshes::detail {

/// The simplices of the unit n-cube, shape (n!, n+1) row-major: an entry is a corner of the cube, its bit a the
/// coordinate on axis a. Every simplex is positively oriented.
inline std::vector<std::uint8_t> kuhn_simplices(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::uint8_t> corners;
  do {
    unsigned corner = 0;
    corners.push_back(0);
    for (const int axis : order) corners.push_back(static_cast<std::uint8_t>(corner |= 1u << axis));
    bool odd = false;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) odd ^= order[j] > order[i];
    if (odd) std::swap(corners.end()[-1], corners.end()[-2]);
  } while (std::ranges::next_permutation(order).found);
  return corners;
}

/// A multi-index that counts through counts[0] x counts[1] x …, axis 0 fastest.
class GridIndex {
 public:
  explicit GridIndex(std::span<const Index> counts) : counts_(counts) {}

  [[nodiscard]] Index operator[](std::size_t axis) const noexcept { return at_[axis]; }
  [[nodiscard]] std::size_t size() const noexcept { return counts_.size(); }

  /// Steps to the next place; false (and back at the first) after the last.
  bool advance() noexcept {
    for (std::size_t axis = 0; axis < counts_.size(); ++axis) {
      if (++at_[axis] < counts_[axis]) return true;
      at_[axis] = 0;
    }
    return false;
  }

 private:
  std::span<const Index> counts_;
  std::array<Index, max_dimension> at_{};
};

/// The cut of grid cubes into simplices, appended to a vertex array cube by cube.
class KuhnCutter {
 public:
  explicit KuhnCutter(int n) : width_(static_cast<std::size_t>(n) + 1), simplices_(kuhn_simplices(n)) {}

  /// (n!, n+1) corners of the cube.
  [[nodiscard]] std::span<const std::uint8_t> simplices() const noexcept { return simplices_; }

  /// Appends the simplices of one cube, given the ids of its 2^n corners; those that touch a corner of id < 0 are left
  /// out.
  void cut(std::span<const Index> ids, std::vector<Index>& vertices) const {
    for (std::size_t s = 0; s < simplices_.size(); s += width_) {
      const auto first = simplices_.begin() + static_cast<std::ptrdiff_t>(s);
      const auto last = first + static_cast<std::ptrdiff_t>(width_);
      if (std::any_of(first, last, [&](std::uint8_t corner) { return ids[corner] < 0; })) continue;
      for (auto corner = first; corner != last; ++corner) vertices.push_back(ids[*corner]);
    }
  }

 private:
  std::size_t width_;
  std::vector<std::uint8_t> simplices_;
};

}  // namespace derham::meshes::detail
