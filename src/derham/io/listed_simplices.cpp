#include "derham/io/listed_simplices.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace derham {

void ListedSimplices::move_to(MeshData& mesh) && {
  int top = static_cast<int>(degrees) - 1;
  while (top > 0 && size(top) == 0) --top;
  if (size(top) > 0) mesh.simplices = SimplexList(top, std::move(vertices_[static_cast<std::size_t>(top)]));
  mesh.row_tags = std::move(tags_[static_cast<std::size_t>(top)]);
  for (int k = 0; k < top; ++k) {
    auto& ids = vertices_[static_cast<std::size_t>(k)];
    mesh.lower.push_back(ids.empty() ? SimplexList() : SimplexList(k, std::move(ids)));
  }
  while (!mesh.lower.empty() && mesh.lower.back().empty()) mesh.lower.pop_back();

  for (auto& part : parts_) {
    if (part.degree == 0 && top > 0) {  // members of dimension 0 are vertices, not rows of lower[0]
      for (Index& member : part.members) member = mesh.lower[0][member][0];
    }
    if (std::ranges::adjacent_find(part.members, std::greater_equal<>()) != part.members.end()) {
      std::ranges::sort(part.members);
      const auto repeated = std::ranges::unique(part.members);
      part.members.erase(repeated.begin(), repeated.end());
    }
    mesh.parts.push_back(std::move(part));
  }
  std::ranges::stable_sort(mesh.parts, [](const MeshPart& a, const MeshPart& b) {
    return std::pair(b.degree, a.number) < std::pair(a.degree, b.number);  // highest dimension first
  });
}

}  // namespace derham
