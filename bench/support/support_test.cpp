// What benchmarks measure with: meshes in both orders, and yardsticks that do what they say.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/set_and_map.hpp"
#include "bench/support/yardsticks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace derham::bench {
namespace {

using Corners = std::set<std::vector<double>>;

/// The simplices of a mesh as sets of positions.
std::multiset<Corners> simplices_in_space(const MeshData& mesh) {
  std::multiset<Corners> result;
  const auto m = static_cast<std::size_t>(mesh.ambient_dimension);
  for (Offset t = 0; t < mesh.simplices.size(); ++t) {
    Corners corners;
    for (const Index v : mesh.simplices[t]) {
      const auto* const point = mesh.points.data() + static_cast<std::size_t>(v) * m;
      corners.emplace(point, point + m);
    }
    result.insert(corners);
  }
  return result;
}

TEST(BenchMeshes, ShuffledMeshesHaveTheSameSimplicesInAnotherOrder) {
  for (const auto& mesh : {box_of(500), torus_of(500)}) {
    const auto other = shuffled(mesh);
    EXPECT_EQ(simplices_in_space(other), simplices_in_space(mesh));
    EXPECT_NE(other.simplices, mesh.simplices);
    EXPECT_NE(other.points, mesh.points);
    EXPECT_EQ(shuffled(mesh).simplices, other.simplices);
    EXPECT_NE(shuffled(mesh, 2).simplices, other.simplices);
  }
}

TEST(BenchMeshes, SizesAreAboutWhatWasAskedFor) {
  EXPECT_NEAR(static_cast<double>(box_of(1'000'000).simplices.size()), 1e6, 2e4);
  EXPECT_NEAR(static_cast<double>(torus_of(1'300'000).simplices.size()), 1.3e6, 2e4);
}

TEST(Yardsticks, RadixSortSortsTheFacetsStably) {
  const auto mesh = shuffled(box_of(3000));
  KeyList list(mesh), scratch = list;
  ASSERT_EQ(list.keys.size(), 4 * static_cast<std::size_t>(mesh.simplices.size()));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> expected;
  for (std::size_t i = 0; i < list.keys.size(); ++i) expected.emplace_back(list.keys[i], list.payload[i]);
  std::ranges::sort(expected);
  list.sort(scratch);
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_EQ(std::pair(list.keys[i], list.payload[i]), expected[i]) << i;
}

TEST(Yardsticks, KeysThatDoNotFit64BitsAreNotMade) {
  MeshData mesh;
  mesh.simplices = {{0, 1, 2, 3}};
  mesh.vertex_count = 2'000'000;
  EXPECT_FALSE(KeyList(mesh).empty());
  mesh.vertex_count = 3'000'000;
  EXPECT_TRUE(KeyList(mesh).empty());
}

TEST(Yardsticks, SetAndMapBuildsTheComplexOfTheLibrary) {
  const auto mesh = shuffled(box_of(500));
  const SetAndMap<3> slow(mesh.simplices);
  const SimplicialComplex<3> K(mesh.simplices);
  EXPECT_EQ(slow.size<0>(), K.size(0));
  EXPECT_EQ(slow.size<1>(), K.size(1));
  EXPECT_EQ(slow.size<2>(), K.size(2));
  const Sign first = static_cast<Sign>(slow.signs()[0] * K.sign(3, 0));
  for (Index t = 0; t < K.size(3); ++t) {
    for (int i = 0; i <= 3; ++i)
      ASSERT_EQ(slow.top_faces()[static_cast<std::size_t>(t)][static_cast<std::size_t>(i)], K.face_opposite(3, t, i));
    ASSERT_EQ(slow.signs()[static_cast<std::size_t>(t)], first * K.sign(3, t)) << t;
  }
}

TEST(Kernels, RunOnceAfterAWarmUpIfTheirNameMatches) {
  static int runs = 0;
  add("counted", [] { return Kernel{.run = [] { ++runs; }, .items = 7, .bytes = 0, .reset = {}}; });
  std::ostringstream out;
  run_once("nothing", out);
  EXPECT_EQ(runs, 0);
  run_once("^counted", out);
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(out.str(), "counted/-\t7\n");
}

}  // namespace
}  // namespace derham::bench
