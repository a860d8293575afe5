#pragma once

#include "any_boundary.hpp"
#include "any_complex.hpp"
#include "any_star.hpp"

#include <nanobind/nanobind.h>

// What each room of the library adds to the module; one source file each, some several.
namespace derham::python {

using ComplexClass = nanobind::class_<AnyComplex>;
using BoundaryClass = nanobind::class_<AnyBoundary>;
using StarClass = nanobind::class_<AnyStar>;

void bind_core(nanobind::module_& module);
void bind_complex(ComplexClass& complex);
void bind_complex_sets(ComplexClass& complex);
void bind_boundary(ComplexClass& complex, BoundaryClass& boundary);
void bind_forms(ComplexClass& complex, BoundaryClass& boundary);
void bind_form_maps(nanobind::module_& module);
void bind_geometry(ComplexClass& complex);
void bind_geometry_data(ComplexClass& complex);
void bind_geometry_state(ComplexClass& complex);
void bind_dual(ComplexClass& complex);
void bind_hodge(StarClass& star);
void bind_operators(ComplexClass& complex, StarClass& star);
void bind_operator_boundary(BoundaryClass& boundary);
void bind_operator_contractions(ComplexClass& complex, StarClass& star);
void bind_operator_fields(ComplexClass& complex);
void bind_operator_matrices(ComplexClass& complex, StarClass& star);
void bind_operator_points(nanobind::module_& module, ComplexClass& complex);
void bind_operator_spaces(nanobind::module_& module, ComplexClass& complex);
void bind_meshes(nanobind::module_& module);
void bind_point_clouds(nanobind::module_& module);
void bind_io(nanobind::module_& module, ComplexClass& complex);
void bind_io_series(nanobind::module_& module);

}  // namespace derham::python
