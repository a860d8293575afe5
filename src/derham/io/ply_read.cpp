#include "derham/core/text.hpp"
#include "derham/io/byte_order.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/ply_header.hpp"
#include "derham/io/polygons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace derham {
namespace {

using ply::Element;
using ply::Property;
using ply::Type;

// Calls action(T()) with the type of numbers that `type` stands for.
template <class Action>
auto with_type(Type type, Action action) {
  switch (type) {
    case Type::int8:
      return action(std::int8_t());
    case Type::uint8:
      return action(std::uint8_t());
    case Type::int16:
      return action(std::int16_t());
    case Type::uint16:
      return action(std::uint16_t());
    case Type::int32:
      return action(std::int32_t());
    case Type::uint32:
      return action(std::uint32_t());
    case Type::float32:
      return action(float());
    default:
      return action(double());
  }
}

// The numbers of the records, from text or from bytes.
class Numbers {
 public:
  Numbers(Cursor& file, const ply::Header& header)
      : file_(file), is_text_(header.is_text), swap_(!header.is_text && is_foreign_order(header.little_endian)) {
    file.name_bytes(!is_text_);
  }

  [[nodiscard]] bool is_text() const noexcept { return is_text_; }

  void begin_record(const Element& element, std::int64_t i) {
    if (is_text_ && !file_.next_line())
      file_.fail(text("the file ends after ", i, " of ", element.count, " records of ", quoted_token(element.name)));
  }
  void end_record() {
    if (is_text_) file_.end_line();
  }

  // A position, which is finite, or a value of a field, which need not be.
  double real(Type type, const char* what, bool is_finite) {
    if (is_text_ && !ply::is_real(type)) return static_cast<double>(integer(type, what));
    if (is_text_) return is_finite ? file_.real(what) : file_.real_or_nan(what);
    const char* const at = file_.bytes(ply::size_of(type), what).data();
    const double value = with_type(type, [&]<class T>(T) { return static_cast<double>(load_number<T>(at, swap_)); });
    if (is_finite && !std::isfinite(value)) {
      file_.rewind(file_.offset() - ply::size_of(type));
      file_.fail(text("found ", value, ", expected a finite number as ", what));
    }
    return value;
  }

  std::int64_t integer(Type type, const char* what) {
    if (!is_text_) {
      const char* const at = file_.bytes(ply::size_of(type), what).data();
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
      return with_type(type, [&]<class T>(T) { return static_cast<std::int64_t>(load_number<T>(at, swap_)); });
    }
    return with_type(type, [&]<class T>(T) {
      return file_.integer(what, static_cast<std::int64_t>(std::numeric_limits<T>::lowest()),
                           static_cast<std::int64_t>(std::numeric_limits<T>::max()));
    });
  }

  // The number of entries of a list, all of which the file can hold.
  std::int64_t list_size(const Property& list) {
    const auto here = file_.offset();
    const auto size = integer(list.count_type, "the length of a list");
    const std::int64_t entry_bytes = is_text_ ? 2 : ply::size_of(list.type);
    if (size < 0 || size > (file_.remaining() + 1) / entry_bytes) {
      file_.rewind(here);
      file_.fail(text("the length of the list ", quoted_token(list.name), " is ", size, ", but ", file_.remaining(),
                      " bytes are left"));
    }
    return size;
  }

  [[nodiscard]] std::int64_t room_for_triangles(const Property& list) const {
    return file_.remaining() / (is_text_ ? 7 : ply::size_of(list.count_type) + 3 * ply::size_of(list.type));
  }

  void skip(const Property& property) {
    const auto count = property.is_list ? list_size(property) : 1;
    if (!is_text_)
      (void)file_.bytes(count * ply::size_of(property.type), "a property");
    else
      for (std::int64_t i = 0; i < count; ++i)
        ply::is_real(property.type) ? (void)file_.real("a property") : (void)integer(property.type, "a property");
  }

