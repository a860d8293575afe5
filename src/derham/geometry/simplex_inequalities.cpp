#include "derham/geometry/simplex_inequalities.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace derham {

namespace {

constexpr int most_vertices = 5;
using Squares = std::array<std::array<double, most_vertices>, most_vertices>;  // of the distances of vertices

template <int n>
Squares squares_of(const SimplicialComplex<n>& K, std::span<const double> squares, int k, Index i) {
  Squares result{};
  const auto v = K.simplex(k, i);
  for (std::size_t a = 0; a < v.size(); ++a)
    for (std::size_t b = a + 1; b < v.size(); ++b)
      result[a][b] = result[b][a] = squares[static_cast<std::size_t>(K.at({v[a], v[b]}).index)];
  return result;
}

/// The square that Cholesky's factorisation of the Gram matrix takes its last root of.
double squared_altitude(const Squares& square, std::size_t k) {
  std::array<std::array<double, most_vertices>, most_vertices> row{};
  double rest = 0;
  for (std::size_t i = 1; i <= k; ++i)
    for (std::size_t j = 1; j <= i; ++j) {
      rest = (square[0][i] + square[0][j] - square[i][j]) / 2;
      for (std::size_t c = 1; c < j; ++c) rest -= row[i][c] * row[j][c];
      if (j == i)
        row[i][i] = std::sqrt(std::max(rest, 0.0));
      else
        row[i][j] = row[j][j] > 0 ? rest / row[j][j] : 0;
    }
  return rest;
}

bool is_length(double square) { return std::isfinite(square) && square > 0; }

/// By how much the longest edge of a triangle is longer than the others together, and which it is.
template <int n>
std::string triangle_text(const SimplicialComplex<n>& K, const Squares& square, Index i) {
  const auto v = K.simplex(2, i);
  std::size_t opposite = 0;
  const auto length = [&](std::size_t corner) { return std::sqrt(square[(corner + 1) % 3][(corner + 2) % 3]); };
  for (const std::size_t corner : {1U, 2U})
    if (length(corner) > length(opposite)) opposite = corner;
  const double others = length((opposite + 1) % 3) + length((opposite + 2) % 3);
  Index a = v[(opposite + 1) % 3], b = v[(opposite + 2) % 3];
  if (a > b) std::swap(a, b);
  return text("its edge (", a, ", ", b, ") is longer than the two others together, by ", length(opposite) - others,
              "; shorten it or lengthen these");
}

}  // namespace

template <int n>
std::vector<ImpossibleSimplex> impossible_simplices(const SimplicialComplex<n>& K, std::span<const double> squares) {
  const Index edges = n > 0 ? K.size(1) : 0;
  if (squares.size() != static_cast<std::size_t>(edges))
    throw InputError(text(squares.size(), " squared lengths; expected ", edges, ", one per edge"));
  std::vector<ImpossibleSimplex> result;
  std::vector<bool> is_impossible;  // or has such a face, in the degree below
  for (int k = 1; k <= n; ++k) {
    std::vector<bool> here(static_cast<std::size_t>(K.size(k)));
    for (Index i = 0; i < K.size(k); ++i) {
      const auto place = static_cast<std::size_t>(i);
      if (k > 1) {
        const auto width = static_cast<std::size_t>(k) + 1;
        const auto faces = K.face_table(k).subspan(place * width, width);
        here[place] = std::ranges::any_of(faces, [&](Index f) { return is_impossible[static_cast<std::size_t>(f)]; });
        if (here[place]) continue;
      }
      const Squares square = squares_of(K, squares, k, i);
      const double altitude = squared_altitude(square, static_cast<std::size_t>(k));
      // As much as rounding may do to a flat simplex is allowed.
      here[place] = k == 1 ? !is_length(altitude) : altitude < -1e-14 * square[0][static_cast<std::size_t>(k)];
      if (here[place]) result.push_back({k, i, altitude});
    }
    is_impossible = std::move(here);
  }
  return result;
}

template <int n>
void require_simplex_inequalities(const SimplicialComplex<n>& K, std::span<const double> squares) {
  const auto all = impossible_simplices(K, squares);
  if (all.empty()) return;
  const auto [k, i, altitude] = all.front();
  std::string what;
  if (k == 1) {
    what = text("squared length of edge ", i, " = ", tuple_text(K.simplex(1, i)), " is ", altitude,
                "; it must be positive and finite");
  } else {
    what = text("no Euclidean simplex has the edge lengths of ", simplex_text(K, k, i), ": ");
    what += k == 2 ? triangle_text(K, squares_of(K, squares, 2, i), i)
                   : text("the squared altitude of its vertex ", K.simplex(k, i).back(), " would be ", altitude,
                          "; lengthen the edges at this vertex or shorten the others");
  }
  if (all.size() > 1)
    what += text(" (and ", all.size() - 1, " more ", all.size() == 2 ? "simplex violates" : "simplices violate",
                 " the simplex inequalities; impossible_simplices lists them)");
  throw GeometryError(what);
}

#define DERHAM_INSTANTIATE(n)                                                                  \
  template std::vector<ImpossibleSimplex> impossible_simplices<n>(const SimplicialComplex<n>&, \
                                                                  std::span<const double>);    \
  template void require_simplex_inequalities<n>(const SimplicialComplex<n>&, std::span<const double>);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
