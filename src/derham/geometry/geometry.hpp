#pragma once

#include "derham/complex/local_faces.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace derham {

/// 16 ulp.
inline constexpr double relative_coordinate_roundoff = 16 * std::numeric_limits<double>::epsilon();

/// 16 ulp of the largest of some coordinates in magnitude: what rounding a rigid motion may do to them.
[[nodiscard]] inline double coordinate_roundoff(std::span<const double> coordinates) noexcept {
  double largest = 0;
  for (const double x : coordinates) largest = std::max(largest, std::abs(x));
  return relative_coordinate_roundoff * largest;
}

/// What a metric is made of.
enum class MetricSource : std::uint8_t {
  points,   ///< one position per vertex
  corners,  ///< positions of the corners of every top simplex on its own (periodic meshes)
  lengths   ///< edge lengths only
};

/// The metric of a pure n-complex, n = 0 to 4: flat top simplices that agree on the lengths of the edges they share.
///
/// Whatever it is made of, every top simplex has corners with coordinates, in the order of its sorted representative;
/// all that is metric is derived from them simplex by simplex, so that an immersion, a periodic mesh and a list of edge
/// lengths are treated alike. Belongs to the complex it was made for; immutable.
template <int n>
class Geometry {
  static_assert(0 <= n && n <= 4, "metric quantities are instantiated for dimensions 0 to 4");

 public:
  /// From positions of the vertices: `points` shape (|V|, m) row-major, m >= n.
  /// Throws   TopologyError if K is not pure; InputError on a wrong shape; GeometryError naming a vertex that is not
  ///          finite
  [[nodiscard]] static Geometry from_points(const SimplicialComplex<n>& K, std::vector<double> points, int m);

  /// From positions of the corners of every top simplex: `corners` shape (|K_n|, n+1, m) row-major, corners in the
  /// order of the sorted representative.
  /// Throws   as from_points; GeometryError naming an edge whose squared length differs between two top simplices by
  ///          more than 1e-9 relative and what an error of 16 ulp of the largest coordinate in its length explains
  [[nodiscard]] static Geometry from_corners(const SimplicialComplex<n>& K, std::vector<double> corners, int m);

  /// From squared edge lengths: shape (|E|,), units length^2.
  /// Throws   TopologyError if K is not pure; InputError on a wrong shape; GeometryError as require_simplex_inequalities,
  ///          naming the first simplex that cannot have these lengths; impossible_simplices lists all (a flat one is
  ///          accepted here and reported as degenerate later)
  [[nodiscard]] static Geometry from_squared_lengths(const SimplicialComplex<n>& K, std::span<const double> squares);

  /// From a mesh whose simplices K was built from: its corners if it has any (brought from the order of the rows to
  /// that of the representatives), else its points.
  /// Throws   GeometryError if the mesh is abstract; otherwise as above
  [[nodiscard]] static Geometry from_mesh(const SimplicialComplex<n>& K, const MeshData& mesh);

  [[nodiscard]] MetricSource source() const noexcept { return source_; }

  /// Dimension m of the space of points or corners; 0 when there are only lengths.
  [[nodiscard]] int ambient_dimension() const noexcept { return source_ == MetricSource::lengths ? 0 : width_; }

  /// Number of coordinates of a corner: m, or n when there are only lengths.
  [[nodiscard]] int coordinate_dimension() const noexcept { return width_; }

  /// Whether top simplices have signed volumes: m = n and coordinates were given.
  [[nodiscard]] bool has_signed_volume() const noexcept { return source_ != MetricSource::lengths && width_ == n; }

  /// Whether the vectors of different top simplices have the same coordinates, so that they can be added: with points, and with
  /// corners whose charts differ by translations only, as in a periodic box, as far as edges that top simplices share show it.
  /// Not with charts that are turned against each other, nor with lengths.
  [[nodiscard]] bool has_common_frame() const noexcept { return common_frame_; }

  /// Positions of the vertices, shape (|V|, m) row-major; empty unless made from points.
  [[nodiscard]] std::span<const double> points() const noexcept {
    return source_ == MetricSource::points ? std::span<const double>(coordinates_) : std::span<const double>();
  }

