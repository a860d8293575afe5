#include "derham/io/gmsh_groups.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace derham {
namespace {

const SimplexList no_simplices;

}  // namespace

GmshGroups::GmshGroups(const MeshData& mesh, int degree, std::span<const std::int64_t> numbers) {
  const bool is_top = degree == mesh.simplices.dimension();
  const auto d = static_cast<std::size_t>(degree);
  listed_ = is_top ? &mesh.simplices : d < mesh.lower.size() ? &mesh.lower[d] : &no_simplices;
  set_.assign(static_cast<std::size_t>(listed_->size()), 0);

  // Parts of degree 0 name vertices; a file can name only those that it lists as points.
  std::vector<Index> next, first;
  if (degree == 0 && !is_top) {
    first.assign(static_cast<std::size_t>(mesh.vertex_count), -1);
    next.assign(set_.size(), -1);  // the next point on the same vertex
    for (Offset i = listed_->size(); i-- > 0;) {
      auto& head = first[static_cast<std::size_t>((*listed_)[i][0])];
      next[static_cast<std::size_t>(i)] = std::exchange(head, static_cast<Index>(i));
    }
    for (const auto& part : mesh.parts)
      for (std::size_t m = 0; part.degree == 0 && m < part.members.size(); ++m) {
        auto& head = first[static_cast<std::size_t>(part.members[m])];
        if (head >= 0) continue;
        head = static_cast<Index>(set_.size());
        extra_.push_back(part.members[m]);
        set_.push_back(0);
        next.push_back(-1);
      }
  }

  // A set of groups is another one and one group more; set 0 is empty.
  std::vector<std::pair<Index, std::int64_t>> sets{{0, 0}};
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    if (mesh.parts[p].degree != degree) continue;
    std::map<Index, Index> larger;
    const auto enlarge = [&](Index simplex) {
      auto& set = set_[static_cast<std::size_t>(simplex)];
      const auto [entry, is_new] = larger.try_emplace(set, static_cast<Index>(sets.size()));
      if (is_new) sets.emplace_back(set, numbers[p]);
      set = entry->second;
    };
    for (const Index member : mesh.parts[p].members) {
      if (first.empty()) {
        enlarge(member);
        continue;
      }
      for (Index i = first[static_cast<std::size_t>(member)]; i >= 0; i = next[static_cast<std::size_t>(i)]) enlarge(i);
    }
  }

  // Only sets that some simplex has become entities, in the order of their first simplex.
  std::vector<Index> entity_of(sets.size(), -1);
  for (Index& set : set_) {
    auto& entity = entity_of[static_cast<std::size_t>(set)];
    if (entity < 0) {
      entity = static_cast<Index>(groups_.size());
      auto& groups = groups_.emplace_back();
      for (Index s = set; s != 0; s = sets[static_cast<std::size_t>(s)].first)
        groups.push_back(sets[static_cast<std::size_t>(s)].second);
      std::ranges::sort(groups);
    }
    set = entity;
  }
}

void GmshGroups::require_readable_entities() const {
  constexpr std::int64_t element_bytes = 4, group_bytes = 2;  // at least
  std::int64_t memberships = 0, bytes = 0;
  for (Offset i = 0; i < size(); ++i) memberships += std::ssize(groups_of(i));
  for (const auto& groups : groups_) bytes += group_bytes * std::ssize(groups);
  bytes += element_bytes * size();
  if (memberships > gmsh_memberships_per_byte * bytes)
    throw InputError(text(size(), " simplices are in ", memberships,
                          " parts in all, more than derham reads of a .msh 4.1 file (", gmsh_memberships_per_byte,
                          " per byte); write format 2.2"));
}

std::vector<std::int64_t> gmsh_group_numbers(const MeshData& mesh) {
  constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int64_t> numbers(mesh.parts.size(), 0);
  std::set<std::pair<int, std::int64_t>> taken;
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const auto& part = mesh.parts[p];
    if (part.number >= 1 && part.number <= largest && taken.emplace(part.degree, part.number).second)
      numbers[p] = part.number;
  }
  std::map<int, std::int64_t> free;
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    if (numbers[p] != 0) continue;
    auto& number = free[mesh.parts[p].degree];
    do ++number;
    while (!taken.emplace(mesh.parts[p].degree, number).second);
    numbers[p] = number;
  }
  return numbers;
}

}  // namespace derham
