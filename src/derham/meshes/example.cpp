#include "derham/meshes/example.hpp"

namespace derham::meshes {

MeshData example() {
  MeshData mesh;
  mesh.simplices = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  mesh.vertex_count = 5;
  mesh.ambient_dimension = 3;
  mesh.points = {3, 3, 0, 3, 0, 3, 0, 3, 3, 0, 0, 0, 4, 4, 4};
  return mesh;
}

}  // namespace derham::meshes
