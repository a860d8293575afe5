#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/form_size.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/npz_arrays.hpp"

#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr std::int64_t most_vertices = std::numeric_limits<Index>::max() - 1;

class Reader {
 public:
  explicit Reader(Cursor& file) : arrays_(file), file_name_(file.name()) {
    for (const auto& name : arrays_.others())
      mesh_.notes.push_back(text("skipped the entry ", quoted_token(name), ": no array"));
  }

  MeshData read() && {
    if (!arrays_.contains("simplices"))
      arrays_.fail("there is no array called simplices; expected one of shape (rows, n+1)");
    read_vertices();
    arrays_.with("simplices",
                 [&](const NpyArray& array, const NpyFail& fail) { mesh_.simplices = rows(array, -1, fail); });
    if (mesh_.vertex_count < 0) mesh_.vertex_count = mesh_.simplices.vertex_bound();
    rows_ = mesh_.simplices.size();
    read_metric();
    read_tags();
    read_lower();
    read_parts();
    for (const auto name : arrays_.unused()) read_named(name);
    return std::move(mesh_);
  }

 private:
  // Number of vertices: of the positions, or said, or (-1) as many as the rows name.
  void read_vertices() {
    mesh_.vertex_count = -1;
    arrays_.with("vertex_count", [&](const NpyArray& array, const NpyFail& fail) {
      require_integers(array, fail);
      require_shape(array, {}, "", fail);
      mesh_.vertex_count = npy_ids(array, most_vertices + 1, "the number of vertices", fail)[0];
    });
    arrays_.with("points", [&](const NpyArray& array, const NpyFail& fail) {
      if (array.shape.size() != 2 || array.shape[1] < 1 || array.shape[1] > max_dimension)
        fail(text("the array has the shape ", array.shape_text(), "; expected (vertices, m) with m from 1 to ",
                  max_dimension));
      if (mesh_.vertex_count >= 0)
        require_shape(array, {mesh_.vertex_count, array.shape[1]}, " as vertex_count says", fail);
      if (array.shape[0] > most_vertices)
        throw LimitError(
            text(file_name_, ": more vertices than this build's index type can number; build with DERHAM_INDEX64"));
      mesh_.vertex_count = static_cast<Index>(array.shape[0]);
      mesh_.ambient_dimension = static_cast<int>(array.shape[1]);
      mesh_.points = npz_reals(array, true, fail);
    });
  }

  // Simplices of the given degree, or of any.
  SimplexList rows(const NpyArray& array, int degree, const NpyFail& fail) {
    require_integers(array, fail);
    const bool is_table = array.shape.size() == 2;
    if (!is_table || array.shape[1] > max_dimension + 1 || (array.shape[1] < 1 && array.shape[0] > 0) ||
        (degree >= 0 && array.shape[1] != degree + 1))
      fail(text("the array has the shape ", array.shape_text(), "; expected (rows, ",
                degree >= 0 ? std::to_string(degree + 1) : "n+1", ") with n at most ", max_dimension));
    if (array.shape[0] > most_vertices)
      throw LimitError(
          text(file_name_, ": more simplices than this build's index type can number; build with DERHAM_INDEX64"));
    const auto bound = mesh_.vertex_count >= 0 ? std::int64_t{mesh_.vertex_count} : most_vertices;
    auto ids = npy_ids(array, bound, "a vertex id", fail);
    return ids.empty() ? SimplexList() : SimplexList(static_cast<int>(array.shape[1]) - 1, std::move(ids));
  }

