#pragma once

#include "derham/core/large_pages.hpp"
#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace derham {

/// Gathers the simplices of a file that may list several dimensions, and the parts they belong to. In the end those of
/// the highest dimension become the rows of the mesh, the others its `lower` simplices.
class ListedSimplices {
 public:
  /// Appends a simplex of 1 to 4 vertices; returns its position among those of its degree.
  Index add(std::span<const Index> row) {
    auto& ids = vertices_[row.size() - 1];
    ids.insert(ids.end(), row.begin(), row.end());
    return count_[row.size() - 1]++;
  }
  /// As above; `tag` is the simplex' number in the file. Either all simplices of a degree have one or none.
  Index add(std::span<const Index> row, std::int64_t tag) {
    tags_[row.size() - 1].push_back(tag);
    return add(row);
  }

  [[nodiscard]] Index size(int degree) const noexcept { return count_[static_cast<std::size_t>(degree)]; }

  /// Room for `count` simplices in all, with their tags or without.
  void reserve(int degree, Index count, bool with_tags) {
    const auto d = static_cast<std::size_t>(degree);
    reserve_large(vertices_[d], static_cast<std::size_t>(count) * (d + 1));
    if (with_tags) reserve_large(tags_[d], static_cast<std::size_t>(count));
  }

  /// The vertices of the simplex at `position`, until the next one is added.
  [[nodiscard]] std::span<const Index> row(int degree, Index position) const noexcept {
    const auto width = static_cast<std::size_t>(degree) + 1;
    return std::span(vertices_[width - 1]).subspan(static_cast<std::size_t>(position) * width, width);
  }
  [[nodiscard]] std::span<const std::int64_t> tags(int degree) const noexcept {
    return tags_[static_cast<std::size_t>(degree)];
  }

  /// Puts simplex `position` of `degree` into the part `number`, which need not exist yet. A repeated one is kept once.
  void add_to_part(int degree, std::int64_t number, Index position) {
    auto& members = part(degree, number).members;
    if (members.empty() || members.back() != position) members.push_back(position);
  }

  /// Names the part `number`; a part without members is kept, too.
  void name_part(int degree, std::int64_t number, std::string name) { part(degree, number).name = std::move(name); }

  /// Forgets the simplices, but no part and no name.
  void clear_simplices() {
    vertices_ = {};
    tags_ = {};
    count_ = {};
    for (auto& part : parts_) part.members.clear();
  }

  /// Hands everything to `mesh`, which has its vertices already.
  void move_to(MeshData& mesh) &&;

 private:
  static constexpr std::size_t degrees = 4;

  MeshPart& part(int degree, std::int64_t number) {
    const auto d = static_cast<std::size_t>(degree);
    if (recent_[d] < parts_.size() && parts_[recent_[d]].number == number) return parts_[recent_[d]];
    const auto [entry, is_new] = part_of_[d].try_emplace(number, parts_.size());
    if (is_new) parts_.push_back({{}, number, degree, {}});
    recent_[d] = entry->second;
    return parts_[entry->second];
  }

  std::array<std::vector<Index>, degrees> vertices_;
  std::array<std::vector<std::int64_t>, degrees> tags_;
  std::array<Index, degrees> count_{};
  std::array<std::map<std::int64_t, std::size_t>, degrees> part_of_;
  std::array<std::size_t, degrees> recent_{~std::size_t{0}, ~std::size_t{0}, ~std::size_t{0}, ~std::size_t{0}};
  std::vector<MeshPart> parts_;
};

}  // namespace derham
