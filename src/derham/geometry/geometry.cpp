#include "derham/geometry/geometry.hpp"

#include "derham/complex/local_faces.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/simplex_inequalities.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace derham {

namespace {

template <int n>
void require_pure(const SimplicialComplex<n>& K) {
  if (K.is_pure()) return;
  const RowTarget lower = K.maximal_lower().front();
  throw TopologyError(text("a metric needs a pure complex of dimension ", n, ", but ",
                           simplex_text(K, lower.degree, lower.index), " is no face of a ", n,
                           "-simplex; give simplices of one dimension"));
}

void require_shape(const char* what, std::size_t given, Offset rows, const char* row, Offset width) {
  if (given != static_cast<std::size_t>(rows * width))
    throw InputError(text(given, " ", what, "; expected ", rows, " ", row, " times ", width));
}

void require_dimension(int m, int n) {
  if (m < n)
    throw InputError(text("positions in dimension ", m, "; a complex of dimension ", n, " needs at least ", n));
}

// Squared length of the edge between corners a and b.
double squared_distance(const double* a, const double* b, int d) {
  double sum = 0;
  for (int c = 0; c < d; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// A hash of some top simplices, spread over the list.
template <int n>
std::size_t fingerprint_of(const SimplicialComplex<n>& K) {
  constexpr Index samples = 1024;
  std::size_t hash = 0xcbf29ce484222325;  // FNV-1a
  const Index count = std::min(K.size(n), samples);
  for (Index i = 0; i < count; ++i)
    for (const Index v : K.simplex(n, static_cast<Index>(Offset{i} * K.size(n) / count)))
      hash = (hash ^ static_cast<std::size_t>(v)) * 0x100000001b3;
  return hash;
}

// Whether the edge between corners a and b is the same vector as the one from p to q, up to the rounding of coordinates.
bool is_translated(const double* a, const double* b, const double* p, const double* q, int d, double allowed) {
  double square = 0;
  for (int c = 0; c < d; ++c) {
    const double difference = (b[c] - a[c]) - (q[c] - p[c]);
    square += difference * difference;
  }
  return std::sqrt(square) <= allowed;
}

// Every edge must have the same length in all top simplices. Whether it is the same vector, too.
template <int n>
bool require_consistent(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  bool common_frame = true;
  constexpr double tolerance = 1e-9;
  struct Known {
    double square = -1, roundoff = 0;
  };
  std::vector<Known> edges(static_cast<std::size_t>(K.size(1)));
  for (Index t = 0; t < K.size(n); ++t) {
    const auto index = face_indices(K, t);
    const auto corner = geometry.corners(K, t);
    const double here = geometry.roundoff(corner);
    for (int a = 0; a <= n; ++a)
      for (int b = a + 1; b <= n; ++b) {
        const Index e = index[(1U << a) | (1U << b)];
        auto& [known, there] = edges[static_cast<std::size_t>(e)];
        const int d = geometry.coordinate_dimension();
        const double square = squared_distance(corner[a], corner[b], d);
        if (known < 0) {
          known = square;
          there = here;
          continue;
        }
        const double largest = std::max(square, known), roundoff = std::max(here, there);
        const double allowed = tolerance * largest + roundoff * (2 * std::sqrt(largest) + roundoff);
        if (std::abs(square - known) > allowed)
          throw GeometryError(text("corner coordinates disagree on edge ", e, " = ", tuple_text(K.simplex(1, e)),
                                   ": squared length ", std::setprecision(std::numeric_limits<double>::max_digits10),
                                   known, " in one top simplex, ", square, " in ", simplex_text(K, n, t),
                                   std::setprecision(3), "; they must agree to ", allowed));
        const auto first = geometry.template corners<1>(K, e);
        common_frame = common_frame && is_translated(corner[a], corner[b], first[0], first[1], d,
                                                     tolerance * std::sqrt(largest) + 2 * roundoff);
      }
  }
  return common_frame;
}

}  // namespace

template <int n>
Geometry<n>::Geometry(const SimplicialComplex<n>& K, MetricSource source, int width, std::vector<double> coordinates)
    : source_(source), width_(width), fingerprint_(fingerprint_of(K)), common_frame_(source == MetricSource::points),
      coordinates_(std::move(coordinates)) {
  for (int k = 0; k <= n; ++k) sizes_[static_cast<std::size_t>(k)] = K.size(k);
  double largest = 0;
  for (const double x : coordinates_) largest = std::max(largest, std::abs(x));
  if (largest > 0 && !(largest >= 0x1p-100 && largest <= 0x1p100))
    unit_ = std::ldexp(1.0, std::max(std::ilogb(largest), -1000));
  if (source_ != MetricSource::points) find_carriers(K);
}

template <int n>
void Geometry<n>::find_carriers(const SimplicialComplex<n>& K) {
  for (int k = 0; k < n; ++k) carrier_[static_cast<std::size_t>(k)].resize(static_cast<std::size_t>(K.size(k)));
  for (Index t = 0; t < K.size(n); ++t) {
    const auto index = face_indices(K, t);
    for (unsigned mask = 1; mask < full_mask<n>; ++mask) {
      Carrier& carrier = carrier_[static_cast<std::size_t>(mask_degree(mask))][static_cast<std::size_t>(index[mask])];
      if (carrier.top < 0) carrier = {t, mask};
    }
  }
}

template <int n>
Geometry<n> Geometry<n>::from_points(const SimplicialComplex<n>& K, std::vector<double> points, int m) {
  require_pure(K);
  require_dimension(m, n);
  require_shape("coordinates", points.size(), K.size(0), "vertices", m);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i])) {
      const auto v = i / static_cast<std::size_t>(m), axis = i % static_cast<std::size_t>(m);
      throw GeometryError(text("coordinate ", axis, " of vertex ", v, " is ", points[i], "; positions must be finite"));
    }
  return Geometry(K, MetricSource::points, m, std::move(points));
}

