#include "derham/core/error.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/voxels.hpp"
#include "support/mesh_measures.hpp"

#include <gtest/gtest.h>

#include <string>

namespace derham {
namespace {

struct Domain {
  const char* spec;
  std::vector<Offset> f;
  Offset chi;
};

TEST(Voxels, DomainsWithTunnelsAndVoidsHaveTheKnownCounts) {
  for (const Domain& domain :
       {Domain{"2x2x2", {27, 98, 120, 48}, 1}, Domain{"3x3x1-1,1,0", {32, 112, 128, 48}, 0},
        Domain{"3x3x3-1,1,1", {64, 278, 372, 156}, 2}, Domain{"5x5x3-1:3,1:3,1+2,2,1", {144, 687, 946, 402}, 1},
        Domain{"5x3x1-1,1,0-3,1,0", {48, 177, 206, 78}, -1}, Domain{"3x3x5-1,1,1-1,1,3", {96, 441, 606, 258}, 3},
        Domain{"3x7x3-1,1,1-1,5,0:2", {128, 599, 826, 354}, 1}}) {
    const MeshData mesh = meshes::voxels(domain.spec);
    EXPECT_EQ(test::f_vector(mesh.simplices), domain.f) << domain.spec;
    EXPECT_EQ(test::euler_characteristic(mesh.simplices), domain.chi) << domain.spec;
    EXPECT_EQ(test::euler_characteristic(test::boundary_facets(mesh.simplices)), 2 * domain.chi) << domain.spec;
    EXPECT_EQ(mesh.simplices.vertex_bound(), mesh.vertex_count);
    EXPECT_NEAR(test::total_volume(mesh), static_cast<double>(domain.f[3]) / 6, 1e-10);
    EXPECT_GT(test::smallest_volume(mesh), 0);
  }
}

TEST(Voxels, AFullSetIsTheBox) {
  const MeshData mesh = meshes::voxels("3x2x2x1");
  const MeshData box = meshes::box({3, 2, 2, 1}, {.lengths = {3, 2, 2, 1}});
  EXPECT_EQ(mesh.simplices, box.simplices);
  EXPECT_EQ(mesh.points, box.points);
}

TEST(Voxels, TakeAMask) {
  const MeshData mesh = meshes::voxels({.shape = {2, 2}, .filled = {1, 0, 0, 1}});
  EXPECT_EQ(test::f_vector(mesh.simplices), (std::vector<Offset>{7, 10, 4}));
}

TEST(Voxels, RefuseAnythingElse) {
  for (const char* spec :
       {"",        "x",         "3x",        "3x3x", "0x1",      "-1",       "3x3-",          "3x3-1",       "3x3-1,",
        "3x3-1,3", "3x3-2:1,0", "3x3-1,1,1", "3x3 ", "3x3-1,1;", "3x3-1,-1", "1x1x1x1x1x1x1", "99999999999", "2-0:1",
        "+1",      "3x3-1:,1"})
    EXPECT_THROW((void)meshes::voxels(spec), InputError) << spec;
  EXPECT_THROW((void)meshes::voxels({.shape = {2, 2}, .filled = {1}}), InputError);
  EXPECT_THROW((void)meshes::voxels({.shape = {}, .filled = {}}), InputError);
  EXPECT_THROW((void)meshes::voxels({.shape = {-1}, .filled = {}}), InputError);
  EXPECT_THROW((void)meshes::voxels("100000x100000"), LimitError);
  try {
    (void)meshes::parse_voxels("3x3-1,7");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("7 is not inside 0:2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace derham
