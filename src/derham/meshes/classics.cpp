#include "derham/meshes/classics.hpp"

#include "derham/complex/simplicial_complex.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/counts.hpp"
#include "derham/meshes/polytopes.hpp"

#include <numeric>

namespace derham::meshes {

SimplexList path(Index size) {
  detail::require_at_least("the number of edges", size, 1);
  SimplexList edges;
  for (Index i = 0; i < size; ++i) edges.push_back({i, i + 1});
  return edges;
}

SimplexList cycle(Index size) {
  detail::require_at_least("the number of edges", size, 3);
  SimplexList edges = path(size - 1);
  edges.push_back({size - 1, 0});
  return edges;
}

SimplexList sphere(int n) { return simplex_boundary(n).simplices; }

SimplexList projective_plane() {
  return {{0, 1, 2}, {0, 2, 3}, {0, 1, 5}, {0, 4, 5}, {0, 3, 4}, {1, 2, 4}, {1, 3, 4}, {1, 3, 5}, {2, 3, 5}, {2, 4, 5}};
}

SimplexList klein_bottle() {
  return {{2, 3, 7}, {1, 2, 3}, {1, 3, 5}, {1, 5, 7}, {1, 4, 7}, {2, 4, 6}, {1, 2, 6}, {1, 6, 0},
          {1, 4, 0}, {2, 4, 0}, {3, 4, 7}, {3, 4, 6}, {3, 5, 6}, {5, 6, 0}, {2, 5, 0}, {2, 5, 7}};
}

SimplexList csaszar_torus() {
  SimplexList triangles;
  for (Index i = 0; i < 7; ++i) {
    triangles.push_back({i, (i + 1) % 7, (i + 3) % 7});
    triangles.push_back({i, (i + 3) % 7, (i + 2) % 7});
  }
  return triangles;
}

SimplexList moebius_strip() {
  SimplexList triangles;
  for (Index i = 0; i < 5; ++i) triangles.push_back({i, (i + 1) % 5, (i + 2) % 5});
  return triangles;
}

SimplexList annulus() { return {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}}; }

SimplexList complex_projective_plane() {
  // Vertices are the points of a 3 x 3 grid, v = 3 row + column; the group shifts rows and columns.
  SimplexList facets;
  for (const auto& seed : {std::array<Index, 5>{0, 1, 2, 6, 7}, {0, 1, 3, 4, 8}, {0, 1, 3, 5, 6}, {0, 1, 3, 6, 8}})
    for (Index shift = 0; shift < 9; ++shift) {
      std::array<Index, 5> facet{};
      std::ranges::transform(seed, facet.begin(),
                             [&](Index v) { return (v / 3 + shift / 3) % 3 * 3 + (v + shift) % 3; });
      facets.push_back(facet);
    }
  return facets;
}

SimplexList poincare_sphere() {
  return {{0, 1, 3, 8},    {0, 1, 3, 14},   {0, 1, 5, 13},   {0, 1, 5, 14},    {0, 1, 8, 13},    {0, 2, 3, 11},
          {0, 2, 3, 14},   {0, 2, 6, 9},    {0, 2, 6, 11},   {0, 2, 9, 14},    {0, 3, 8, 11},    {0, 4, 5, 12},
          {0, 4, 5, 13},   {0, 4, 7, 10},   {0, 4, 7, 12},   {0, 4, 10, 13},   {0, 5, 12, 14},   {0, 6, 7, 9},
          {0, 6, 7, 10},   {0, 6, 10, 11},  {0, 7, 9, 12},   {0, 8, 10, 11},   {0, 8, 10, 13},   {0, 9, 12, 14},
          {1, 2, 4, 9},    {1, 2, 4, 10},   {1, 2, 6, 9},    {1, 2, 6, 12},    {1, 2, 10, 12},   {1, 3, 8, 12},
          {1, 3, 10, 12},  {1, 3, 10, 14},  {1, 4, 7, 10},   {1, 4, 7, 11},    {1, 4, 9, 11},    {1, 5, 9, 11},
          {1, 5, 9, 13},   {1, 5, 11, 14},  {1, 6, 8, 12},   {1, 6, 8, 13},    {1, 6, 9, 13},    {1, 7, 10, 14},
          {1, 7, 11, 14},  {2, 3, 4, 13},   {2, 3, 4, 14},   {2, 3, 11, 13},   {2, 4, 9, 14},    {2, 4, 10, 13},
          {2, 6, 11, 12},  {2, 10, 12, 13}, {2, 11, 12, 13}, {3, 4, 5, 6},     {3, 4, 5, 13},    {3, 4, 6, 14},
          {3, 5, 6, 10},   {3, 5, 9, 10},   {3, 5, 9, 13},   {3, 6, 10, 14},   {3, 7, 8, 11},    {3, 7, 8, 12},
          {3, 7, 9, 12},   {3, 7, 9, 13},   {3, 7, 11, 13},  {3, 9, 10, 12},   {4, 5, 6, 12},    {4, 6, 8, 12},
          {4, 6, 8, 14},   {4, 7, 8, 11},   {4, 7, 8, 12},   {4, 8, 9, 11},    {4, 8, 9, 14},    {5, 6, 10, 11},
          {5, 6, 11, 12},  {5, 9, 10, 11},  {5, 11, 12, 14}, {6, 7, 9, 13},    {6, 7, 10, 14},   {6, 7, 13, 14},
          {6, 8, 13, 14},  {7, 11, 13, 14}, {8, 9, 10, 11},  {8, 9, 10, 15},   {8, 9, 14, 15},   {8, 10, 13, 15},
          {8, 13, 14, 15}, {9, 10, 12, 15}, {9, 12, 14, 15}, {10, 12, 13, 15}, {11, 12, 13, 14}, {12, 13, 14, 15}};
}

SimplexList lens_space(int p, int q) {
  if (p < 1 || std::gcd(p, q) != 1)
    throw InputError(text("L(", p, ", ", q, ") is no lens space; p must be positive and prime to q"));
  detail::checked_count("simplices", {27 * 8, p, p});  // of the join subdivided: 24 (3p)^2
  const auto size = static_cast<Index>(3 * p);
  const auto turn = static_cast<Index>(3 * (((q % p) + p) % p));
  const SimplexList S3 = join(cycle(size), cycle(size));
  const SimplicialComplex<3> K(S3);

  // The orbits of the simplices of the join: the lowest barycentre of an orbit stands for it, then they are renumbered.
  std::vector<Index> image;
  Index orbits = 0, first = 0;
  for (int k = 0; k <= 3; ++k) {
    for (Index i = 0; i < K.size(k); ++i) {
      std::vector<Index> moved(K.simplex(k, i).begin(), K.simplex(k, i).end());
      Index lowest = i;
      for (int power = 1; power < p; ++power) {
        for (Index& v : moved) v = v < size ? (v + 3) % size : size + (v - size + turn) % size;
        lowest = std::min(lowest, K.find(moved).index);
      }
      image.push_back(lowest == i ? orbits++ : image[static_cast<std::size_t>(first + lowest)]);
    }
    first += K.size(k);
  }

  // Three edges of the first polygon times all of the second are a fundamental domain.
  const SimplexList fine = barycentric_subdivision(S3);
  const auto domain = fine.vertices().first(fine.vertices().size() / static_cast<std::size_t>(p));
  return quotient(SimplexList(3, std::vector<Index>(domain.begin(), domain.end())), image);
}

SimplexList grid_torus(int n, Index cells) { return periodic_box(n, cells).simplices; }

}  // namespace derham::meshes
