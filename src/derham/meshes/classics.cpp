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
