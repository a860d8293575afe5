// The smallest mesh that shows everything, in the spirit of Figure 4 of Elcott & Schröder, "Building your own DEC at home":
// two tetrahedra glued along a triangle, and all structures that belong to them.
#include <derham/boundary/matrix.hpp>
#include <derham/geometry/geometry.hpp>
#include <derham/geometry/volumes.hpp>
#include <derham/hodge/hodge_star.hpp>
#include <derham/meshes/example.hpp>

#include <cstdio>

using namespace derham;

namespace {

void print_simplices(const SimplicialComplex<3>& K, int k) {
  std::printf("%c: %d simplices of degree %d\n", "VEFT"[k], static_cast<int>(K.size(k)), k);
  for (Index i = 0; i < K.size(k); ++i) {
    std::printf("  %d: %c(", static_cast<int>(i), K.sign(k, i) > 0 ? '+' : '-');
    const char* separator = "";
    for (const Index v : K.simplex(k, i)) {
      std::printf("%s%d", separator, static_cast<int>(v));
      separator = ", ";
    }
    std::printf(")\n");
  }
}

void print_boundary(const SimplicialComplex<3>& K, int k) {
  const SignMatrix m = boundary_matrix(K, k);
  std::printf("boundary %d: a matrix of %d x %d\n", k, static_cast<int>(m.rows), static_cast<int>(m.cols));
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.rows); ++i) {
    std::vector<char> row(static_cast<std::size_t>(m.cols), '.');
    for (auto p = static_cast<std::size_t>(m.offsets[i]); p < static_cast<std::size_t>(m.offsets[i + 1]); ++p)
      row[static_cast<std::size_t>(m.columns[p])] = m.values[p] > 0 ? '+' : '-';
    std::printf(" ");
    for (const char entry : row) std::printf(" %c", entry);
    std::printf("\n");
  }
}

}  // namespace

int main() {
  const MeshData mesh = meshes::example();
  SimplicialComplex<3> K(mesh.simplices);
  const auto geometry = Geometry<3>::from_mesh(K, mesh);
  orient_by_volume(K, geometry);

  for (int k = 0; k <= 3; ++k) print_simplices(K, k);
  for (int k = 1; k <= 3; ++k) print_boundary(K, k);

  const auto volumes = primal_volumes(K, geometry);
  const HodgeStar<3> star(K, geometry);
  for (int k = 0; k <= 3; ++k) {
    std::printf("degree %d: volume, dual volume, star\n", k);
    for (Index i = 0; i < K.size(k); ++i) {
      const double volume = volumes[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      const double ratio = star.diagonal(k)[static_cast<std::size_t>(i)];
      std::printf("  %d: %9.5f %9.5f %9.5f\n", static_cast<int>(i), volume, ratio * volume, ratio);
    }
  }
}