template <int n>
Geometry<n> Geometry<n>::from_corners(const SimplicialComplex<n>& K, std::vector<double> corners, int m) {
  require_pure(K);
  require_dimension(m, n);
  require_shape("corner coordinates", corners.size(), K.size(n), "top simplices", Offset{n + 1} * m);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (!std::isfinite(corners[i])) {
      const auto corner = i / static_cast<std::size_t>(m), t = corner / (n + 1);
      throw GeometryError(text("a coordinate of vertex ", K.simplex(n, static_cast<Index>(t))[corner % (n + 1)],
                               " as a corner of ", simplex_text(K, n, static_cast<Index>(t)), " is ", corners[i],
                               "; positions must be finite"));
    }
  Geometry geometry(K, MetricSource::corners, m, std::move(corners));
  geometry.common_frame_ = true;
  if constexpr (n > 0) geometry.common_frame_ = require_consistent(K, geometry);
  return geometry;
}

template <int n>
Geometry<n> Geometry<n>::from_squared_lengths(const SimplicialComplex<n>& K, std::span<const double> squares) {
  require_pure(K);
  require_shape("squared lengths", squares.size(), K.size(1), "edges", 1);
  if (std::ranges::any_of(squares, [](double square) { return !std::isfinite(square) || square <= 0; }))
    require_simplex_inequalities(K, squares);
  // Cholesky's factor of the Gram matrix of the edges from corner 0 has their coordinates as rows.
  std::vector<double> corners(static_cast<std::size_t>(K.size(n)) * (n + 1) * n, 0.0);
  for (Index t = 0; t < K.size(n); ++t) {
    double* row = corners.data() + static_cast<std::size_t>(t) * (n + 1) * n;
    const auto index = face_indices(K, t);
    const auto square = [&](int a, int b) {
      return a == b ? 0.0 : squares[static_cast<std::size_t>(index[(1U << a) | (1U << b)])];
    };
    for (int i = 1; i <= n; ++i)
      for (int j = 1; j <= i; ++j) {
        double rest = (square(0, i) + square(0, j) - square(i, j)) / 2;
        for (int c = 0; c < j - 1; ++c) rest -= row[i * n + c] * row[j * n + c];
        const double pivot = row[j * n + j - 1];
        if (j < i) {
          row[i * n + j - 1] = pivot > 0 ? rest / pivot : 0;
        } else {
          if (rest < -1e-14 * square(0, i)) require_simplex_inequalities(K, squares);
          row[i * n + i - 1] = std::sqrt(std::max(rest, 0.0));
        }
      }
  }
  return Geometry(K, MetricSource::lengths, n, std::move(corners));
}

