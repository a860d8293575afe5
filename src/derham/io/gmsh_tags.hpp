#pragma once

#include "derham/core/types.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// Where the node (or element) with a given number stands. Gmsh numbers from 1 up, but gaps and any order are allowed.
class TagPositions {
 public:
  TagPositions() = default;
  /// `tags` are not negative, and must outlive the object.
  explicit TagPositions(std::span<const std::int64_t> tags);

  /// The first position whose tag an earlier one has; -1 if there is none.
  [[nodiscard]] Index repeated() const noexcept { return repeated_; }

  /// The position of `tag`; -1 if there is no such tag.
  [[nodiscard]] Index operator[](std::int64_t tag) const noexcept {
    if (!sorted_.empty()) return search(tag);
    const auto position = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_);  // huge below first_
    if (!table_.empty()) return position < table_.size() ? table_[position] : -1;
    return position < count_ ? static_cast<Index>(position) : -1;
  }

 private:
  [[nodiscard]] Index search(std::int64_t tag) const noexcept;

  std::size_t count_ = 0;
  std::int64_t first_ = 0;
  std::vector<Index> table_;                            // when there are gaps or another order
  std::vector<std::pair<std::int64_t, Index>> sorted_;  // when the gaps are too wide for a table
  Index repeated_ = -1;
};

}  // namespace derham
