#include "arrays.hpp"
#include "mesh_items.hpp"
#include "rooms.hpp"
#include "simplex_rows.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// All that a complex was made from, as arrays and lists for pickle, and the complex again.
namespace derham::python {
namespace {

using State = nb::typed<nb::dict, nb::str, nb::any>;

/// The length of every row, 0 if they differ; the vertices; where each row ends, if they differ.
nb::tuple state_of(const SimplexList& list) {
  std::vector<Index> vertices(list.vertices().begin(), list.vertices().end()), ends;
  if (!list.is_uniform())
    for (Offset i = 0, end = 0; i < list.size(); ++i)
      ends.push_back(static_cast<Index>(end += static_cast<Offset>(list[i].size())));
  return nb::make_tuple(list.is_uniform() ? list.dimension() + 1 : 0, owned(std::move(vertices)),
                        owned(std::move(ends)));
}

SimplexList list_of(const nb::handle& state) {
  const auto [width, vertices, ends] = nb::cast<std::tuple<int, Indices, Indices>>(state);
  return width > 0 ? SimplexList(width - 1, copied(vertices)) : rows_of(vertices, ends);
}

State state(const AnyComplex& any) {
  MeshData mesh = without_gil([&] { return any.mesh(); });
  State result;
  result["simplices"] = state_of(mesh.simplices);
  result["signs"] = any.with_complex([](const auto& K) { return owned(std::vector<Sign>(K.orientation().sign)); });
  result["vertex_count"] = mesh.vertex_count;
  result["ambient_dimension"] = mesh.ambient_dimension;
  result["points"] = owned(std::move(mesh.points));
  result["corners"] = owned(std::move(mesh.corners));
  result["edge_lengths_squared"] = owned(std::move(mesh.edge_lengths_squared));
  result["vertex_tags"] = owned(std::move(mesh.vertex_tags));
  result["row_tags"] = owned(std::move(mesh.row_tags));
  nb::list lower;
  for (const SimplexList& list : mesh.lower) lower.append(state_of(list));
  result["lower"] = lower;
  result["parts"] = listed(mesh.parts);
  result["fields"] = listed(mesh.fields);
  result["forms"] = listed(mesh.forms);
  result["notes"] = mesh.notes;
  return result;
}

template <class T>
std::vector<T> numbers(const State& state, const char* name) {
  return copied(nb::cast<Input<T, nb::ndim<1>>>(state[name]));
}

AnyComplex restored(const State& state) {
  MeshData mesh;
  mesh.simplices = list_of(state["simplices"]);
  mesh.vertex_count = nb::cast<Index>(state["vertex_count"]);
  mesh.ambient_dimension = nb::cast<int>(state["ambient_dimension"]);
  mesh.points = numbers<double>(state, "points");
  mesh.corners = numbers<double>(state, "corners");
  mesh.edge_lengths_squared = numbers<double>(state, "edge_lengths_squared");
  mesh.vertex_tags = numbers<std::int64_t>(state, "vertex_tags");
  mesh.row_tags = numbers<std::int64_t>(state, "row_tags");
  for (const nb::handle list : nb::cast<nb::list>(state["lower"])) mesh.lower.push_back(list_of(list));
  mesh.parts = parts_of(state["parts"]);
  mesh.fields = fields_of(state["fields"]);
  mesh.forms = forms_of(state["forms"]);
  mesh.notes = nb::cast<std::vector<std::string>>(state["notes"]);
  const std::vector<Sign> signs = numbers<Sign>(state, "signs");
  return without_gil([&] { return AnyComplex(std::move(mesh), signs); });
}

}  // namespace

void bind_geometry_state(ComplexClass& complex) {
  complex.def("state", &state);
  complex.def_static("restored", &restored, nb::arg("state"));
}

}  // namespace derham::python
