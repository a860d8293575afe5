#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/npy.hpp"
#include "derham/io/zip_write.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace derham {
namespace {

class Writer {
 public:
  explicit Writer(TextWriter& file) : zip_(file) {}

  template <class Number>
  void add(const std::string& name, std::span<const Number> values, std::initializer_list<std::int64_t> shape) {
    constexpr char kind = std::is_floating_point_v<Number> ? 'f' : 'i';
    add_bytes(name, npy_header(kind, sizeof(Number), shape),
              {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  template <class Number>
  void add(const std::string& name, const std::vector<Number>& values, std::int64_t columns = 0) {
    const auto count = static_cast<std::int64_t>(values.size());
    if (columns > 0)
      add(name, std::span<const Number>(values), {count / columns, columns});
    else
      add(name, std::span<const Number>(values), {count});
  }

  void add_bytes(const std::string& name, const std::string& header, std::string_view bytes) {
    constexpr std::size_t longest_name = 0xffff - 4;
    if (name.size() > longest_name || name.find('\0') != std::string::npos)
      throw InputError(text("format npz cannot name an array '", name.substr(0, 40), "…'; expected a name of at most ",
                            longest_name, " bytes, none of them 0"));
    if (!names_.insert(name).second)
      throw InputError(text("two arrays would both be called '", name, "' in the .npz file; rename one of them"));
    zip_.add(name + ".npy", header, bytes);
  }

  void finish() { zip_.finish(); }

 private:
  ZipWriter zip_;
  std::set<std::string> names_;
};

// Names as numpy's text of bytes: all as long as the longest.
void add_part_names(Writer& file, const std::vector<MeshPart>& parts) {
  std::size_t longest = 1;
  std::set<std::pair<int, std::int64_t>> numbers;
  for (const auto& part : parts) {
    if (!numbers.insert({part.degree, part.number}).second)
      throw InputError(
          text("two parts of degree ", part.degree, " have the number ", part.number, "; give one of them another"));
    longest = std::max(longest, part.name.size());
    if (part.name.ends_with('\0'))
      throw InputError(text("format npz cannot hold the name of part ", part.number, ", which ends with a zero byte"));
  }
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  if (longest > most_bytes / parts.size())
    throw InputError(text("format npz makes all names of parts as long as the longest, here ", longest, " bytes, for ",
                          parts.size(), " parts; shorten it"));
  std::string names(longest * parts.size(), '\0');
  for (std::size_t i = 0; i < parts.size(); ++i)
    std::ranges::copy(parts[i].name, names.begin() + static_cast<std::ptrdiff_t>(i * longest));
  const std::int64_t shape[] = {static_cast<std::int64_t>(parts.size())};
  file.add_bytes("part_names", npy_header('S', longest, shape), names);
}

void add_parts(Writer& file, const std::vector<MeshPart>& parts) {
  if (parts.empty()) return;
  std::vector<std::int64_t> numbers, degrees, offsets{0};
  std::vector<Index> members;
  for (const auto& part : parts) {
    numbers.push_back(part.number);
    degrees.push_back(part.degree);
    members.insert(members.end(), part.members.begin(), part.members.end());
    offsets.push_back(static_cast<std::int64_t>(members.size()));
  }
  add_part_names(file, parts);
  file.add("part_numbers", numbers);
  file.add("part_degrees", degrees);
  file.add("part_offsets", offsets);
  file.add("part_members", members);
}

}  // namespace

void write_npz(TextWriter& text_file, const MeshData& mesh, const WriteOptions&) {
  Writer file(text_file);
  const auto& rows = mesh.simplices;
  const auto width = std::int64_t{rows.dimension()} + 1;
  file.add("simplices", rows.vertices(), {rows.size(), width});
  if (mesh.has_points()) {
    file.add("points", mesh.points, mesh.ambient_dimension);
  } else {
    const std::int64_t count[] = {mesh.vertex_count};
    file.add("vertex_count", std::span<const std::int64_t>(count), {});
  }
  if (mesh.has_corners())
    file.add("corners", std::span<const double>(mesh.corners), {rows.size(), width, mesh.ambient_dimension});
  if (!mesh.edge_lengths_squared.empty()) file.add("edge_lengths_squared", mesh.edge_lengths_squared);
  if (!mesh.vertex_tags.empty()) file.add("vertex_tags", mesh.vertex_tags);
  if (!mesh.row_tags.empty()) file.add("row_tags", mesh.row_tags);
  for (std::size_t k = 0; k < mesh.lower.size(); ++k)
    if (!mesh.lower[k].empty())
      file.add(text("lower_", k), std::span<const Index>(mesh.lower[k].vertices()),
               {mesh.lower[k].size(), static_cast<std::int64_t>(k) + 1});
  add_parts(file, mesh.parts);
  for (const auto& field : mesh.fields)
    file.add((field.on == MeshField::On::rows ? "row_data_" : "point_data_") + field.name, field.values,
             field.components == 1 ? 0 : field.components);
  for (const auto& form : mesh.forms)
    file.add(text("form_", form.name, '_', form.degree, form.is_dual ? "_dual" : "_primal"), form.values);
  file.finish();
}

}  // namespace derham
