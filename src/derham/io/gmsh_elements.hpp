#pragma once

#include "derham/io/gmsh_input.hpp"
#include "derham/io/gmsh_quadrangles.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/options.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace derham {

/// A type of element that is a simplex, whose corners are its first degree+1 nodes, or a quadrangle.
struct GmshType {
  std::int8_t degree;
  std::int16_t nodes;

  [[nodiscard]] bool is_quadrangle() const noexcept { return degree == 2 && nodes == 4; }
  [[nodiscard]] bool is_higher_order() const noexcept { return nodes > degree + 1 && !is_quadrangle(); }
};

/// Gmsh's number of the element type of a k-simplex of first order.
inline constexpr std::array gmsh_simplex_types{15, 1, 2, 4};

/// What Gmsh's element type `type` is; of degree -1 if it is neither a simplex nor, to be split, a quadrangle, or (unless
/// corner nodes are enough) one of higher order.
[[nodiscard]] GmshType gmsh_type(std::int64_t type, const ReadOptions& options) noexcept;
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
    return repeated_.empty() ? simplices_.add(row, tag) : add_repeated(row, tag, -1);
  }
  /// As above, for an element of this type, of which `nodes` are the first four.
  Index add(GmshType type, const std::array<Index, 4>& nodes, std::int64_t tag) {
    const auto row = std::span(nodes).first(static_cast<std::size_t>(type.degree) + 1);
    return type.is_quadrangle() ? add_quadrangle(row, tag, nodes[3]) : add(row, tag);
  }

  /// Whether numbers repeat and the elements were not read as such: then everything is forgotten, to be read again.
  [[nodiscard]] bool must_read_again();

  /// Counts elements of higher order, of which the corner nodes are kept.
  void count_higher_order(Index count) noexcept { higher_order_ += count; }
  [[nodiscard]] Offset higher_order() const noexcept { return higher_order_; }
  /// How many elements were listed again and left out.
  [[nodiscard]] Offset merged() const noexcept { return merged_; }

  /// The triangles among them stand for quadrangles where `quadrangles` says so.
  [[nodiscard]] ListedSimplices& simplices() noexcept { return simplices_; }
  [[nodiscard]] const std::vector<GmshQuadrangle>& quadrangles() const noexcept { return quadrangles_; }

 private:
  Index add_repeated(std::span<const Index> row, std::int64_t tag, Index fourth);
  Index add_quadrangle(std::span<const Index> row, std::int64_t tag, Index fourth);
  [[nodiscard]] Index fourth_corner(Index position) const noexcept;  // -1: a triangle

  struct First {
    int degree = -1;
    Index position = -1;
  };
  ListedSimplices simplices_;
  std::vector<GmshQuadrangle> quadrangles_;
  std::vector<std::int64_t> repeated_;  // numbers that the file has more than once, in order
  std::vector<First> first_;            // where each stood first
  std::int64_t last_ = -1;
  bool is_ascending_ = true;
  Offset higher_order_ = 0, merged_ = 0;
};

}  // namespace derham
