#pragma once

#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/options.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace derham {

/// How VTK calls a vertex, a line, a triangle, a tetrahedron: cell_types[k] is the k-simplex.
inline constexpr std::array<std::uint8_t, 4> vtk_cell_types{1, 3, 5, 10};

/// The cells of a VTK file, gathered until they become the simplices of a mesh.
class VtkCells {
 public:
  /// The points of all cells, one cell after the other.
  std::vector<Index> ids;

  /// The next cell ends before ids[end].
  void end_cell(Offset end) {
    if (count_ == 0) width_ = end;
    if (ends_.empty() && end == width_ * (count_ + 1)) {
      ++count_;
      return;
    }
    if (ends_.empty())
      for (Offset i = 1; i <= count_; ++i) ends_.push_back(i * width_);
    ends_.push_back(end);
    ++count_;
  }

  /// The VTK type of the next cell, counted on its own: types may come before or after the ends.
  void add_type(std::uint8_t type) {
    if (typed_ == 0) type_ = type;
    if (types_.empty() && type != type_) types_.assign(static_cast<std::size_t>(typed_), type_);
    if (type != type_ || !types_.empty()) types_.push_back(type);
    ++typed_;
  }

  [[nodiscard]] Offset size() const noexcept { return count_; }
  /// How many cells have a type.
  [[nodiscard]] Offset typed() const noexcept { return typed_; }
  /// How many points cell i has.
  [[nodiscard]] std::size_t width(Offset i) const noexcept {
    if (ends_.empty()) return static_cast<std::size_t>(width_);
    const Offset begin = i == 0 ? 0 : ends_[static_cast<std::size_t>(i) - 1];
    return static_cast<std::size_t>(ends_[static_cast<std::size_t>(i)] - begin);
  }

  /// Makes them the rows and the lower simplices of `mesh`, and of its fields on rows, which have a value for every
  /// cell, those of the rows alone. Refuses at the place of `file` cells that are no simplices.
  void move_to(MeshData& mesh, const ReadOptions& options, Cursor& file) &&;

 private:
  [[nodiscard]] std::span<const Index> cell(Offset i) const noexcept {
    const Offset begin = ends_.empty() ? i * width_ : i == 0 ? 0 : ends_[static_cast<std::size_t>(i) - 1];
    return std::span(ids).subspan(static_cast<std::size_t>(begin), width(i));
  }

  [[nodiscard]] int type(Offset i) const noexcept {
    return types_.empty() ? type_ : types_[static_cast<std::size_t>(i)];
  }

  Offset count_ = 0, width_ = 0, typed_ = 0;
  std::uint8_t type_ = 0;
  std::vector<Offset> ends_;         // empty while all cells have the same width
  std::vector<std::uint8_t> types_;  // empty while all have the same type
};

}  // namespace derham
