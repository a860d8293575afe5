#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/complex/simplex_list.hpp"
#include "derham/meshes/balls.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/example.hpp"
#include "derham/meshes/lattices.hpp"
#include "derham/meshes/polytopes.hpp"
#include "derham/meshes/tori.hpp"
#include "derham/meshes/voxels.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <string>

namespace derham::python {
namespace {

using nb::arg;

/// Defines a generator: the complex of the mesh, or of the list of simplices, that `make` makes.
template <class Make, class... Extra>
void generator(nb::module_& module, const char* name, Make make, const Extra&... extra) {
  [&]<class... Arguments>(auto (*function)(Arguments...)) {
    module.def(
        name,
        [function](Arguments... arguments) {
          return without_gil([&] {
            if constexpr (std::is_same_v<decltype(function(arguments...)), MeshData>) {
              return AnyComplex(function(arguments...));
            } else {
              MeshData mesh;
              mesh.simplices = function(arguments...);
              mesh.vertex_count = mesh.simplices.vertex_bound();
              return AnyComplex(std::move(mesh));
            }
          });
        },
        extra...);
  }(+make);
}

meshes::BoxOptions options(std::vector<double> lengths, double jitter, std::uint64_t seed) {
  return {.lengths = std::move(lengths), .jitter = jitter, .seed = seed};
}

void shapes(nb::module_& m) {
  using Cells = std::vector<Index>;
  using Lengths = std::vector<double>;
  generator(
      m, "box",
      [](const Cells& cells, const Lengths& lengths, double jitter, std::uint64_t seed) {
        return meshes::box(cells, options(lengths, jitter, seed));
      },
      arg("cells"), arg("lengths"), arg("jitter"), arg("seed"));
  generator(
      m, "periodic_box",
      [](const Cells& cells, const Lengths& lengths, double jitter, std::uint64_t seed) {
        return meshes::periodic_box(cells, options(lengths, jitter, seed));
      },
      arg("cells"), arg("lengths"), arg("jitter"), arg("seed"));
  generator(
      m, "ball", [](int n, Index layers, double radius) { return meshes::ball(n, layers, radius); }, arg("dimension"),
      arg("layers"), arg("radius"));
  generator(
      m, "icosphere", [](int level, double radius) { return meshes::icosphere(level, radius); }, arg("level"),
      arg("radius"));
  generator(
      m, "torus",
      [](Index segments, Index sides, double major, double minor) {
        return meshes::torus(segments, sides, major, minor);
      },
      arg("segments"), arg("sides"), arg("major"), arg("minor"));
  generator(
      m, "solid_torus",
      [](Index rings, Index segments, double major, double minor) {
        return meshes::solid_torus(rings, segments, major, minor);
      },
      arg("rings"), arg("segments"), arg("major"), arg("minor"));
  generator(
      m, "clifford_torus", [](Index a, Index b, double radius) { return meshes::clifford_torus(a, b, radius); },
      arg("a"), arg("b"), arg("radius"));
  generator(
      m, "a_star_lattice", [](int n, Index cells, double scale) { return meshes::a_star_lattice(n, cells, scale); },
      arg("dimension"), arg("cells"), arg("scale"));
  generator(
      m, "bcc_lattice", [](Index cells, double length) { return meshes::bcc_lattice(cells, length); }, arg("cells"),
      arg("cell_length"));
  generator(
      m, "voxels", [](const std::string& spec) { return meshes::voxels(spec); }, arg("spec"));
  generator(m, "example", [] { return meshes::example(); });
}

void polytopes_and_classics(nb::module_& m) {
  generator(
      m, "regular_simplex", [](int n) { return meshes::regular_simplex(n); }, arg("dimension"));
  generator(
      m, "simplex_boundary", [](int n) { return meshes::simplex_boundary(n); }, arg("dimension"));
  generator(
      m, "cross_polytope", [](int n) { return meshes::cross_polytope(n); }, arg("dimension"));
  generator(m, "cell_600", [] { return meshes::cell_600(); });
  generator(
      m, "cycle", [](Index size) { return meshes::cycle(size); }, arg("size"));
  generator(
      m, "path", [](Index size) { return meshes::path(size); }, arg("size"));
  generator(
      m, "sphere", [](int n) { return meshes::sphere(n); }, arg("dimension"));
  generator(m, "projective_plane", [] { return meshes::projective_plane(); });
  generator(m, "klein_bottle", [] { return meshes::klein_bottle(); });
  generator(m, "csaszar_torus", [] { return meshes::csaszar_torus(); });
  generator(m, "moebius_strip", [] { return meshes::moebius_strip(); });
  generator(m, "annulus", [] { return meshes::annulus(); });
  generator(m, "complex_projective_plane", [] { return meshes::complex_projective_plane(); });
  generator(m, "poincare_sphere", [] { return meshes::poincare_sphere(); });
  generator(
      m, "lens_space", [](int p, int q) { return meshes::lens_space(p, q); }, arg("p"), arg("q"));
  generator(
      m, "grid_torus", [](int n, Index cells) { return meshes::grid_torus(n, cells); }, arg("dimension"), arg("cells"));
}

using Combine = MeshData (*)(const MeshData&, const MeshData&);

auto combined(Combine combine) {
  return [combine](const AnyComplex& a, const AnyComplex& b) {
    return without_gil([&] { return AnyComplex(combine(a.mesh(), b.mesh())); });
  };
}

/// Constructions of simplices alone.
template <SimplexList (*construct)(const SimplexList&)>
AnyComplex constructed(const AnyComplex& a) {
  return without_gil([&] {
    MeshData mesh;
    mesh.simplices = construct(a.mesh().simplices);
    mesh.vertex_count = mesh.simplices.vertex_bound();
    return AnyComplex(std::move(mesh));
  });
}

}  // namespace

void bind_meshes(nb::module_& m) {
  shapes(m);
  polytopes_and_classics(m);
  m.def("disjoint_union", combined(&meshes::disjoint_union), arg("a"), arg("b"));
  m.def("product", combined(&meshes::product), arg("a"), arg("b"));
  m.def("cone", &constructed<&meshes::cone>, arg("a"));
  m.def("suspension", &constructed<&meshes::suspension>, arg("a"));
  m.def(
      "barycentric_subdivision",
      [](const AnyComplex& a) {
        return without_gil([&] { return AnyComplex(meshes::barycentric_subdivision(a.mesh())); });
      },
      arg("a"));
}

}  // namespace derham::python
