#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/gmsh_elements.hpp"
#include "derham/io/gmsh_groups.hpp"
#include "derham/io/gmsh_loss.hpp"
#include "derham/io/gmsh_output.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace derham {
namespace {

struct Source {
  const MeshData& mesh;
  std::vector<std::int64_t> numbers;  // of the parts
  // All that the file lists, by decreasing degree: the rows come first, so that row i is element i+1.
  std::vector<GmshGroups> listed;

  [[nodiscard]] int degree_of(std::size_t list) const { return static_cast<int>(listed.size() - 1 - list); }
  [[nodiscard]] int type_of(std::size_t list) const {
    return gmsh_simplex_types[static_cast<std::size_t>(degree_of(list))];
  }
  [[nodiscard]] double coordinate(Index vertex, int axis) const {
    const int m = mesh.ambient_dimension;
    if (axis >= m) return 0;
    return mesh.points[static_cast<std::size_t>(vertex) * static_cast<std::size_t>(m) + static_cast<std::size_t>(axis)];
  }
  void put_position(GmshOutput& out, Index vertex) const {
    for (int axis = 0; axis < 3; ++axis) out.real(coordinate(vertex, axis));
  }
};

void require_fit(const Source& source, bool is_41, bool is_binary) {
  const auto& mesh = source.mesh;
  Offset elements = 0;
  for (const auto& list : source.listed) elements += list.size();
  // The numbers of 2.2, and in binary files those that data belong to, have 32 bits.
  constexpr auto most = std::int64_t{std::numeric_limits<std::int32_t>::max()};
  if (is_binary && (!is_41 || std::ranges::any_of(mesh.fields, gmsh_holds_field)) &&
      std::max(Offset{mesh.vertex_count}, elements) > most)
    throw InputError(text("a binary .msh ", is_41 ? "4.1 with fields" : "2.2", " numbers at most ", most,
                          " vertices and simplices; write text"));
  if (is_41)
    for (const auto& list : source.listed) list.require_readable_entities();
}

void write_names(GmshOutput& out, const Source& source) {
  const auto& parts = source.mesh.parts;
  const auto is_named = [](const MeshPart& part) { return !part.name.empty() && gmsh_holds_name(part.name); };
  const auto named = std::ranges::count_if(parts, is_named);
  if (named == 0) return;
  out.open("PhysicalNames");
  out.file.put(named).put('\n');
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (is_named(parts[p]))
      out.file.put(parts[p].degree).put(' ').put(source.numbers[p]).put(" \"").put(parts[p].name).put("\"\n");
  out.file.put("$EndPhysicalNames\n");
}

void write_nodes_22(GmshOutput& out, const Source& source) {
  out.open("Nodes");
  out.file.put(source.mesh.vertex_count).put('\n');
  for (Index v = 0; v < source.mesh.vertex_count; ++v) {
    out.integer(std::int64_t{v} + 1);
    source.put_position(out, v);
    out.end();
  }
  out.close("Nodes");
}

void write_elements_22(GmshOutput& out, const Source& source) {
  // An element in several groups is listed once for each, with the same number.
  const auto times = [](const GmshGroups& list, Offset i) {
    return std::max<Offset>(std::ssize(list.groups_of(i)), 1);
  };
  std::vector<Offset> counts;
  Offset total = 0;
  for (const auto& list : source.listed) {
    counts.push_back(0);
    for (Offset i = 0; i < list.size(); ++i) counts.back() += times(list, i);
    total += counts.back();
  }
  out.open("Elements");
  out.file.put(total).put('\n');
  std::int64_t number = 0;
  for (std::size_t l = 0; l < source.listed.size(); ++l) {
    const auto& list = source.listed[l];
    const int type = source.type_of(l);
    if (out.is_binary() && counts[l] > 0) out.integer(type).integer(counts[l]).integer(2);
    for (Offset i = 0; i < list.size(); ++i) {
      ++number;
      const auto groups = list.groups_of(i);
      for (Offset t = 0; t < times(list, i); ++t) {
        out.integer(number);
        if (!out.is_binary()) out.integer(type).integer(2);
        out.integer(groups.empty() ? 0 : groups[static_cast<std::size_t>(t)]).integer(list.entity(i) + 1);
        for (const Index v : list.simplex(i)) out.integer(std::int64_t{v} + 1);
        out.end();
      }
    }
  }
  out.close("Elements");
}

void write_entities(GmshOutput& out, const Source& source) {
  std::array<double, 6> box{};  // of the whole mesh, which is enough of every entity
  for (int axis = 0; axis < 3; ++axis)
    for (Index v = 0; v < source.mesh.vertex_count; ++v) {
      auto& low = box[static_cast<std::size_t>(axis)];
      auto& high = box[static_cast<std::size_t>(axis) + 3];
      const double x = source.coordinate(v, axis);
      low = v == 0 ? x : std::min(low, x);
      high = v == 0 ? x : std::max(high, x);
    }
  // The vertices belong to the first entity of the highest dimension.
  const auto entities = [&](std::size_t list) {
    const std::size_t least = list == 0 && source.mesh.vertex_count > 0 ? 1 : 0;
    return std::max(source.listed[list].entities().size(), least);
  };
  out.open("Entities");
  for (std::size_t degree = 0; degree < 4; ++degree)
    out.size(degree < source.listed.size() ? static_cast<std::int64_t>(entities(source.listed.size() - 1 - degree))
                                           : 0);
  out.end();
  for (std::size_t l = source.listed.size(); l-- > 0;) {
    const auto& groups_of = source.listed[l].entities();
    for (std::size_t e = 0; e < entities(l); ++e) {
      out.integer(static_cast<std::int64_t>(e) + 1);
      for (std::size_t i = 0; i < (source.degree_of(l) == 0 ? 3U : 6U); ++i) out.real(box[i]);
      out.size(e < groups_of.size() ? std::ssize(groups_of[e]) : 0);
      if (e < groups_of.size())
        for (const auto group : groups_of[e]) out.integer(group);
      if (source.degree_of(l) > 0) out.size(0);
      out.end();
    }
  }
  out.close("Entities");
}

void write_nodes_41(GmshOutput& out, const Source& source) {
  const std::int64_t count = source.mesh.vertex_count;
  out.open("Nodes");
  out.size(count > 0 ? 1 : 0).size(count).size(count > 0 ? 1 : 0).size(count).end();
  if (count > 0) out.integer(source.degree_of(0)).integer(1).integer(0).size(count).end();
  for (std::int64_t v = 1; v <= count; ++v) out.size(v).end();
  for (Index v = 0; v < count; ++v) {
    source.put_position(out, v);
    out.end();
  }
  out.close("Nodes");
}

void write_elements_41(GmshOutput& out, const Source& source) {
  // A block is a run of simplices of one entity, so that their order stays.
  const auto run_end = [](const GmshGroups& list, Offset begin) {
    Offset end = begin + 1;
    while (end < list.size() && list.entity(end) == list.entity(begin)) ++end;
    return end;
  };
  std::int64_t blocks = 0, count = 0;
  for (const auto& list : source.listed) {
    count += list.size();
    for (Offset i = 0; i < list.size(); i = run_end(list, i)) ++blocks;
  }
  out.open("Elements");
  out.size(blocks).size(count).size(count > 0 ? 1 : 0).size(count).end();
  std::int64_t number = 0;
  for (std::size_t l = 0; l < source.listed.size(); ++l) {
    const auto& list = source.listed[l];
    for (Offset i = 0; i < list.size();) {
      const Offset end = run_end(list, i);
      out.integer(source.degree_of(l)).integer(list.entity(i) + 1).integer(source.type_of(l)).size(end - i).end();
      for (; i < end; ++i) {
        out.size(++number);
        for (const Index v : list.simplex(i)) out.size(std::int64_t{v} + 1);
        out.end();
      }
    }
  }
  out.close("Elements");
}

void write_field(GmshOutput& out, const MeshField& field) {
  const bool on_vertices = field.on == MeshField::On::vertices;
  const int held = gmsh_components(field.components);
  const auto items = static_cast<std::int64_t>(field.values.size()) / field.components;
  out.open(on_vertices ? "NodeData" : "ElementData");
  out.file.put("1\n\"").put(field.name).put("\"\n1\n0\n3\n0\n").put(held).put('\n').put(items).put('\n');
  const double* value = field.values.data();
  for (std::int64_t i = 1; i <= items; ++i) {
    out.integer(i);
    for (int c = 0; c < held; ++c) out.real(c < field.components ? *value++ : 0.0);
    out.end();
  }
  out.close(on_vertices ? "NodeData" : "ElementData");
}

}  // namespace

void write_gmsh(TextWriter& file, const MeshData& mesh, const WriteOptions& options) {
  const bool is_41 = options.gmsh_41;
  GmshOutput out(file, options.encoding == WriteOptions::Encoding::binary);
  Source source{mesh, gmsh_group_numbers(mesh), {}};
  for (int k = std::max(mesh.simplices.dimension(), 0); k >= 0; --k)
    source.listed.emplace_back(mesh, k, source.numbers);
  require_fit(source, is_41, out.is_binary());

  file.put("$MeshFormat\n").put(is_41 ? "4.1 " : "2.2 ").put(out.is_binary() ? "1 8\n" : "0 8\n");
  if (out.is_binary()) file.put_bytes(std::int32_t{1}).put('\n');
  file.put("$EndMeshFormat\n");
  write_names(out, source);
  if (is_41) {
    write_entities(out, source);
    write_nodes_41(out, source);
    write_elements_41(out, source);
  } else {
    write_nodes_22(out, source);
    write_elements_22(out, source);
  }
  for (const auto& field : mesh.fields)
    if (gmsh_holds_field(field)) write_field(out, field);
}

}  // namespace derham
