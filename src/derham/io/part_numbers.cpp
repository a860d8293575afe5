#include "derham/io/part_numbers.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cstddef>

namespace derham {

std::vector<std::int64_t> part_numbers(const MeshData& mesh, int degree, Offset count) {
  std::vector<std::int64_t> numbers;
  for (const auto& part : mesh.parts) {
    if (part.degree != degree) continue;
    numbers.resize(static_cast<std::size_t>(count), 0);
    for (const Index member : part.members) {
      if (member < 0 || member >= count)
        throw InputError(text("part ", part.number, " of degree ", degree, " has the member ", member,
                              "; expected 0 to ", count - 1));
      auto& number = numbers[static_cast<std::size_t>(member)];
      if (number == 0) number = part.number;
    }
  }
  return numbers;
}

std::vector<std::string> lost_in_part_numbers(const MeshData& mesh) {
  Offset named = 0, zero = 0;
  std::vector<Index> members;
  bool overlap = false;
  for (const auto& part : mesh.parts) {
    named += !part.name.empty();
    zero += part.number == 0 || part.members.empty();
  }
  const int top = std::max(mesh.simplices.dimension(), 0);
  for (int degree = 0; degree <= top && !overlap; ++degree) {
    members.clear();
    for (const auto& part : mesh.parts)
      if (part.degree == degree) members.insert(members.end(), part.members.begin(), part.members.end());
    std::ranges::sort(members);
    overlap = std::ranges::adjacent_find(members) != members.end();
  }
  std::vector<std::string> lost;
  if (named > 0) lost.push_back(text("names of parts (", named, "), only their numbers"));
  if (zero > 0) lost.push_back(text("parts without members or with the number 0 (", zero, ")"));
  if (overlap) lost.emplace_back("that a simplex is in several parts, only the first");
  return lost;
}

}  // namespace derham
