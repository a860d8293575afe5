#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace derham {

/// Trees of elements that have a sign each; trees are joined to sets, and a set is named by its first tree. A sign is
/// known against that of the first element of a tree: the word 2 * tree if they are equal, 2 * tree + 1 if opposite.
/// Internal to the room: the orientation grows trees of top simplices.
/// Source   Tarjan & van Leeuwen, "Worst-case analysis of set union algorithms", 1984 (path halving), with a parity
class SignedTrees {
 public:
  using Word = std::make_unsigned_t<Index>;

  /// A new tree; the sign of its first element.
  Word plant() {
    parent_.push_back(static_cast<Word>(2 * parent_.size()));
    return parent_.back();
  }

  /// The same sign against the first tree of the set.
  [[nodiscard]] Word root(Word w) noexcept {
    for (Word p = parent(w); p / 2 != w / 2; p = parent(w)) {
      parent(w) = parent(p) ^ (p & 1);
      w = parent(w) ^ (w & 1);
    }
    return w;
  }

  /// a and b are the same sign. Remembered until `settle`, which is called now and then: by that time their trees have
  /// come into the cache.
  void unite(Word a, Word b) noexcept {
    __builtin_prefetch(&parent(a));
    __builtin_prefetch(&parent(b));
    waiting_[waiting_count_++] = {a, b};
    if (waiting_count_ == waiting_.size()) settle();
  }
  void settle() noexcept {
    for (const auto& [a, b] : std::span(waiting_).first(waiting_count_)) {
      const Word root_a = root(a), root_b = root(b);
      const Word first = std::min(root_a, root_b), second = std::max(root_a, root_b);
      if (first / 2 != second / 2) {
        parent(second) = first ^ (second & 1);
        reversing_ = reversing_ || (parent(second) & 1) != 0;
        ++joined_;
      } else if (first != second) {
        contradictory_ = true;
      }
    }
    waiting_count_ = 0;
  }

  /// Whether some sign would have to be its own opposite.
  [[nodiscard]] bool contradictory() const noexcept { return contradictory_; }
  /// Whether some tree is reversed against the one that it was joined to.
  [[nodiscard]] bool reversing() const noexcept { return reversing_; }
  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(parent_.size()); }
  [[nodiscard]] Index sets() const noexcept { return size() - joined_; }

 private:
  Word& parent(Word w) noexcept { return parent_[static_cast<std::size_t>(w / 2)]; }

  std::vector<Word> parent_;
  std::array<std::pair<Word, Word>, 64> waiting_{};
  std::size_t waiting_count_ = 0;
  Index joined_ = 0;
  bool contradictory_ = false, reversing_ = false;
};

}  // namespace derham