  void read_metric() {
    arrays_.with("corners", [&](const NpyArray& array, const NpyFail& fail) {
      if (mesh_.has_points()) fail("there are both points and corners; expected one of them");
      const auto m = array.shape.size() == 3 ? array.shape[2] : 0;
      if (m < 1 || m > max_dimension)
        fail(text("the array has the shape ", array.shape_text(), "; expected (rows, n+1, m) with m from 1 to ",
                  max_dimension));
      require_shape(array, {rows_, mesh_.simplices.dimension() + 1, m}, ", a position for every corner", fail);
      mesh_.ambient_dimension = static_cast<int>(m);
      mesh_.corners = npz_reals(array, true, fail);
    });
    arrays_.with("edge_lengths_squared", [&](const NpyArray& array, const NpyFail& fail) {
      require_shape(array, {array.shape.empty() ? 0 : array.shape[0]}, ", a number for every edge", fail);
      mesh_.edge_lengths_squared = npz_reals(array, true, fail);
      const auto negative = std::ranges::find_if(mesh_.edge_lengths_squared, [](double square) { return square < 0; });
      if (negative != mesh_.edge_lengths_squared.end())
        fail(text("number ", negative - mesh_.edge_lengths_squared.begin(), " of the array is ", *negative,
                  "; expected squares of lengths"));
    });
  }

  void read_tags() {
    const auto tags = [&](const char* name, std::int64_t count, std::vector<std::int64_t>& out) {
      arrays_.with(name, [&](const NpyArray& array, const NpyFail& fail) {
        require_integers(array, fail);
        require_shape(array, {count}, "", fail);
        out = npy_integers(array);
      });
    };
    tags("vertex_tags", mesh_.vertex_count, mesh_.vertex_tags);
    tags("row_tags", rows_, mesh_.row_tags);
  }

  void read_lower() {
    for (int k = 0; k < mesh_.simplices.dimension(); ++k)
      arrays_.with(lower_names[static_cast<std::size_t>(k)], [&](const NpyArray& array, const NpyFail& fail) {
        auto list = rows(array, k, fail);
        if (list.empty()) return;
        mesh_.lower.resize(static_cast<std::size_t>(k) + 1);
        mesh_.lower.back() = std::move(list);
      });
  }

  void read_parts() {
    arrays_.with("part_numbers", [&](const NpyArray& array, const NpyFail& fail) {
      require_integers(array, fail);
      require_shape(array, {array.shape.empty() ? 0 : array.shape[0]}, "", fail);
      for (const auto number : npy_integers(array)) mesh_.parts.push_back({{}, number, 0, {}});
    });
    const auto count = static_cast<std::int64_t>(mesh_.parts.size());
    if (count == 0) return;
    for (const auto* name : {"part_degrees", "part_offsets", "part_members"})
      if (!arrays_.contains(name)) arrays_.fail(text("there is part_numbers, but no array called ", name));
    arrays_.with("part_degrees", [&](const NpyArray& array, const NpyFail& fail) {
      require_integers(array, fail);
      require_shape(array, {count}, " as part_numbers has", fail);
      const auto degrees = npy_ids(array, std::max(mesh_.simplices.dimension(), 0) + 1, "a degree", fail);
      std::set<std::pair<Index, std::int64_t>> seen;
      for (std::size_t i = 0; i < degrees.size(); ++i) {
        mesh_.parts[i].degree = static_cast<int>(degrees[i]);
        if (!seen.emplace(degrees[i], mesh_.parts[i].number).second)
          fail(text("there are two parts of degree ", degrees[i], " with the number ", mesh_.parts[i].number));
      }
    });
    std::vector<std::int64_t> offsets;
    arrays_.with("part_offsets", [&](const NpyArray& array, const NpyFail& fail) {
      require_integers(array, fail);
      require_shape(array, {count + 1}, ", one more than part_numbers has", fail);
      offsets = npy_integers(array);
      if (offsets[0] != 0 || !std::ranges::is_sorted(offsets)) fail("the offsets do not increase from 0");
    });
    arrays_.with("part_members", [&](const NpyArray& array, const NpyFail& fail) {
      require_integers(array, fail);
      require_shape(array, {offsets.back()}, " as part_offsets ends", fail);
      const auto members = npy_ids(array, most_vertices, "a member of a part", fail);
      for (std::size_t i = 0; i < mesh_.parts.size(); ++i) take_members(i, offsets, members, fail);
    });
    arrays_.with("part_names", [&](const NpyArray& array, const NpyFail& fail) {
      if (array.kind != 'S' && array.kind != 'U')
        fail(text("the array has the type ", array.kind, array.item_bytes, "; expected text"));
      require_shape(array, {count}, " as part_numbers has", fail);
      for (std::size_t i = 0; i < mesh_.parts.size(); ++i) mesh_.parts[i].name = npz_text(array, i, fail);
    });
  }

