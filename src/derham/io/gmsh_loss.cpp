#include "derham/io/gmsh_loss.hpp"

#include "derham/core/text.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/gmsh_groups.hpp"
#include "derham/io/part_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace derham {
namespace {

// Why a file does not hold it, a phrase; empty: it does.
std::string name_fault(std::string_view name) {
  constexpr std::size_t longest = 127;
  if (name.size() > longest) return text("has more than ", longest, " bytes");
  const auto is_control = [](char c) { return (c >= 0 && c < 0x20 && c != '\t') || c == 0x7f; };
  return std::ranges::any_of(name, is_control) ? "has control characters" : "";
}
std::string field_fault(const MeshField& field) {
  if (const auto fault = name_fault(field.name); !fault.empty()) return "whose name " + fault;
  if (field.components > 9) return text("which has ", field.components, " components, more than 9");
  const bool is_finite = std::ranges::all_of(field.values, [](double value) { return std::isfinite(value); });
  return is_finite ? "" : "which has values that are not finite numbers";
}

// How many vertices are in parts, but no simplex of dimension 0.
Offset vertices_without_point(const MeshData& mesh) {
  if (mesh.simplices.dimension() == 0) return 0;
  std::set<Index> vertices;
  for (const auto& part : mesh.parts)
    if (part.degree == 0) vertices.insert(part.members.begin(), part.members.end());
  if (!mesh.lower.empty())
    for (const Index v : mesh.lower[0].vertices()) vertices.erase(v);
  return std::ssize(vertices);
}

}  // namespace

bool gmsh_holds_name(std::string_view name) { return name_fault(name).empty(); }
bool gmsh_holds_field(const MeshField& field) { return field_fault(field).empty(); }
int gmsh_components(int components) noexcept { return components == 1 ? 1 : components <= 3 ? 3 : 9; }

std::vector<std::string> lost_in_gmsh(const MeshData& mesh, const WriteOptions& options) {
  std::vector<std::string> lost;
  const auto say = [&](Offset count, const auto&... what) {
    if (count > 0) lost.push_back(text(what...));
  };
  const auto numbers = gmsh_group_numbers(mesh);
  Offset renumbered = 0, silent = 0, padded = 0;
  for (const auto& field : mesh.fields)
    if (const auto fault = field_fault(field); !fault.empty())
      lost.push_back(text("does not hold field ", quoted_token(field.name), ", ", fault));
    else
      padded += gmsh_components(field.components) != field.components;
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const auto& part = mesh.parts[p];
    const auto fault = name_fault(part.name);
    if (!fault.empty())
      lost.push_back(
          text("does not hold the name ", quoted_token(part.name), " of part ", part.number, ", which ", fault));
    const bool is_silent = part.members.empty() && (part.name.empty() || !fault.empty() || mesh.simplices.empty());
    silent += is_silent;
    renumbered += !is_silent && numbers[p] != part.number;
  }
  const auto points = vertices_without_point(mesh);
  const auto several = options.gmsh_41 ? 0 : simplices_in_several_parts(mesh);
  say(silent, "does not hold parts without members (", silent, ") that have no name");
  say(renumbered, "numbers the parts of a dimension from 1 to 2147483647, none twice: ", renumbered,
      " get other numbers");
  say(padded, "holds fields of 1, 3 or 9 components: ", padded, " are padded with zeros");
  say(points, "holds parts of vertices as points: ", points, " are added to the simplices of dimension 0");
  say(several, "2.2 lists simplices in several parts (", several,
      ") once for each, which others may take for copies; 4.1 does not (--gmsh-version 4.1, WriteOptions::gmsh_41)");
  return lost;
}

}  // namespace derham
