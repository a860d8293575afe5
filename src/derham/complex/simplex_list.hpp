#pragma once

#include "derham/core/types.hpp"

#include <initializer_list>
#include <span>
#include <vector>

namespace derham {

/// A list of simplices as they were given: any vertex order, any mixture of dimensions, nothing checked yet.
/// This is what readers and generators produce and what a `SimplicialComplex` is built from. Row i is simplex i.
class SimplexList {
 public:
  SimplexList() = default;

  /// `vertices` holds rows of `degree`+1 ids each, row-major. Throws InputError if its size is no multiple of degree+1.
  SimplexList(int degree, std::vector<Index> vertices);

  /// Rows written out, e.g. {{0, 1, 2}, {1, 2, 3}}. Throws InputError on an empty row.
  SimplexList(std::initializer_list<std::initializer_list<Index>> rows);

  /// Appends one simplex of size()-1 >= 0. Throws InputError if `row` is empty.
  void push_back(std::span<const Index> row);
  void push_back(std::initializer_list<Index> row) { push_back(std::span<const Index>(row.begin(), row.size())); }

  [[nodiscard]] Offset size() const noexcept { return rows_; }
  [[nodiscard]] bool empty() const noexcept { return rows_ == 0; }

  /// The vertices of row i, in the order given.
  [[nodiscard]] std::span<const Index> operator[](Offset i) const noexcept {
    if (offsets_.empty()) {
      const auto width = static_cast<std::size_t>(degree_ + 1);
      return {vertices_.data() + static_cast<std::size_t>(i) * width, width};
    }
    const auto begin = offsets_[static_cast<std::size_t>(i)];
    return {vertices_.data() + begin, static_cast<std::size_t>(offsets_[static_cast<std::size_t>(i) + 1] - begin)};
  }

  /// The largest dimension of a row; -1 for an empty list.
  [[nodiscard]] int dimension() const noexcept { return degree_; }

  /// Whether all rows have the same dimension (an empty list is uniform).
  [[nodiscard]] bool is_uniform() const noexcept { return offsets_.empty(); }

  /// All vertex ids, row after row.
  [[nodiscard]] std::span<const Index> vertices() const noexcept { return vertices_; }
  [[nodiscard]] std::span<Index> vertices() noexcept { return vertices_; }

  /// 1 + the largest id, but no more than Index holds; 0 for an empty list. Meaningful only when no id is negative.
  [[nodiscard]] Index vertex_bound() const noexcept;

  friend bool operator==(const SimplexList&, const SimplexList&) = default;

 private:
  std::vector<Index> vertices_;
  std::vector<Offset> offsets_;  // empty while all rows have the same length
  Offset rows_ = 0;
  int degree_ = -1;
};

}  // namespace derham
