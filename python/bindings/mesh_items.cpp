#include "mesh_items.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

namespace derham::python {
namespace {

template <class Items, class Fields>
Tuples tuples(const Items& items, Fields&& fields) {
  Tuples result;
  for (const auto& item : items) result.append(fields(item));
  return result;
}

template <class Fields, class Make>
auto made(const Tuples& list, Make&& make) {
  using Item = decltype(std::apply(make, std::declval<Fields>()));
  std::vector<Item> result;
  for (const nb::handle item : list) result.push_back(std::apply(make, nb::cast<Fields>(item)));
  return result;
}

template <class T>
auto array(const std::vector<T>& values) {
  return owned(std::vector<T>(values));
}

}  // namespace

Tuples listed(const std::vector<MeshPart>& parts) {
  return tuples(parts, [](const MeshPart& part) {
    return nb::make_tuple(part.name, part.number, part.degree, array(part.members));
  });
}

Tuples listed(const std::vector<MeshField>& fields) {
  return tuples(fields, [](const MeshField& field) {
    return nb::make_tuple(field.name, field.on == MeshField::On::vertices, field.components, array(field.values));
  });
}

Tuples listed(const std::vector<MeshForm>& forms) {
  return tuples(forms, [](const MeshForm& form) {
    return nb::make_tuple(form.name, form.degree, form.is_dual, array(form.values));
  });
}

std::vector<MeshPart> parts_of(const Tuples& list) {
  return made<std::tuple<std::string, std::int64_t, int, Indices>>(
      list, [](auto name, auto number, int degree, const Indices& members) {
        return MeshPart{name, number, degree, copied(members)};
      });
}

std::vector<MeshField> fields_of(const Tuples& list) {
  return made<std::tuple<std::string, bool, int, Values>>(
      list, [](auto name, bool on_vertices, int components, const Values& values) {
        return MeshField{name, on_vertices ? MeshField::On::vertices : MeshField::On::rows, components, copied(values)};
      });
}

std::vector<MeshForm> forms_of(const Tuples& list) {
  return made<std::tuple<std::string, int, bool, Values>>(
      list, [](auto name, int degree, bool is_dual, const Values& values) {
        return MeshForm{name, degree, is_dual, copied(values)};
      });
}

}  // namespace derham::python
