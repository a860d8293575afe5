#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace derham {

class TextWriter;

/// A VTK unstructured grid (.vtu, raw appended data, 64-bit headers) that ParaView and VTK open: simplices with data.
///
///   VtuFile(mesh).point_data("temperature", u.values()).cell_data("sign", signs).write("heat.vtu");
///
/// A k-form is drawn as cell data on a file of the k-simplices: VtuFile(m, points, SimplexList(k, K.simplices(k))).
/// Points and data are not copied: they must live until `write`.
class VtuFile {
 public:
  /// The values of a data array, all components of an item together.
  using Values = std::variant<std::span<const double>, std::span<const std::int8_t>, std::span<const std::int32_t>,
                              std::span<const std::int64_t>>;

  /// The rows of a mesh, one cell each. A periodic mesh gets one point per corner of every row (its point data are
  /// still given per vertex).
  /// Throws   InputError if a row has more than 4 vertices, m > 3, there are no positions or a wrong number of them, or
  ///          an id is outside [0, vertex_count)
  explicit VtuFile(const MeshData& mesh);

  /// Simplices of dimension <= 3 (dimensions may be mixed) on `points`, shape (vertices, m) row-major with 1 <= m <= 3.
  VtuFile(int m, std::span<const double> points, SimplexList simplices);

  /// Adds an array with `components` values for every vertex (every simplex).
  /// Throws   InputError if the number of values is not vertices × components (simplices × components), or the name is
  ///          empty or that of another array
  VtuFile& point_data(std::string name, Values values, int components = 1);
  VtuFile& cell_data(std::string name, Values values, int components = 1);

  /// Writes the file, complete or not at all; "-" is standard output. Throws FileError if it cannot be written.
  void write(const std::string& path) const;
  /// As above; `as_text` writes numbers as text inside the XML instead of appended bytes (arrays with values that are
  /// infinite or NaN in base64: VTK does not read these as text).
  void write(TextWriter& file, bool as_text = false) const;

 private:
  struct Array {
    std::string name;
    Values values;
    int components;
  };
  void require_valid() const;
  [[nodiscard]] static Array checked(const std::vector<Array>& others, std::string name, Values values, int components,
                                     Offset items);

  int ambient_dimension_;
  std::span<const double> points_;
  SimplexList simplices_;
  Offset vertex_count_;
  bool one_point_per_corner_ = false;  // point i then shows vertex simplices_.vertices()[i]
  std::vector<Array> point_arrays_, cell_arrays_;
};

}  // namespace derham