  // One property of all records, a table of records of `stride` bytes at `table`.
  void column(const char* table, std::int64_t count, std::int64_t stride, Type type, double* out,
              std::int64_t out_stride) {
    with_type(type, [&]<class T>(T) {
      for (std::int64_t i = 0; i < count; ++i)
        out[i * out_stride] = static_cast<double>(load_number<T>(table + i * stride, swap_));
    });
  }

  // Ids of vertices.
  void vertices(Type type, Index vertex_count, std::span<Index> out) {
    if (is_text_) {
      for (Index& v : out) v = checked(integer(type, "a vertex id"), vertex_count);
      return;
    }
    const auto start = file_.offset();
    const auto size = ply::size_of(type);
    const char* const at =
        file_.bytes(static_cast<std::int64_t>(out.size()) * size, "the vertices of a simplex").data();
    with_type(type, [&]<class T>(T) {
      for (std::size_t i = 0; i < out.size(); ++i) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
        const auto id = static_cast<std::int64_t>(load_number<T>(at + i * sizeof(T), swap_));
        if (id < 0 || id >= vertex_count) file_.rewind(start + static_cast<std::int64_t>(i * sizeof(T)));
        out[i] = checked(id, vertex_count);
      }
    });
  }

  // The usual file fast: of records that are nothing but a list, takes the next ones that are sound triangles, at most
  // `most`, and returns how many they were.
  std::int64_t triangles(const Property& list, std::int64_t most, Index vertex_count, ListedSimplices& rows) {
    if (is_text_ || ply::size_of(list.count_type) != 1) return 0;
    const std::int64_t record = 1 + 3 * ply::size_of(list.type);
    most = std::min(most, file_.remaining() / record);
    const auto start = file_.offset();
    const char* at = file_.bytes(most * record, "the faces").data();
    std::int64_t taken = 0;
    with_type(list.type, [&]<class T>(T) {
      for (; taken < most && *at == 3; ++taken, at += record) {
        std::array<Index, 3> row{};
        bool sound = true;
        for (std::size_t i = 0; i < 3; ++i) {
          // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
          const auto id = static_cast<std::int64_t>(load_number<T>(at + 1 + i * sizeof(T), swap_));
          sound &= id >= 0 && id < vertex_count;
          row[i] = static_cast<Index>(id);
        }
        if (!sound) break;
        rows.add(row);
      }
    });
    file_.rewind(start + taken * record);
    return taken;
  }

  Cursor& file() noexcept { return file_; }

 private:
  Index checked(std::int64_t id, Index vertex_count) {
    if (id < 0 || id >= vertex_count) file_.fail(text("a vertex id is ", id, ", expected 0 to ", vertex_count - 1));
    return static_cast<Index>(id);
  }

  Cursor& file_;
  bool is_text_, swap_;
};

// Where the numbers of a property go: an axis, a field, or nowhere.
struct Target {
  double* first = nullptr;
  std::int64_t stride = 1;
  bool is_position = false;
};

