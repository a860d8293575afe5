#include "derham/complex/simplex_list.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace derham {

SimplexList::SimplexList(int degree, std::vector<Index> vertices) : vertices_(std::move(vertices)) {
  if (degree < 0) throw InputError(text("degree is ", degree, "; a simplex has degree 0 or more"));
  const auto width = static_cast<std::size_t>(degree) + 1;
  if (vertices_.size() % width != 0)
    throw InputError(text(vertices_.size(), " vertex ids do not fill rows of ", width));
  rows_ = static_cast<Offset>(vertices_.size() / width);
  degree_ = rows_ == 0 ? -1 : degree;
}

SimplexList::SimplexList(std::initializer_list<std::initializer_list<Index>> rows) {
  for (const auto& row : rows) push_back(row);
}

void SimplexList::push_back(std::span<const Index> row) {
  if (row.empty()) throw InputError(text("row ", rows_, " is empty; a simplex has at least one vertex"), rows_);
  const int degree = static_cast<int>(row.size()) - 1;
  if (offsets_.empty() && rows_ > 0 && degree != degree_) {
    offsets_.reserve(static_cast<std::size_t>(rows_) + 2);
    for (Offset i = 0; i <= rows_; ++i) offsets_.push_back(i * (degree_ + 1));
  }
  vertices_.insert(vertices_.end(), row.begin(), row.end());
  if (!offsets_.empty()) offsets_.push_back(static_cast<Offset>(vertices_.size()));
  degree_ = std::max(degree_, degree);
  ++rows_;
}

Index SimplexList::vertex_bound() const noexcept {
  if (vertices_.empty()) return 0;
  Index largest = vertices_[0];
  for (const Index v : vertices_) largest = std::max(largest, v);  // unlike max_element, several at a time
  return largest == std::numeric_limits<Index>::max() ? largest : largest + 1;
}

}  // namespace derham
