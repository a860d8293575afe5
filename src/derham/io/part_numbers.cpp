#include "derham/io/part_numbers.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

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

Offset simplices_in_several_parts(const MeshData& mesh) {
  Offset several = 0;
  std::vector<Index> members;
  for (int degree = 0; degree <= std::max(mesh.simplices.dimension(), 0); ++degree) {
    members.clear();
    for (const auto& part : mesh.parts)
      if (part.degree == degree) members.insert(members.end(), part.members.begin(), part.members.end());
    std::ranges::sort(members);
    for (std::size_t i = 1; i < members.size(); ++i)
      several += members[i] == members[i - 1] && (i == 1 || members[i] != members[i - 2]);
  }
  return several;
}

std::vector<std::string> lost_in_part_numbers(const MeshData& mesh) {
  Offset named = 0, silent = 0, repeated = 0;
  std::set<std::pair<int, std::int64_t>> numbers;
  for (const auto& part : mesh.parts) {
    named += !part.name.empty();
    silent += part.number == 0 || part.members.empty();
    repeated += !numbers.insert({part.degree, part.number}).second;
  }
  std::vector<std::string> lost;
  if (named > 0) lost.push_back(text("does not hold names of parts (", named, "), only their numbers"));
  if (silent > 0) lost.push_back(text("does not hold parts without members or with the number 0 (", silent, ")"));
  if (repeated > 0) lost.push_back(text("does not tell parts of the same number apart (", repeated, ")"));
  if (const auto several = simplices_in_several_parts(mesh); several > 0)
    lost.push_back(text("does not hold that simplices (", several, ") are in several parts, only the first"));
  if (!mesh.lower.empty() && !mesh.lower[0].empty())
    lost.push_back(text("does not hold points as simplices (", mesh.lower[0].size(), ")"));
  return lost;
}

}  // namespace derham