void read_vertices(Numbers& numbers, const Element& element, MeshData& mesh) {
  Cursor& file = numbers.file();
  const auto count = element.count;
  constexpr std::array axes{"x", "y", "z"};
  const auto is_scalar = [&](const char* name) {
    const int at = element.find(name);
    return at >= 0 && !element.properties[static_cast<std::size_t>(at)].is_list;
  };
  while (mesh.ambient_dimension < 3 && is_scalar(axes[static_cast<std::size_t>(mesh.ambient_dimension)]))
    ++mesh.ambient_dimension;
  if (mesh.ambient_dimension == 0) file.fail("the vertices have no property x; expected x, y and z");
  if (count == 0) return;
  mesh.points.resize(static_cast<std::size_t>(count * mesh.ambient_dimension));

  std::vector<Target> targets(element.properties.size());
  std::int64_t record_bytes = 0;
  mesh.fields.reserve(element.properties.size());
  for (std::size_t p = 0; p < targets.size(); ++p) {
    const auto& property = element.properties[p];
    record_bytes += ply::size_of(property.type);
    const auto axis = property.name.size() == 1 ? property.name[0] - 'x' : -1;
    if (axis >= 0 && axis < mesh.ambient_dimension) {
      targets[p] = {mesh.points.data() + axis, mesh.ambient_dimension, true};
    } else if (!property.is_list && ply::is_real(property.type)) {
      mesh.fields.push_back(
          {property.name, MeshField::On::vertices, 1, std::vector<double>(static_cast<std::size_t>(count))});
      targets[p] = {mesh.fields.back().values.data(), 1, false};
    }
  }

  if (!numbers.is_text() && !element.has_lists()) {
    const auto start = file.offset();
    const char* const table = file.bytes(count * record_bytes, "the vertices").data();
    std::int64_t offset = 0;
    for (std::size_t p = 0; p < targets.size(); ++p) {
      const auto& [first, stride, is_position] = targets[p];
      const auto type = element.properties[p].type;
      if (first != nullptr) numbers.column(table + offset, count, record_bytes, type, first, stride);
      for (std::int64_t i = 0; is_position && i < count; ++i) {
        if (std::isfinite(first[i * stride])) continue;
        file.rewind(start + i * record_bytes + offset);
        file.fail(text("found ", first[i * stride], ", expected a finite number as the property ",
                       quoted_token(element.properties[p].name), " of vertex ", i));
      }
      offset += ply::size_of(type);
    }
    return;
  }
  for (std::int64_t i = 0; i < count; ++i) {
    numbers.begin_record(element, i);
    for (std::size_t p = 0; p < targets.size(); ++p)
      if (targets[p].first != nullptr)
        targets[p].first[i * targets[p].stride] =
            numbers.real(element.properties[p].type, "a property of a vertex", targets[p].is_position);
      else
        numbers.skip(element.properties[p]);
    numbers.end_record();
  }
}

// Numbers on faces as they come; which of them are on rows shows only when all faces are known.
struct FaceFields {
  std::vector<MeshField> fields;  // one value per face
  std::vector<std::size_t> widths;

  void move_to(MeshData& mesh) && {
    const auto top = static_cast<std::size_t>(mesh.simplices.dimension()) + 1;
    for (auto& field : fields) {
      std::vector<double> values;
      values.reserve(static_cast<std::size_t>(mesh.simplices.size()));
      for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::size_t rows = widths[i] == top ? 1 : widths[i] > 3 ? widths[i] - 2 : 0;
        values.insert(values.end(), rows, field.values[i]);
      }
      // Edges of an element of their own are rows without such numbers.
      if (values.size() != static_cast<std::size_t>(mesh.simplices.size())) {
        mesh.notes.push_back(
            text("skipped the property ", quoted_token(field.name), " of the faces: not all rows have it"));
        continue;
      }
      field.values = std::move(values);
      mesh.fields.push_back(std::move(field));
    }
  }
};

