#include "derham/io/write_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/form_size.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/text_writer.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

namespace derham {
namespace {

// The same of what stands beside the rows.
void require_sound_lists(const MeshData& mesh) {
  const int n = mesh.simplices.dimension();
  const auto refuse = [](const auto&... reason) { throw InputError(text(reason...)); };
  if (std::ssize(mesh.lower) > std::max(n, 0))
    refuse("simplices of dimension up to ", mesh.lower.size() - 1, " beside rows of dimension ", n);
  for (std::size_t k = 0; k < mesh.lower.size(); ++k) {
    const auto& list = mesh.lower[k];
    if (!list.empty() && (!list.is_uniform() || list.dimension() != static_cast<int>(k)))
      refuse("lower[", k, "] holds simplices of dimension ", list.dimension());
    for (const Index v : list.vertices())
      if (v < 0 || v >= mesh.vertex_count)
        refuse("vertex id ", v, " in lower[", k, "] of a mesh of ", mesh.vertex_count, " vertices");
  }
  for (const auto& part : mesh.parts) {
    const auto degree = static_cast<std::size_t>(part.degree);
    const Offset bound = part.degree == n             ? mesh.simplices.size()
                         : part.degree == 0           ? Offset{mesh.vertex_count}
                         : degree < mesh.lower.size() ? mesh.lower[degree].size()
                                                      : 0;
    if (part.degree < 0 || part.degree > std::max(n, 0))
      refuse("part ", part.number, " of dimension ", part.degree, " in a mesh of dimension ", n);
    for (const Index member : part.members)
      if (member < 0 || member >= bound)
        refuse("part ", part.number, " of dimension ", part.degree, " has member ", member, "; there are ", bound);
  }
  for (const auto& field : mesh.fields) {
    const Offset items = field.on == MeshField::On::rows ? mesh.simplices.size() : Offset{mesh.vertex_count};
    if (field.components < 1 || static_cast<Offset>(field.values.size()) != items * field.components)
      refuse("a field of ", field.values.size(), " values, expected ", field.components, " for each of ", items);
  }
  for (const auto& form : mesh.forms)
    if (const auto defect = form_defect(mesh, form); !defect.empty()) refuse(defect);
}

// Two fields of one name would be one when they are read again.
void require_distinct_fields(const MeshData& mesh) {
  std::set<std::pair<MeshField::On, std::string_view>> names;
  for (const auto& field : mesh.fields)
    if (!names.emplace(field.on, field.name).second)
      throw InputError(text("two fields on ", field.on == MeshField::On::rows ? "rows" : "vertices", " are called ",
                            quoted_token(field.name), "; give one another name"));
}

void require_sound(const MeshData& mesh) {
  for (const Index v : mesh.simplices.vertices())
    if (v < 0 || v >= mesh.vertex_count)
      throw InputError(text("vertex id ", v, " in a mesh of ", mesh.vertex_count, " vertices; expected 0 to ",
                            mesh.vertex_count - 1));
  const auto expected = static_cast<Offset>(mesh.vertex_count) * mesh.ambient_dimension;
  if (mesh.has_points() && static_cast<Offset>(mesh.points.size()) != expected)
    throw InputError(text(mesh.points.size(), " coordinates for ", mesh.vertex_count, " vertices in dimension ",
                          mesh.ambient_dimension, "; expected ", expected));
  require_sound_lists(mesh);
}

void require_fit(const MeshData& mesh, const FormatTraits& format) {
  const int n = mesh.simplices.dimension();
  const int m = mesh.ambient_dimension;
  const bool fits_npz = m > 0 && m <= 6 && mesh.simplices.is_uniform();
  const auto refuse = [&](const auto&... reason) {
    throw InputError(text("format ", format.name, " ", reason..., "; .facets holds any complex without positions",
                          fits_npz ? ", .npz this mesh with them" : ""));
  };
  if (mesh.has_corners() && format.format != MeshFormat::vtu && format.format != MeshFormat::npz)
    refuse("has one position per vertex, a periodic mesh has not; .vtu holds one for pictures");
  if (!mesh.has_points() && !mesh.has_corners() && mesh.vertex_count > 0 && format.least_ambient > 0)
    refuse("needs positions, this mesh has none");
  if (!mesh.simplices.is_uniform()) refuse("holds simplices of one dimension, this mesh has several");
  if (n > format.largest_dimension)
    refuse("holds simplices of dimension at most ", format.largest_dimension, ", this mesh has dimension ", n);
  if (m > 0 && n > m && format.largest_ambient <= 3)
    refuse("does not hold simplices of dimension ", n, " in a space of dimension ", m);
  if (m > format.largest_ambient)
    refuse("holds positions in at most ", format.largest_ambient, " dimensions, this mesh has ", m);
  if (!mesh.simplices.empty() && n < format.least_dimension)
    refuse("holds simplices of dimension at least ", format.least_dimension, ", this mesh has dimension ", n);
}

}  // namespace

void write_mesh(const std::string& path, const MeshData& mesh, MeshFormat format, const WriteOptions& options) {
  require_sound(mesh);
  const auto& traits = format_traits(format);
  if (format != MeshFormat::facets) require_fit(mesh, traits);
  if (traits.holds_fields) require_distinct_fields(mesh);

  if (format == MeshFormat::tetgen && path != "-") return write_tetgen_files(tetgen_paths(path), mesh);

  AtomicFile file(path);
  TextWriter writer(file);
  if (format == MeshFormat::tetgen)
    write_tetgen({writer, writer}, mesh);
  else if (traits.write != nullptr)
    traits.write(writer, mesh, options);
  else
    throw InputError(text("derham does not write ", traits.name, "; expected one of ", writable_formats()));
  writer.flush();
  file.commit();
}

std::vector<std::string> written_files(const std::string& path, const MeshData& mesh, MeshFormat format) {
  if (format == MeshFormat::tetgen && path != "-") return tetgen_files(tetgen_paths(path), mesh);
  return {path};
}

void write_mesh(const std::string& path, const MeshData& mesh) {
  const auto format = format_by_extension(path);
  if (!format)
    throw InputError(text("'", path, "' has no extension of a mesh format; expected one of ", writable_formats()));
  write_mesh(path, mesh, *format);
}

}  // namespace derham
