#include "derham/io/gmsh_elements.hpp"

#include "derham/core/text.hpp"
#include "derham/io/read_hints.hpp"

#include <algorithm>
#include <utility>

namespace derham {
namespace {

struct NumberedType {
  std::uint8_t number;
  GmshType type;
};

// All element types that are simplices: complete and incomplete ones of order 1 to 10.
constexpr std::array simplex_types{
    NumberedType{15, {0, 1}},   NumberedType{1, {1, 2}},    NumberedType{8, {1, 3}},    NumberedType{26, {1, 4}},
    NumberedType{27, {1, 5}},   NumberedType{28, {1, 6}},   NumberedType{62, {1, 7}},   NumberedType{63, {1, 8}},
    NumberedType{64, {1, 9}},   NumberedType{65, {1, 10}},  NumberedType{66, {1, 11}},  NumberedType{2, {2, 3}},
    NumberedType{9, {2, 6}},    NumberedType{20, {2, 9}},   NumberedType{21, {2, 10}},  NumberedType{22, {2, 12}},
    NumberedType{23, {2, 15}},  NumberedType{24, {2, 15}},  NumberedType{25, {2, 21}},  NumberedType{42, {2, 28}},
    NumberedType{43, {2, 36}},  NumberedType{44, {2, 45}},  NumberedType{45, {2, 55}},  NumberedType{46, {2, 66}},
    NumberedType{52, {2, 18}},  NumberedType{53, {2, 21}},  NumberedType{54, {2, 24}},  NumberedType{55, {2, 27}},
    NumberedType{56, {2, 30}},  NumberedType{4, {3, 4}},    NumberedType{11, {3, 10}},  NumberedType{29, {3, 20}},
    NumberedType{30, {3, 35}},  NumberedType{31, {3, 56}},  NumberedType{71, {3, 84}},  NumberedType{72, {3, 120}},
    NumberedType{73, {3, 165}}, NumberedType{74, {3, 220}}, NumberedType{75, {3, 286}},
};

constexpr auto type_table = [] {
  std::array<GmshType, 76> table{};
  for (auto& entry : table) entry = {-1, 0};
  for (const auto& entry : simplex_types) table[entry.number] = entry.type;
  return table;
}();

constexpr std::int64_t quadrangle = 3;

const char* other_name(std::int64_t type) {
  switch (type) {
    case quadrangle:
      return "a quadrangle";
    case 5:
      return "a hexahedron";
    case 6:
      return "a prism";
    case 7:
      return "a pyramid";
    default:
      return type >= 10 && type <= 19 ? "a quadrangle, hexahedron, prism or pyramid of higher order" : "no simplex";
  }
}

}  // namespace

GmshType gmsh_type(std::int64_t type, const ReadOptions& options) noexcept {
  if (type == quadrangle && options.triangulate) return {2, 4};
  if (type < 0 || type >= std::ssize(type_table)) return {-1, 0};
  const auto found = type_table[static_cast<std::size_t>(type)];
  return found.nodes == found.degree + 1 || options.corner_nodes ? found : GmshType{-1, 0};
}

void fail_gmsh_type(const Cursor& file, std::int64_t type) {
  if (const auto found = gmsh_type(type, {.corner_nodes = true}); found.degree >= 0)
    file.fail(text("element type ", type, " is a ", static_cast<int>(found.degree), "-simplex of higher order with ",
                   found.nodes, " nodes; expected first order: mesh with gmsh -order 1, or ", keep_corner_nodes));
  file.fail(text("element type ", type, " is ", other_name(type),
                 "; expected points (15), lines (1), triangles (2) or tetrahedra (4): mesh with simplices",
                 type == quadrangle ? text(", or have them ", split_on_reading) : ""));
}

bool GmshElements::must_read_again() {
  if (is_ascending_ || !repeated_.empty()) return false;
  std::vector<std::int64_t> tags;
  for (int k = 0; k < 4; ++k) tags.insert(tags.end(), simplices_.tags(k).begin(), simplices_.tags(k).end());
  std::ranges::sort(tags);
  for (std::size_t i = 1; i < tags.size(); ++i)
    if (tags[i] == tags[i - 1] && (repeated_.empty() || repeated_.back() != tags[i])) repeated_.push_back(tags[i]);
  if (repeated_.empty()) return false;
  first_.resize(repeated_.size());
  simplices_.clear_simplices();
  quadrangles_.clear();
  higher_order_ = 0;
  return true;
}

Index GmshElements::add_quadrangle(std::span<const Index> row, std::int64_t tag, Index fourth) {
  is_ascending_ &= tag > last_;
  last_ = tag;
  const Index next = simplices_.size(2);
  const Index position = repeated_.empty() ? simplices_.add(row, tag) : add_repeated(row, tag, fourth);
  if (position == next) quadrangles_.push_back({position, fourth});
  return position;
}

Index GmshElements::fourth_corner(Index position) const noexcept {
  const auto found = std::ranges::lower_bound(quadrangles_, position, {}, &GmshQuadrangle::position);
  return found == quadrangles_.end() || found->position != position ? -1 : found->fourth_corner;
}

Index GmshElements::add_repeated(std::span<const Index> row, std::int64_t tag, Index fourth) {
  const auto found = std::ranges::lower_bound(repeated_, tag);
  if (found == repeated_.end() || *found != tag) return simplices_.add(row, tag);
  auto& first = first_[static_cast<std::size_t>(found - repeated_.begin())];
  const auto degree = static_cast<int>(row.size()) - 1;
  if (first.degree < 0) {
    first = {degree, simplices_.add(row, tag)};
  } else if (first.degree != degree || !std::ranges::equal(simplices_.row(degree, first.position), row) ||
             (degree == 2 && fourth_corner(first.position) != fourth)) {
    return -1;
  } else {
    ++merged_;
  }
  return first.position;
}

}  // namespace derham
