// What a stranger's first program looks like; built three ways against derham, never inside its own build. It needs
// the thread backend, the exact arithmetic behind orientation signs, and Eigen.
#include <derham/boundary/eigen.hpp>
#include <derham/hodge/hodge_star.hpp>
#include <derham/meshes/example.hpp>

#include <iostream>

int main() {
  const derham::MeshData mesh = derham::meshes::example();
  derham::SimplicialComplex<3> K(mesh.simplices);
  const auto geometry = derham::Geometry<3>::from_mesh(K, mesh);
  derham::orient_by_volume(K, geometry);
  for (int k = 0; k <= 3; ++k) std::cout << K.size(k) << ' ';
  std::cout << "chi " << K.euler_characteristic() << '\n';

  const auto d2 = derham::to_eigen(derham::coboundary_matrix(K, 2));
  const auto d1 = derham::to_eigen(derham::coboundary_matrix(K, 1));
  std::cout << "dd " << (d2 * d1).norm() << '\n';

  const derham::HodgeStar<3> star(K, geometry);
  double volume = 0;
  for (const double value : star.diagonal(0)) volume += value;
  std::cout << "volume " << volume << '\n';
}