  /// All coordinates: of the vertices, or of the corners of the top simplices.
  [[nodiscard]] std::span<const double> coordinates() const noexcept { return coordinates_; }

  /// A power of two near the largest coordinate in magnitude where that is beyond 2^±100, else 1.
  [[nodiscard]] double unit() const noexcept { return unit_; }

  /// Where in coordinates() the corners of k-simplex i begin: in the chart of the first top simplex it belongs to unless
  /// made from points. `width` is coordinate_dimension() where that is known at compile time, else 0.
  template <int k, int width = 0>
  [[nodiscard]] std::array<std::size_t, k + 1> corner_places(const SimplicialComplex<n>& K, Index i) const noexcept {
    std::array<std::size_t, k + 1> result{};
    const auto d = static_cast<std::size_t>(width > 0 ? width : width_);
    if (source_ == MetricSource::points) {
      const auto vertices = K.template simplex<k>(i);
      for (std::size_t v = 0; v <= k; ++v) result[v] = static_cast<std::size_t>(vertices[v]) * d;
      return result;
    }
    Carrier carrier{i, full_mask<k>};
    if constexpr (k < n) carrier = carrier_[k][static_cast<std::size_t>(i)];
    std::size_t place = static_cast<std::size_t>(carrier.top) * (n + 1) * d;
    for (std::size_t v = 0; v <= k; carrier.mask >>= 1U, place += d)
      if (carrier.mask & 1U) result[v++] = place;
    return result;
  }

  /// Coordinates of the corners of k-simplex i in the order of its representative, in the same chart; each points to
  /// coordinate_dimension() numbers.
  template <int k = n>
  [[nodiscard]] std::array<const double*, k + 1> corners(const SimplicialComplex<n>& K, Index i) const noexcept {
    std::array<const double*, k + 1> result{};
    const auto places = corner_places<k>(K, i);
    for (std::size_t v = 0; v <= k; ++v) result[v] = coordinates_.data() + places[v];
    return result;
  }

  /// Coordinates of the vertices of k-simplex i, shape (k+1, coordinate_dimension()): in the chart of the first top
  /// simplex it belongs to unless made from points.
  [[nodiscard]] std::vector<double> simplex_corners(const SimplicialComplex<n>& K, int k, Index i) const;

  /// A top simplex counts as flat when its smallest altitude is at most
  /// max(relative_flatness() * longest edge, roundoff(t)).
  /// 1e-12 for coordinates; 1e-7 for lengths, where an altitude is the root of a difference of squares.
  [[nodiscard]] double relative_flatness() const noexcept { return source_ == MetricSource::lengths ? 1e-7 : 1e-12; }

  /// coordinate_roundoff of the corners of a simplex.
  /// Units    length; 0 when there are only lengths
  [[nodiscard]] double roundoff(std::span<const double* const> corners) const noexcept;

  /// roundoff over the largest coordinate.
  [[nodiscard]] double relative_roundoff() const noexcept {
    return source_ == MetricSource::lengths ? 0 : relative_coordinate_roundoff;
  }

  /// Throws InputError unless this geometry was made for a complex with the lists of K: the sizes of all of them, and a sample
  /// of a thousand top simplices, are compared.
  void require_fits(const SimplicialComplex<n>& K) const;

 private:
  Geometry(const SimplicialComplex<n>& K, MetricSource source, int width, std::vector<double> coordinates);
  void find_carriers(const SimplicialComplex<n>& K);

  struct Carrier {
    Index top = -1;
    unsigned mask = 0;
  };

  MetricSource source_;
  int width_;
  std::array<Index, n + 1> sizes_{};  // of the complex
  std::size_t fingerprint_ = 0;       // of its top simplices
  bool common_frame_ = false;
  double unit_ = 1;
  std::vector<double> coordinates_;                  // (|V|, m), or (|K_n|, n+1, d)
  std::array<std::vector<Carrier>, n + 1> carrier_;  // [k < n]: the first top simplex of each; only without points
};

extern template class Geometry<0>;
extern template class Geometry<1>;
extern template class Geometry<2>;
extern template class Geometry<3>;
extern template class Geometry<4>;

}  // namespace derham
