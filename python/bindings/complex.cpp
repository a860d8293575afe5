#include "arrays.hpp"
#include "rooms.hpp"
#include "simplex_rows.hpp"

#include "derham/core/parallel.hpp"
#include "derham/io/unused_vertices.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <optional>

namespace derham::python {
namespace {

using Rows = Input<Index, nb::ndim<2>>;
using Coordinates = std::optional<Values>;

/// Positions of shape (…, m) with m in the last place.
void set_positions(MeshData& mesh, std::vector<double>& place, const Coordinates& given) {
  if (!given) return;
  mesh.ambient_dimension = static_cast<int>(given->shape(given->ndim() - 1));
  place = copied(*given);
}

MeshData mesh_of(SimplexList rows, Index vertex_count, const Coordinates& points, const Coordinates& corners,
                 const Coordinates& edge_lengths_squared, bool drop_unused) {
  MeshData mesh;
  mesh.simplices = std::move(rows);
  mesh.vertex_count = vertex_count < 0 ? mesh.simplices.vertex_bound() : vertex_count;
  set_positions(mesh, mesh.points, points);
  set_positions(mesh, mesh.corners, corners);
  if (edge_lengths_squared) mesh.edge_lengths_squared = copied(*edge_lengths_squared);
  if (drop_unused) drop_unused_vertices(mesh);
  return mesh;
}

void construct(AnyComplex* self, const Rows& rows, Index vertex_count, const Coordinates& points,
               const Coordinates& corners, const Coordinates& edge_lengths_squared, bool drop_unused) {
  without_gil([&] {
    SimplexList list;
    if (rows.shape(0) > 0) list = SimplexList(static_cast<int>(rows.shape(1)) - 1, copied(rows));
    new (self) AnyComplex(mesh_of(std::move(list), vertex_count, points, corners, edge_lengths_squared, drop_unused));
  });
}

/// Rows of several lengths: `ends` says where in `vertices` each ends.
void construct_mixed(AnyComplex* self, const Indices& vertices, const Indices& ends, Index vertex_count,
                     const Coordinates& points, bool drop_unused) {
  without_gil(
      [&] { new (self) AnyComplex(mesh_of(rows_of(vertices, ends), vertex_count, points, {}, {}, drop_unused)); });
}

Index size(const AnyComplex& any, int k) {
  return any.with_complex([k](const auto& K) { return K.size(k); });
}

auto simplices(const AnyComplex& any, int k) {
  return any.visit([k](const auto& body) {
    const auto& K = *body.complex;
    const auto width = static_cast<std::size_t>(k) + 1;
    return view(K.simplices(k), {static_cast<std::size_t>(K.size(k)), width}, body.complex);
  });
}

auto faces(const AnyComplex& any, int k) {
  return any.visit([k](const auto& body) {
    const auto& K = *body.complex;
    const auto width = static_cast<std::size_t>(k) + 1;
    return view(K.face_table(k), {static_cast<std::size_t>(K.size(k)), width}, body.complex);
  });
}

auto signs(const AnyComplex& any) {
  return any.visit(
      [](const auto& body) { return view(std::span<const Sign>(body.complex->orientation().sign), body.complex); });
}

auto find(const AnyComplex& any, const Rows& tuples) {
  const auto count = tuples.shape(0), width = tuples.shape(1);
  std::vector<Index> index(count);
  std::vector<Sign> sign(count);
  without_gil([&] {
    any.with_complex([&](const auto& K) {
      parallel_blocks(static_cast<Offset>(count), 1024, [&](Offset begin, Offset end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          const SignedIndex found = K.find(std::span<const Index>(tuples.data() + i * width, width));
          index[i] = found.index;
          sign[i] = found.sign;
        }
      });
    });
  });
  return std::pair(owned(std::move(index)), owned(std::move(sign)));
}

/// A question that K answers at once.
template <class Question>
auto asked(Question question) {
  return [question](const AnyComplex& any) { return any.with_complex(question); };
}

}  // namespace

void bind_complex(ComplexClass& complex) {
  using nb::arg;
  complex.def("__init__", &construct, arg("simplices"), arg("vertex_count"), arg("points").none(),
              arg("corners").none(), arg("edge_lengths_squared").none(), arg("drop_unused") = false);
  complex.def("__init__", &construct_mixed, arg("vertices"), arg("ends"), arg("vertex_count"), arg("points").none(),
              arg("drop_unused") = false);
  complex.def_prop_ro("dimension", &AnyComplex::dimension);
  complex.def("size", &size, arg("k"));
  complex.def("simplices", &simplices, arg("k"));
  complex.def("faces", &faces, arg("k"));
  complex.def("signs", &signs);
  complex.def("find", &find, arg("tuples"));
  complex.def("is_orientable", asked([](const auto& K) { return K.is_orientable(); }));
  complex.def("is_pure", asked([](const auto& K) { return K.is_pure(); }));
  complex.def("component_count", asked([](const auto& K) { return K.component_count(); }), nb::call_guard<Unlocked>());
  complex.def("one_sided", asked([](const auto& K) { return owned(K.orientation().one_sided); }));
}

}  // namespace derham::python
