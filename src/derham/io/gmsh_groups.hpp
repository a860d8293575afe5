#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace derham {

/// A file of format 4.1 may put its elements into so many physical groups in all, per byte of its size: few bytes could
/// name many groups and have many elements in each of them.
inline constexpr std::int64_t gmsh_memberships_per_byte = 16;

/// What a .msh file lists of one degree, in order, and for each simplex in which physical groups it is. Simplices in the
/// same groups are one entity of Gmsh.
class GmshGroups {
 public:
  /// `numbers[p]` is the number of the physical group of part p.
  GmshGroups(const MeshData& mesh, int degree, std::span<const std::int64_t> numbers);

  [[nodiscard]] Offset size() const noexcept { return static_cast<Offset>(set_.size()); }
  [[nodiscard]] std::span<const Index> simplex(Offset i) const noexcept {
    return i < listed_->size() ? (*listed_)[i]
                               : std::span(extra_).subspan(static_cast<std::size_t>(i - listed_->size()), 1);
  }
  /// The entity of simplex i, 0 to entities().size()-1.
  [[nodiscard]] Index entity(Offset i) const noexcept { return set_[static_cast<std::size_t>(i)]; }
  /// The physical groups of simplex i, in increasing order.
  [[nodiscard]] std::span<const std::int64_t> groups_of(Offset i) const noexcept {
    return groups_[static_cast<std::size_t>(entity(i))];
  }
  /// Throws InputError if a 4.1 file of these could be refused: it names the groups once per entity, and the reader takes
  /// no more memberships than `gmsh_memberships_per_byte` of the file.
  void require_readable_entities() const;
  /// The physical groups of every entity, in increasing order.
  [[nodiscard]] const std::vector<std::vector<std::int64_t>>& entities() const noexcept { return groups_; }

 private:
  const SimplexList* listed_;
  std::vector<Index> extra_;  // vertices of parts that the list has not
  std::vector<Index> set_;
  std::vector<std::vector<std::int64_t>> groups_;
};

/// A number from 1 to 2^31-1 for every part, unique in its degree: its own if it is one, else the next that is free.
[[nodiscard]] std::vector<std::int64_t> gmsh_group_numbers(const MeshData& mesh);

}  // namespace derham
