#pragma once

#include "derham/geometry/mesh_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace derham::io_test {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

/// Expects a field; NaN is expected where `values` has it.
inline void expect_field(const MeshField& field, const std::string& name, MeshField::On on, int components,
                         const std::vector<double>& values) {
  EXPECT_EQ(field.name, name);
  EXPECT_EQ(field.on, on);
  EXPECT_EQ(field.components, components);
  ASSERT_EQ(field.values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i])) {
      EXPECT_TRUE(std::isnan(field.values[i])) << name << i;
    } else {
      EXPECT_EQ(field.values[i], values[i]) << name << i;
    }
}

}  // namespace derham::io_test