template <int n>
Geometry<n> Geometry<n>::from_mesh(const SimplicialComplex<n>& K, const MeshData& mesh) {
  const int m = mesh.ambient_dimension;
  if (mesh.has_corners()) {
    require_pure(K);
    require_shape("corner coordinates", mesh.corners.size(), mesh.simplices.size(), "rows", Offset{n + 1} * m);
    require_shape("rows", static_cast<std::size_t>(mesh.simplices.size()), K.size(n), "top simplices", 1);
    std::vector<double> sorted(mesh.corners.size());
    std::array<std::size_t, n + 1> order{};
    for (Offset row = 0; row < mesh.simplices.size(); ++row) {
      const auto vertices = mesh.simplices[row];
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return vertices[a] < vertices[b]; });
      const auto at = [&](std::size_t corner) {
        return (static_cast<std::size_t>(row) * (n + 1) + corner) * static_cast<std::size_t>(m);
      };
      for (std::size_t i = 0; i <= n; ++i) std::copy_n(mesh.corners.data() + at(order[i]), m, sorted.data() + at(i));
    }
    return from_corners(K, std::move(sorted), m);
  }
  if (!mesh.has_points() && K.size(0) > 0)
    throw GeometryError(
        "the mesh is abstract: it has no positions, so it has no metric; give positions or edge lengths");
  return from_points(K, mesh.points, m);
}

template <int n>
std::vector<double> Geometry<n>::simplex_corners(const SimplicialComplex<n>& K, int k, Index i) const {
  const auto d = static_cast<std::size_t>(width_);
  std::vector<double> result;
  result.reserve((static_cast<std::size_t>(k) + 1) * d);
  if (source_ == MetricSource::points) {
    for (const Index v : K.simplex(k, i)) {
      const double* p = coordinates_.data() + static_cast<std::size_t>(v) * d;
      result.insert(result.end(), p, p + d);
    }
    return result;
  }
  const Carrier carrier =
      k == n ? Carrier{i, full_mask<n>} : carrier_[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
  const auto corner = corners(K, carrier.top);
  for (int v = 0; v <= n; ++v)
    if ((carrier.mask >> v) & 1U) result.insert(result.end(), corner[v], corner[v] + d);
  return result;
}

template <int n>
double Geometry<n>::roundoff(std::span<const double* const> corners) const noexcept {
  if (source_ == MetricSource::lengths) return 0;
  double largest = 0;
  for (const double* p : corners)
    largest = std::max(largest, coordinate_roundoff({p, static_cast<std::size_t>(width_)}));
  return largest;
}

template <int n>
void Geometry<n>::require_fits(const SimplicialComplex<n>& K) const {
  for (int k = 0; k <= n; ++k)
    if (K.size(k) != sizes_[static_cast<std::size_t>(k)])
      throw InputError(text("the geometry was made for a complex of ", sizes_[static_cast<std::size_t>(k)], " ", k,
                            "-simplices; this one has ", K.size(k)));
  if (fingerprint_of(K) != fingerprint_)
    throw InputError(
        "the geometry was made for a complex with other simplices, though as many; after renumbering make it anew from "
        "the renumbered mesh");
}

template class Geometry<0>;
template class Geometry<1>;
template class Geometry<2>;
template class Geometry<3>;
template class Geometry<4>;

}  // namespace derham
