#include "derham/complex/simplicial_complex.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/counts.hpp"
#include "derham/meshes/soundness.hpp"

#include <bit>
#include <numeric>
#include <utility>

namespace derham::meshes {
namespace {

/// The (n+1)! maximal flags of an n-simplex, shape ((n+1)!, n+1): an entry is a set of vertex places as bits. Odd flags
/// have their last two entries swapped, so that all are oriented as the simplex.
std::vector<std::uint8_t> flags(int n) {
  std::vector<int> order(static_cast<std::size_t>(n) + 1);
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::uint8_t> sets;
  do {
    unsigned set = 0;
    bool odd = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      sets.push_back(static_cast<std::uint8_t>(set |= 1u << order[i]));
      for (std::size_t j = 0; j < i; ++j) odd ^= order[j] > order[i];
    }
    if (odd) std::swap(sets.end()[-1], sets.end()[-2]);
  } while (std::ranges::next_permutation(order).found);
  return sets;
}

/// The mean of the points (or corners) of the vertices of a row that are in `set`.
void append_mean(std::span<const double> positions, std::span<const Index> places, std::size_t m, unsigned set,
                 std::vector<double>& out) {
  for (std::size_t axis = 0; axis < m; ++axis) {
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (set >> i & 1) sum += positions[static_cast<std::size_t>(places[i]) * m + axis];
    out.push_back(sum / std::popcount(set));
  }
}

template <int n>
MeshData subdivision(const MeshData& A) {
  const Offset rows = detail::checked_count("simplices", {A.simplices.size(), factorial(n + 1)});
  const SimplicialComplex<n> K(A.simplices);
  std::array<Index, n + 1> first{};  // number of the barycentre of simplex 0 of each degree
  Offset count = 0;
  for (int k = 0; k <= n; ++k) {
    first[static_cast<std::size_t>(k)] = static_cast<Index>(count);
    count += K.size(k);
    detail::checked_count("vertices", {count});
  }

  MeshData result;
  result.vertex_count = static_cast<Index>(count);
  result.ambient_dimension = A.ambient_dimension;
  const auto m = static_cast<std::size_t>(A.ambient_dimension);
  if (A.has_points())
    for (int k = 0; k <= n; ++k)
      for (Index i = 0; i < K.size(k); ++i) append_mean(A.points, K.simplex(k, i), m, (2u << k) - 1, result.points);

  constexpr unsigned whole = (2u << n) - 1;
  const std::vector<std::uint8_t> sets = flags(n);
  std::array<Index, whole + 1> index{}, vertex{};  // of the face with the sorted places in a set
  std::array<Index, n + 1> corner_places{};
  std::vector<Index> vertices;
  vertices.reserve(static_cast<std::size_t>(rows) * (n + 1));
  for (Index t = 0; t < K.size(n); ++t) {
    index[whole] = t;
    for (unsigned set = whole; set > 0; --set) {
      const int k = std::popcount(set) - 1;
      vertex[set] = first[static_cast<std::size_t>(k)] + index[set];
      int place = 0;
      for (unsigned rest = set; k > 0 && rest != 0; rest &= rest - 1, ++place)
        index[set & ~(rest & -rest)] = K.face_opposite(k, index[set], place);
    }
    // The flags refer to the row as it was given, the complex to the sorted representative.
    const auto row = A.simplices[t];
    const auto sorted = K.template simplex<n>(t);
    std::array<unsigned, n + 1> bit{};
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= n; ++j)
        if (sorted[j] == row[i]) bit[i] = 1u << j;
    for (const std::uint8_t set : sets) {
      unsigned sorted_set = 0;
      for (std::size_t i = 0; i <= n; ++i)
        if (set >> i & 1) sorted_set |= bit[i];
      vertices.push_back(vertex[sorted_set]);
      if (!A.has_corners()) continue;
      std::iota(corner_places.begin(), corner_places.end(), t * (n + 1));
      append_mean(A.corners, corner_places, m, set, result.corners);
    }
  }
  result.simplices = SimplexList(n, std::move(vertices));
  return result;
}

}  // namespace

MeshData barycentric_subdivision(const MeshData& A) {
  detail::require_sound(A);
  if (!A.simplices.is_uniform())
    throw InputError("the rows have different dimensions; a subdivision needs rows of one");
  switch (A.simplices.dimension()) {
    case -1:
      return A;
    case 0:
      return subdivision<0>(A);
    case 1:
      return subdivision<1>(A);
    case 2:
      return subdivision<2>(A);
    case 3:
      return subdivision<3>(A);
    case 4:
      return subdivision<4>(A);
    case 5:
      return subdivision<5>(A);
    case 6:
      return subdivision<6>(A);
    default:
      throw LimitError(
          text("the rows have dimension ", A.simplices.dimension(), "; complexes have at most ", max_dimension));
  }
}

SimplexList barycentric_subdivision(const SimplexList& A) {
  MeshData mesh;
  mesh.simplices = A;
  mesh.vertex_count = A.vertex_bound();
  return barycentric_subdivision(mesh).simplices;
}

}  // namespace derham::meshes
