#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/io/form_picture.hpp"
#include "derham/io/mesh_format.hpp"
#include "derham/io/read_mesh.hpp"
#include "derham/io/unused_vertices.hpp"
#include "derham/io/write_mesh.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <tuple>

namespace derham::python {
namespace {

std::optional<MeshFormat> format_of(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  if (const auto format = format_by_name(*name)) return format;
  throw InputError("there is no format '" + *name + "'; expected " + readable_formats());
}

AnyComplex read(const std::string& path, const std::optional<std::string>& format, bool triangulate, bool corner_nodes,
                bool planar, bool drop_unused) {
  return without_gil([&] {
    MeshData mesh = read_mesh(path, format_of(format),
                              {.triangulate = triangulate, .corner_nodes = corner_nodes, .planar = planar});
    if (drop_unused) drop_unused_vertices(mesh);
    return AnyComplex(std::move(mesh));
  });
}

void write(const AnyComplex& any, const std::string& path, const std::optional<std::string>& format,
           const std::optional<bool>& binary, bool gmsh_41) {
  without_gil([&] {
    WriteOptions options;
    options.gmsh_41 = gmsh_41;
    if (binary) options.encoding = *binary ? WriteOptions::Encoding::binary : WriteOptions::Encoding::ascii;
    const auto chosen = format ? format_of(format) : format_by_extension(path);
    if (!chosen) throw InputError("the name '" + path + "' tells no format; give one of " + writable_formats());
    write_mesh(path, any.mesh(), *chosen, options);
  });
}

using NamedForm = std::tuple<std::string, int, Values>;

/// A picture of forms, each with the degree of the simplices that count its values.
void draw(const AnyComplex& any, const std::string& path, const std::vector<NamedForm>& forms) {
  any.visit<1, 3>([&]<int n>(const Body<n>& body) {
    if (!body.geometry || body.geometry->source() != MetricSource::points)
      throw GeometryError("the complex has no points to draw");
    without_gil([&] {
      const SimplicialComplex<n>& K = *body.complex;
      FormPicture<n> picture(K, body.geometry->ambient_dimension(), body.geometry->points());
      for (const auto& [name, degree, values] : forms)
        with_constant<0, n>(degree, "the degree",
                            [&](auto k) { picture.add(name, PrimalForm<n, k()>(K, copied(values))); });
      picture.write(path);
    });
  });
}

}  // namespace

void bind_io(nb::module_& module, ComplexClass& complex) {
  using nb::arg;
  module.def("read", &read, arg("path"), arg("format").none(), arg("triangulate"), arg("corner_nodes"), arg("planar"),
             arg("drop_unused"));
  complex.def("write", &write, arg("path"), arg("format").none(), arg("binary").none(), arg("gmsh_41"));
  complex.def("draw", &draw, arg("path"), arg("forms"));
}

}  // namespace derham::python