FaceFields read_faces(Numbers& numbers, const Element& element, Index vertex_count, Polygons& polygons,
                      const ReadOptions& options, ListedSimplices& rows) {
  Cursor& file = numbers.file();
  const int indices =
      element.find("vertex_indices") >= 0 ? element.find("vertex_indices") : element.find("vertex_index");
  if (indices < 0 || !element.properties[static_cast<std::size_t>(indices)].is_list ||
      ply::is_real(element.properties[static_cast<std::size_t>(indices)].type)) {
    if (element.count == 0) return {};
    file.fail("the faces have no list of integers called vertex_indices or vertex_index");
  }
  FaceFields result;
  std::vector<int> field_of(element.properties.size(), -1);
  for (std::size_t p = 0; p < field_of.size(); ++p) {
    const auto& property = element.properties[p];
    if (property.is_list || !ply::is_real(property.type)) continue;
    field_of[p] = static_cast<int>(result.fields.size());
    result.fields.push_back({property.name, MeshField::On::rows, 1, {}});
    result.fields.back().values.reserve(static_cast<std::size_t>(element.count));
  }
  // Most faces are triangles: room for as many as the file can hold.
  const auto& list = element.properties[static_cast<std::size_t>(indices)];
  rows.reserve(2, static_cast<Index>(std::min(element.count, numbers.room_for_triangles(list))));
  std::vector<Index> face;
  for (std::int64_t i = 0; i < element.count; ++i) {
    if (field_of.size() == 1) i += numbers.triangles(list, element.count - i, vertex_count, rows);
    if (i == element.count) break;
    numbers.begin_record(element, i);
    for (std::size_t p = 0; p < field_of.size(); ++p) {
      const auto& property = element.properties[p];
      if (static_cast<int>(p) == indices) {
        const auto here = file.offset();
        const auto width = numbers.list_size(property);
        if (width == 0 || (width > 3 && !options.triangulate)) {
          file.rewind(here);
          if (width > 0) polygons.refuse(static_cast<std::size_t>(width));
          file.fail(text("face ", i, " has no vertices; expected 1 to 3"));
        }
        face.resize(static_cast<std::size_t>(width));
        numbers.vertices(property.type, vertex_count, face);
        polygons.add(face, rows);
      } else if (field_of[p] >= 0) {
        result.fields[static_cast<std::size_t>(field_of[p])].values.push_back(
            numbers.real(property.type, "a property of a face", false));
      } else {
        numbers.skip(property);
      }
    }
    numbers.end_record();
    if (!result.fields.empty()) result.widths.push_back(face.size());
  }
  return result;
}

void read_edges(Numbers& numbers, const Element& element, Index vertex_count, ListedSimplices& rows) {
  std::array<Index, 2> edge{};
  for (const auto* name : {"vertex1", "vertex2"}) {
    const int at = element.find(name);
    if (at < 0 || element.properties[static_cast<std::size_t>(at)].is_list ||
        ply::is_real(element.properties[static_cast<std::size_t>(at)].type))
      numbers.file().fail(text("the edges have no integer property ", name));
  }
  for (std::int64_t i = 0; i < element.count; ++i) {
    numbers.begin_record(element, i);
    for (const auto& property : element.properties)
      if (property.name == "vertex1" || property.name == "vertex2")
        numbers.vertices(property.type, vertex_count, std::span(edge).subspan(property.name == "vertex2", 1));
      else
        numbers.skip(property);
    numbers.end_record();
    rows.add(edge);
  }
}

}  // namespace

MeshData read_ply(Cursor& file, const ReadOptions& options) {
  const auto header = ply::read_header(file);
  MeshData mesh;
  for (const auto& element : header.elements)
    if (element.name == "vertex") mesh.vertex_count = static_cast<Index>(element.count);
  Numbers numbers(file, header);
  ListedSimplices rows;
  Polygons polygons(file, options);
  FaceFields face_fields;
  bool has_vertices = false;
  for (const auto& element : header.elements) {
    if (element.name == "vertex") {
      has_vertices = true;
      read_vertices(numbers, element, mesh);
    } else if (element.name == "face") {
      face_fields = read_faces(numbers, element, mesh.vertex_count, polygons, options, rows);
    } else if (element.name == "edge") {
      read_edges(numbers, element, mesh.vertex_count, rows);
    } else if (element.name == "tristrips" && element.count > 0) {
      file.fail("the faces are given as strips of triangles; expected the element face: save the file without strips");
    } else {
      for (std::int64_t i = 0; i < element.count; ++i) {
        numbers.begin_record(element, i);
        for (const auto& property : element.properties) numbers.skip(property);
        numbers.end_record();
      }
      mesh.notes.push_back(text("skipped ", element.count, " records of the element ", quoted_token(element.name)));
    }
  }
  if (!has_vertices) file.fail("the file has no element vertex");
  if (!numbers.is_text() && file.remaining() > 0)
    file.fail(text(file.remaining(), " bytes follow the last record; expected the end of the file"));
  if (numbers.is_text()) file.end_file();
  polygons.note_on(mesh);
  std::move(rows).move_to(mesh);
  std::move(face_fields).move_to(mesh);
  return mesh;
}

}  // namespace derham
