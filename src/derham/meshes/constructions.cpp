#include "derham/meshes/constructions.hpp"

#include "derham/complex/simplex.hpp"
#include "derham/meshes/counts.hpp"
#include "derham/meshes/soundness.hpp"

#include <numeric>
#include <string>
#include <utility>

namespace derham::meshes {
namespace {

/// The number of vertices of a list that has been found free of negative ids.
Index checked_bound(const SimplexList& A) {
  detail::require_ids(A);
  return A.vertex_bound();
}

Index checked_sum(Index a, Index b) {
  if (b > std::numeric_limits<Index>::max() - a)
    throw LimitError(text(a, " + ", b, " vertices exceed ", std::numeric_limits<Index>::max(), ", the largest index"));
  return a + b;
}

/// Appends `row` with `shift` added to every vertex.
void append_shifted(std::vector<Index>& out, std::span<const Index> row, Index shift) {
  for (const Index v : row) out.push_back(v + shift);
}

/// The rows of A with those of B after them, their vertices shifted by `shift`.
SimplexList side_by_side(const SimplexList& A, const SimplexList& B, Index shift) {
  SimplexList result = A;
  std::vector<Index> row;
  for (Offset j = 0; j < B.size(); ++j) {
    row.clear();
    append_shifted(row, B[j], shift);
    result.push_back(row);
  }
  return result;
}

void require_degree(int degree) {
  if (degree > max_dimension)
    throw LimitError(text("the result has dimension ", degree, "; complexes have at most ", max_dimension));
}

/// All staircases from (0, 0) to (p, q): each lists its p+q+1 places (i, j), with the sign of its order.
struct Staircase {
  std::vector<std::pair<std::uint8_t, std::uint8_t>> places;
  bool odd = false;
};
std::vector<Staircase> staircases(int p, int q) {
  std::vector<Staircase> all;
  std::vector<bool> in_second(static_cast<std::size_t>(p + q));  // which steps go along the second factor
  std::fill(in_second.begin() + p, in_second.end(), true);
  do {
    Staircase stairs;
    std::uint8_t i = 0, j = 0;
    stairs.places.emplace_back(i, j);
    for (const bool second : in_second) {
      if (!second && j % 2) stairs.odd = !stairs.odd;  // this step of A comes after j steps of B
      ++(second ? j : i);
      stairs.places.emplace_back(i, j);
    }
    all.push_back(std::move(stairs));
  } while (std::next_permutation(in_second.begin(), in_second.end()));
  return all;
}

}  // namespace

SimplexList disjoint_union(const SimplexList& A, const SimplexList& B) {
  const Index shift = checked_bound(A);
  checked_sum(shift, checked_bound(B));
  return side_by_side(A, B, shift);
}

MeshData disjoint_union(const MeshData& A, const MeshData& B) {
  detail::require_sound(A);
  detail::require_sound(B);
  if (A.ambient_dimension != B.ambient_dimension || A.has_points() != B.has_points() ||
      A.has_corners() != B.has_corners())
    throw InputError(text("the meshes live in spaces of dimension ", A.ambient_dimension, " and ", B.ambient_dimension,
                          ", or one has points and the other corners or nothing; both must have the same"));
  MeshData result;
  result.ambient_dimension = A.ambient_dimension;
  result.vertex_count = checked_sum(A.vertex_count, B.vertex_count);
  result.simplices = side_by_side(A.simplices, B.simplices, A.vertex_count);
  result.points = A.points;
  result.points.insert(result.points.end(), B.points.begin(), B.points.end());
  result.corners = A.corners;
  result.corners.insert(result.corners.end(), B.corners.begin(), B.corners.end());
  return result;
}

SimplexList join(const SimplexList& A, const SimplexList& B) {
  if (A.empty()) return B;
  if (B.empty()) return A;
  const Index shift = checked_bound(A);
  checked_sum(shift, checked_bound(B));
  require_degree(A.dimension() + B.dimension() + 1);
  detail::checked_count("simplices", {A.size(), B.size()});
  SimplexList result;
  std::vector<Index> row;
  for (Offset i = 0; i < A.size(); ++i)
    for (Offset j = 0; j < B.size(); ++j) {
      row.assign(A[i].begin(), A[i].end());
      append_shifted(row, B[j], shift);
      result.push_back(row);
    }
  return result;
}

SimplexList cone(const SimplexList& A) { return join(A, {{0}}); }

SimplexList suspension(const SimplexList& A) {
  SimplexList result = cone(A);
  const Index second = checked_sum(A.vertex_bound(), 1);
  std::vector<Index> row;
  for (Offset i = 0; i < A.size(); ++i) {
    row.assign(A[i].begin(), A[i].end());
    row.insert(row.end() - 1, second);  // one swap away from the first cone, and so coherent with it
    result.push_back(row);
  }
  if (A.empty()) result.push_back({second});
  return result;
}

SimplexList product(const SimplexList& A, const SimplexList& B) {
  const Index width = checked_bound(B);
  detail::checked_count("vertices", {checked_bound(A), width});
  const int p_max = A.dimension(), q_max = B.dimension();
  require_degree(p_max + q_max);
  if (A.empty() || B.empty()) return {};
  detail::checked_count("simplices", {A.size(), B.size(), binomial(p_max + q_max, p_max)});

  std::vector<std::vector<Staircase>> tables(static_cast<std::size_t>((p_max + 1) * (q_max + 1)));
  SimplexList result;
  std::vector<Index> a, b, row;
  for (Offset i = 0; i < A.size(); ++i) {
    a.assign(A[i].begin(), A[i].end());
    const Sign sign_a = sort_with_sign(a);
    if (sign_a == 0)
      throw InputError(text("row ", i, " ", tuple_text(A[i]), " of the first factor repeats a vertex"), i);
    for (Offset j = 0; j < B.size(); ++j) {
      b.assign(B[j].begin(), B[j].end());
      const Sign sign_b = sort_with_sign(b);
      if (sign_b == 0)
        throw InputError(text("row ", j, " ", tuple_text(B[j]), " of the second factor repeats a vertex"), j);
      const auto p = static_cast<int>(a.size()) - 1, q = static_cast<int>(b.size()) - 1;
      auto& table = tables[static_cast<std::size_t>(p * (q_max + 1) + q)];
      if (table.empty()) table = staircases(p, q);
      for (const Staircase& stairs : table) {
        row.clear();
        for (const auto& [u, v] : stairs.places) row.push_back(a[u] * width + b[v]);
        if ((sign_a != sign_b) != stairs.odd) std::swap(row.end()[-1], row.end()[-2]);
        result.push_back(row);
      }
    }
  }
  return result;
}

MeshData product(const MeshData& A, const MeshData& B) {
  detail::require_sound(A);
  detail::require_sound(B);
  if (A.has_corners() || B.has_corners() || A.has_points() != B.has_points())
    throw InputError("a product needs points on both factors or on none, and cannot take corners");
  MeshData result;
  result.simplices = product(A.simplices, B.simplices);
  const Index a_count = A.simplices.vertex_bound(), b_count = B.simplices.vertex_bound();
  result.vertex_count = a_count * b_count;
  if (!A.has_points()) return result;
  const auto m_a = static_cast<std::size_t>(A.ambient_dimension), m_b = static_cast<std::size_t>(B.ambient_dimension);
  result.ambient_dimension = A.ambient_dimension + B.ambient_dimension;
  result.points.reserve(static_cast<std::size_t>(result.vertex_count) * (m_a + m_b));
  for (std::size_t u = 0; u < static_cast<std::size_t>(a_count); ++u)
    for (std::size_t v = 0; v < static_cast<std::size_t>(b_count); ++v) {
      for (std::size_t axis = 0; axis < m_a; ++axis) result.points.push_back(A.points[u * m_a + axis]);
      for (std::size_t axis = 0; axis < m_b; ++axis) result.points.push_back(B.points[v * m_b + axis]);
    }
  return result;
}

SimplexList quotient(const SimplexList& A, std::span<const Index> image) {
  if (static_cast<std::size_t>(checked_bound(A)) > image.size())
    throw InputError(text("image has ", image.size(), " entries; the complex has ", A.vertex_bound(), " vertices"));
  SimplexList result = A;
  for (Index& v : result.vertices()) {
    if (image[static_cast<std::size_t>(v)] < 0)
      throw InputError(
          text("vertex ", v, " has the image ", image[static_cast<std::size_t>(v)], "; images are 0 or more"));
    v = image[static_cast<std::size_t>(v)];
  }

  SimplexList sorted = result;
  std::vector<Offset> order;
  Offset begin = 0;
  for (Offset i = 0; i < result.size(); ++i) {
    const auto row = sorted.vertices().subspan(static_cast<std::size_t>(begin), result[i].size());
    begin += static_cast<Offset>(row.size());
    order.push_back(i);
    if (sort_with_sign(row) == 0)
      throw InputError(text("row ", i, " ", tuple_text(A[i]), " becomes ", tuple_text(result[i]),
                            ", which repeats a vertex; subdivide before taking the quotient"),
                       i);
  }
  const auto less = [&](Offset i, Offset j) { return std::ranges::lexicographical_compare(sorted[i], sorted[j]); };
  std::ranges::stable_sort(order, less);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (std::ranges::equal(sorted[order[i - 1]], sorted[order[i]]))
      throw InputError(
          text("rows ", order[i - 1], " ", tuple_text(A[order[i - 1]]), " and ", order[i], " ", tuple_text(A[order[i]]),
               " become one; subdivide before taking the quotient, or leave one of them out"),
          order[i]);
  return result;
}

MeshData quotient(const MeshData& A, std::span<const Index> image) {
  detail::require_sound(A);
  MeshData result;
  result.simplices = quotient(A.simplices, image);
  result.vertex_count = result.simplices.vertex_bound();
  result.ambient_dimension = A.ambient_dimension;
  result.corners = A.corners;
  if (!A.has_points()) return result;
  const auto m = static_cast<std::size_t>(A.ambient_dimension);
  for (const Index v : A.simplices.vertices()) {
    const auto point = A.points.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(v) * m);
    result.corners.insert(result.corners.end(), point, point + static_cast<std::ptrdiff_t>(m));
  }
  return result;
}

}  // namespace derham::meshes