  void take_members(std::size_t i, const std::vector<std::int64_t>& offsets, const std::vector<Index>& members,
                    const NpyFail& fail) {
    auto& part = mesh_.parts[i];
    part.members.assign(members.begin() + offsets[i], members.begin() + offsets[i + 1]);
    const auto degree = static_cast<std::size_t>(part.degree);
    const Offset bound = part.degree == mesh_.simplices.dimension() ? rows_
                         : part.degree == 0                         ? Offset{mesh_.vertex_count}
                         : degree < mesh_.lower.size()              ? mesh_.lower[degree].size()
                                                                    : 0;
    for (std::size_t j = 0; j < part.members.size(); ++j) {
      if (part.members[j] >= bound)
        fail(text("part ", part.number, " has the member ", part.members[j], " of ", bound, " simplices of degree ",
                  part.degree));
      if (j > 0 && part.members[j] <= part.members[j - 1])
        fail(text("the members of part ", part.number, " do not increase"));
    }
  }

  // Fields and forms, whose names say what they are; the rest is skipped.
  void read_named(std::string_view name) {
    if (name.starts_with("point_data_")) return read_field(name, 11, MeshField::On::vertices, mesh_.vertex_count);
    if (name.starts_with("row_data_")) return read_field(name, 9, MeshField::On::rows, rows_);
    if (name.starts_with("form_") && read_form(name)) return;
    mesh_.notes.push_back(text("skipped the array ", quoted_token(name)));
  }

  void read_field(std::string_view name, std::size_t prefix, MeshField::On on, std::int64_t items) {
    arrays_.with(name, [&](const NpyArray& array, const NpyFail& fail) {
      if (array.shape.empty() || array.shape.size() > 2 || array.shape[0] != items)
        fail(text("the array has the shape ", array.shape_text(), "; expected (", items, ",) or (", items,
                  ", components)"));
      const auto components = array.shape.size() == 2 ? array.shape[1] : 1;
      constexpr int most = 1 << 20;
      if (components < 1 || components > most)
        fail(text("the array has ", components, " components; expected 1 to ", most));
      mesh_.fields.push_back(
          {std::string(name.substr(prefix)), on, static_cast<int>(components), npz_reals(array, false, fail)});
    });
  }

  // "form_<name>_<degree>_<primal|dual>". False if the name is not of that kind.
  bool read_form(std::string_view name) {
    MeshForm form;
    auto rest = name.substr(5);
    const auto side = rest.rfind('_');
    if (side == std::string_view::npos || side == 0) return false;
    form.is_dual = rest.substr(side + 1) == "dual";
    if (!form.is_dual && rest.substr(side + 1) != "primal") return false;
    rest = rest.substr(0, side);
    const auto degree = rest.rfind('_');
    if (degree == std::string_view::npos || rest.size() != degree + 2 || rest.back() < '0' ||
        rest.back() > '0' + max_dimension)
      return false;
    form.degree = rest.back() - '0';
    form.name = rest.substr(0, degree);
    arrays_.with(name, [&](const NpyArray& array, const NpyFail& fail) {
      require_shape(array, {array.shape.empty() ? 0 : array.shape[0]}, ", a number for every simplex", fail);
      form.values = npz_reals(array, false, fail);
      if (const auto defect = form_defect(mesh_, form); !defect.empty()) fail("the array is " + defect);
    });
    mesh_.forms.push_back(std::move(form));
    return true;
  }

  static constexpr std::string_view lower_names[] = {"lower_0", "lower_1", "lower_2", "lower_3", "lower_4", "lower_5"};

  NpzArrays arrays_;
  std::string file_name_;
  MeshData mesh_;
  Offset rows_ = 0;
};

}  // namespace

MeshData read_npz(Cursor& file, const ReadOptions&) { return Reader(file).read(); }

}  // namespace derham
