#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace derham::io_test {

/// Expects the mesh that all samples of VTK's formats hold, without its fields.
inline void expect_two_tetrahedra(const MeshData& mesh) {
  EXPECT_EQ(mesh.simplices, (SimplexList{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.vertex_count, 5);
  EXPECT_EQ(mesh.ambient_dimension, 3);
  EXPECT_EQ(mesh.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  ASSERT_EQ(mesh.lower.size(), 3u);
  EXPECT_EQ(mesh.lower[2], (SimplexList{{0, 1, 2}}));
  EXPECT_EQ(mesh.lower_count(), 1);
  EXPECT_TRUE(mesh.parts.empty());
}

}  // namespace derham::io_test
