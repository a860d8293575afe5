#include "mesh_items.hpp"
#include "rooms.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// What a mesh has beside its simplices: parts, fields, forms, tags, notes.
namespace derham::python {
namespace {

auto numbers(const std::vector<std::int64_t>& tags) { return owned(std::vector<std::int64_t>(tags)); }

/// (name, number, degree, how many members) of every part.
auto parts_without_members(const AnyComplex& any) {
  std::vector<std::tuple<std::string, std::int64_t, int, std::size_t>> parts;
  for (const MeshPart& part : any.rest().parts)
    parts.emplace_back(part.name, part.number, part.degree, part.members.size());
  return parts;
}

/// The vertices of the simplices of part number `part`, each simplex as the mesh lists it.
auto tagged_simplices(const AnyComplex& any, std::size_t part) {
  const MeshPart& tag = any.rest().parts.at(part);
  const auto width = static_cast<std::size_t>(tag.degree) + 1;
  std::vector<Index> vertices;
  const auto append = [&](const auto& row) { vertices.insert(vertices.end(), row.begin(), row.end()); };
  without_gil([&] {
    vertices.reserve(tag.members.size() * width);
    if (tag.degree == 0) {
      append(tag.members);
    } else if (tag.degree == any.dimension()) {
      const MeshData mesh = any.mesh();
      for (const Index row : tag.members) append(mesh.simplices[row]);
    } else {
      const SimplexList& list = any.rest().lower.at(static_cast<std::size_t>(tag.degree));
      for (const Index row : tag.members) append(list[row]);
    }
  });
  return owned(std::move(vertices), {tag.members.size(), width});
}

/// The complex with more parts, fields, forms and notes, in which those of the same names or numbers give way. The members of parts of
/// degrees between 0 and n are vertices, simplex after simplex, which become rows of `lower`.
AnyComplex with_data(const AnyComplex& any, const Tuples& parts, const Tuples& fields, const Tuples& forms,
                     const std::vector<std::string>& notes) {
  std::vector<MeshPart> new_parts = parts_of(parts);
  std::vector<MeshField> new_fields = fields_of(fields);
  std::vector<MeshForm> new_forms = forms_of(forms);
  const Unlocked unlocked;
  AnyComplex result = any;
  MeshData& mesh = result.rest();
  for (MeshPart& part : new_parts) {
    const auto k = static_cast<std::size_t>(part.degree);
    if (0 < part.degree && part.degree < any.dimension()) {
      if (mesh.lower.size() <= k) mesh.lower.resize(k + 1);
      SimplexList& list = mesh.lower[k];
      const std::vector<Index> vertices = std::exchange(part.members, {});
      for (std::size_t i = 0; i < vertices.size(); i += k + 1) {
        part.members.push_back(static_cast<Index>(list.size()));
        list.push_back(std::span(vertices).subspan(i, k + 1));
      }
    }
    std::erase_if(mesh.parts, [&](const MeshPart& old) {
      return old.degree == part.degree && (old.number == part.number || (old.name == part.name && !part.name.empty()));
    });
    mesh.parts.push_back(std::move(part));
  }
  for (MeshField& field : new_fields) {
    std::erase_if(mesh.fields, [&](const MeshField& old) { return old.on == field.on && old.name == field.name; });
    mesh.fields.push_back(std::move(field));
  }
  for (MeshForm& form : new_forms) {
    std::erase_if(mesh.forms, [&](const MeshForm& old) { return old.name == form.name; });
    mesh.forms.push_back(std::move(form));
  }
  mesh.notes.insert(mesh.notes.end(), notes.begin(), notes.end());
  return result;
}

}  // namespace

void bind_geometry_data(ComplexClass& complex) {
  using nb::arg;
  complex.def("parts", &parts_without_members);
  complex.def("fields", [](const AnyComplex& any) { return listed(any.rest().fields); });
  complex.def("forms", [](const AnyComplex& any) { return listed(any.rest().forms); });
  complex.def("notes", [](const AnyComplex& any) { return any.rest().notes; });
  complex.def("vertex_tags", [](const AnyComplex& any) { return numbers(any.rest().vertex_tags); });
  complex.def("row_tags", [](const AnyComplex& any) { return numbers(any.rest().row_tags); });
  complex.def("tagged_simplices", &tagged_simplices, arg("part"));
  complex.def("with_data", &with_data, arg("parts"), arg("fields"), arg("forms"), arg("notes"));
}

}  // namespace derham::python
