#pragma once

#include "arrays.hpp"

#include "derham/geometry/mesh_data.hpp"

#include <vector>

// What a mesh has beside its simplices as lists of tuples, and back:
//   parts   (name, number, degree, members)
//   fields  (name, whether on vertices, components, values)
//   forms   (name, degree, whether dual, values)
namespace derham::python {

using Tuples = nb::typed<nb::list, nb::any>;

[[nodiscard]] Tuples listed(const std::vector<MeshPart>& parts);
[[nodiscard]] Tuples listed(const std::vector<MeshField>& fields);
[[nodiscard]] Tuples listed(const std::vector<MeshForm>& forms);

[[nodiscard]] std::vector<MeshPart> parts_of(const Tuples& list);
[[nodiscard]] std::vector<MeshField> fields_of(const Tuples& list);
[[nodiscard]] std::vector<MeshForm> forms_of(const Tuples& list);

}  // namespace derham::python
