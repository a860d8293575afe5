#pragma once

#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// Gathers the simplices of a file that may list several dimensions: keeps those of the highest, counts the others.
class TopRows {
 public:
  void add(std::span<const Index> row) {
    if (keeps(static_cast<int>(row.size()) - 1)) vertices_.insert(vertices_.end(), row.begin(), row.end());
  }
  /// `tag` is the row's number in the file. Either all rows have one or none.
  void add(std::span<const Index> row, std::int64_t tag) {
    if (!keeps(static_cast<int>(row.size()) - 1)) return;
    vertices_.insert(vertices_.end(), row.begin(), row.end());
    tags_.push_back(tag);
  }

  /// Hands the rows to `mesh`.
  void move_to(MeshData& mesh) && {
    if (degree_ >= 0) mesh.simplices = SimplexList(degree_, std::move(vertices_));
    mesh.row_tags = std::move(tags_);
    mesh.ignored_lower = ignored_;
  }

 private:
  // Whether a row of this degree is to be kept; otherwise it is only counted.
  bool keeps(int degree) {
    if (degree == degree_) return true;
    if (degree < degree_) {
      ++ignored_;
      return false;
    }
    if (degree_ >= 0) ignored_ += static_cast<Offset>(vertices_.size()) / (degree_ + 1);
    vertices_.clear();
    tags_.clear();
    degree_ = degree;
    return true;
  }

  std::vector<Index> vertices_;
  std::vector<std::int64_t> tags_;
  Offset ignored_ = 0;
  int degree_ = -1;
};

}  // namespace derham
