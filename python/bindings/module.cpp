#include "rooms.hpp"

// The compiled half of the Python package: it takes and gives plain arrays and knows no scipy. The Python half checks
// shapes, keeps matrices and has the documentation.
NB_MODULE(_derham, module) {
  using namespace derham::python;
  nanobind::set_leak_warnings(false);  // what daemon threads hold when the interpreter ends is none
  module.doc() = "The compiled half of derham; use the package `derham` instead.";
  bind_core(module);
  ComplexClass complex(module, "Complex");
  bind_complex(complex);
  bind_complex_sets(complex);
  BoundaryClass boundary(module, "Boundary");
  bind_boundary(complex, boundary);
  bind_forms(complex, boundary);
  bind_form_maps(module);
  bind_geometry(complex);
  bind_geometry_data(complex);
  bind_geometry_state(complex);
  bind_dual(complex);
  StarClass star(module, "Star");
  bind_hodge(star);
  bind_operators(complex, star);
  bind_operator_boundary(boundary);
  bind_operator_contractions(complex, star);
  bind_operator_fields(complex);
  bind_operator_matrices(complex, star);
  bind_operator_points(module, complex);
  bind_operator_spaces(module, complex);
  bind_meshes(module);
  bind_point_clouds(module);
  bind_io(module, complex);
  bind_io_series(module);
}
