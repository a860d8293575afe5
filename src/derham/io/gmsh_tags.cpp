#include "derham/io/gmsh_tags.hpp"

#include <algorithm>

namespace derham {

TagPositions::TagPositions(std::span<const std::int64_t> tags)
    : count_(tags.size()), first_(tags.empty() ? 0 : tags[0]) {
  std::size_t i = 0;
  while (i < tags.size() && tags[i] - tags[0] == static_cast<std::int64_t>(i)) ++i;
  if (i == tags.size()) return;

  const auto [lowest, highest] = std::ranges::minmax(tags);
  first_ = lowest;
  if (highest - lowest < 8 * static_cast<std::int64_t>(tags.size())) {
    table_.assign(static_cast<std::size_t>(highest - lowest) + 1, -1);
    for (i = 0; i < tags.size() && repeated_ < 0; ++i) {
      auto& entry = table_[static_cast<std::size_t>(tags[i] - first_)];
      if (entry >= 0) repeated_ = static_cast<Index>(i);
      entry = static_cast<Index>(i);
    }
    return;
  }
  sorted_.reserve(tags.size());
  for (i = 0; i < tags.size(); ++i) sorted_.emplace_back(tags[i], static_cast<Index>(i));
  std::ranges::sort(sorted_);
  for (i = 1; i < sorted_.size(); ++i)
    if (sorted_[i - 1].first == sorted_[i].first && (repeated_ < 0 || sorted_[i].second < repeated_))
      repeated_ = sorted_[i].second;
}

Index TagPositions::search(std::int64_t tag) const noexcept {
  const auto found = std::ranges::lower_bound(sorted_, std::pair<std::int64_t, Index>(tag, 0));
  return found == sorted_.end() || found->first != tag ? -1 : found->second;
}

}  // namespace derham
