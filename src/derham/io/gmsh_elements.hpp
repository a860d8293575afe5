#pragma once

#include "derham/io/gmsh_input.hpp"
#include "derham/io/listed_simplices.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace derham {

/// A type of element that is a simplex. The corners are its first degree+1 nodes.
struct GmshType {
  std::int8_t degree;
  std::int16_t nodes;
};

/// Gmsh's number of the element type of a k-simplex of first order.
inline constexpr std::array gmsh_simplex_types{15, 1, 2, 4};

/// What Gmsh's element type `type` is; of degree -1 if it is no simplex, or (unless corner nodes are enough) one of higher
/// order.
[[nodiscard]] GmshType gmsh_type(std::int64_t type, bool corner_nodes) noexcept;
/// Refuses, at the cursor, a type of degree -1 by its name.
[[noreturn]] void fail_gmsh_type(const Cursor& file, std::int64_t type);

/// The elements of a file. An element in several physical groups may be listed once for each, with the same number:
/// that makes one simplex.
///
/// The numbers of nearly all files ascend, and then nothing repeats. In others `must_read_again` finds what repeats;
/// the second reading then knows which numbers to look at.
class GmshElements {
 public:
  /// Room for `count` simplices, if they are the first of their degree.
  void expect(int degree, Index count) {
    if (simplices_.size(degree) == 0) simplices_.reserve(degree, count, true);
  }

  /// Takes an element; returns its position among the simplices of its degree, -1 if its number belongs to another one.
  Index add(std::span<const Index> row, std::int64_t tag) {
    is_ascending_ &= tag > last_;
    last_ = tag;
    return repeated_.empty() ? simplices_.add(row, tag) : add_repeated(row, tag);
  }

  /// Whether numbers repeat and the elements were not read as such: then everything is forgotten, to be read again.
  [[nodiscard]] bool must_read_again();

  /// Counts elements of higher order, of which the corner nodes are kept.
  void count_higher_order(Index count) noexcept { higher_order_ += count; }
  [[nodiscard]] Offset higher_order() const noexcept { return higher_order_; }
  /// How many elements were listed again and left out.
  [[nodiscard]] Offset merged() const noexcept { return merged_; }

  [[nodiscard]] ListedSimplices& simplices() noexcept { return simplices_; }

 private:
  Index add_repeated(std::span<const Index> row, std::int64_t tag);

  struct First {
    int degree = -1;
    Index position = -1;
  };
  ListedSimplices simplices_;
  std::vector<std::int64_t> repeated_;  // numbers that the file has more than once, in order
  std::vector<First> first_;            // where each stood first
  std::int64_t last_ = -1;
  bool is_ascending_ = true;
  Offset higher_order_ = 0, merged_ = 0;
};

}  // namespace derham
