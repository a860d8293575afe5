#include "derham/geometry/geometry.hpp"

#include "derham/core/error.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"
#include "geometry/mesh_kit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace derham {
namespace {

const SimplicialComplex<2>& two_triangles() {
  static const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {1, 2, 3}});
  return K;
}

template <class Exception, class Call>
std::string message(Call&& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing of the expected type was thrown";
  return "";
}

bool mentions(const std::string& whole, const std::string& part) { return whole.find(part) != std::string::npos; }

TEST(Geometry, CornersFollowTheRepresentative) {
  const SimplicialComplex<2> K(SimplexList{{2, 0, 1}});
  const auto g = Geometry<2>::from_points(K, {0, 0, 1, 0, 0, 1}, 2);
  const auto corners = g.corners(K, 0);
  EXPECT_EQ(corners[1][0], 1);
  EXPECT_EQ(corners[2][1], 1);
}

TEST(Geometry, CornersOfAMeshAreBroughtToSortedOrder) {
  MeshData mesh;
  mesh.simplices = SimplexList{{2, 0, 1}};
  mesh.vertex_count = 3;
  mesh.ambient_dimension = 2;
  mesh.corners = {20, 21, 0, 1, 10, 11};
  const SimplicialComplex<2> K(mesh.simplices);
  const auto g = Geometry<2>::from_mesh(K, mesh);
  for (int v = 0; v < 3; ++v) {
    EXPECT_EQ(g.corners(K, 0)[v][0], 10 * v);
    EXPECT_EQ(g.corners(K, 0)[v][1], 10 * v + 1);
  }
  EXPECT_EQ(g.simplex_corners(K, 1, K.at({1, 2}).index), (std::vector<double>{10, 11, 20, 21}));
  EXPECT_EQ(g.simplex_corners(K, 0, 2), (std::vector<double>{20, 21}));
}

TEST(Geometry, FitsTheComplexItWasMadeForOnly) {
  const MeshData mesh = meshes::box(2, 3, {.jitter = 0.2});
  const SimplicialComplex<2> K(mesh.simplices), copy(mesh.simplices);
  const auto g = Geometry<2>::from_mesh(K, mesh);
  g.require_fits(copy);
  std::vector<Index> turned(mesh.simplices.vertices().begin(), mesh.simplices.vertices().end());
  for (Index& v : turned) v = mesh.vertex_count - 1 - v;
  EXPECT_TRUE(mentions(message<InputError>([&] { g.require_fits(SimplicialComplex<2>(SimplexList(2, turned))); }),
                       "other simplices"));
  // As many vertices and triangles, another number of edges.
  const SimplicialComplex<2> fan(SimplexList{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}),
      pair(SimplexList{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}});
  ASSERT_EQ(fan.size(0), pair.size(0));
  ASSERT_EQ(fan.size(2), pair.size(2));
  const auto points = Geometry<2>::from_points(fan, std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1, -1, 1, -1, 0}, 2);
  EXPECT_THROW(points.require_fits(pair), InputError);
}

// The surface of a regular tetrahedron, every triangle in a chart of its own, turned by `turn` more than the one before.
Geometry<2> tetrahedron_in_charts(const SimplicialComplex<2>& K, double turn) {
  std::vector<double> corners;
  for (int t = 0; t < 4; ++t)
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, std::pair{1.0, 0.0}, std::pair{0.5, std::sqrt(3) / 2}}) {
      corners.push_back(std::cos(turn * t) * x - std::sin(turn * t) * y);
      corners.push_back(std::sin(turn * t) * x + std::cos(turn * t) * y);
    }
  return Geometry<2>::from_corners(K, corners, 2);
}

TEST(Geometry, KnowsWhetherVectorsOfDifferentSimplicesCompare) {
  const MeshData mesh = meshes::periodic_box(2, 3);
  const SimplicialComplex<2> torus(mesh.simplices);
  const auto g = Geometry<2>::from_mesh(torus, mesh);
  EXPECT_EQ(g.source(), MetricSource::corners);
  EXPECT_TRUE(g.has_common_frame());
  EXPECT_FALSE(Geometry<2>::from_squared_lengths(torus, squared_lengths(torus, g)).has_common_frame());
  EXPECT_TRUE(Geometry<2>::from_points(two_triangles(), {0, 0, 1, 0, 0, 1, 1, 1}, 2).has_common_frame());
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}});
  EXPECT_FALSE(tetrahedron_in_charts(K, 0).has_common_frame());
  EXPECT_FALSE(tetrahedron_in_charts(K, 1).has_common_frame());
}

TEST(Geometry, RefusesWhatIsNotFiniteAndNamesTheVertex) {
  const auto& K = two_triangles();
  std::vector<double> points{0, 0, 1, 0, 0, 1, 1, 1};
  points[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_PRED2(mentions, message<GeometryError>([&] { (void)Geometry<2>::from_points(K, points, 2); }),
               "coordinate 1 of vertex 2 is nan");
  points[5] = -std::numeric_limits<double>::infinity();
  EXPECT_PRED2(mentions, message<GeometryError>([&] { (void)Geometry<2>::from_points(K, points, 2); }),
               "vertex 2 is -inf");
  std::vector<double> corners(12, 0.0);
  corners[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_PRED2(mentions, message<GeometryError>([&] { (void)Geometry<2>::from_corners(K, corners, 2); }),
               "vertex 2 as a corner of 2-simplex 1");
}

TEST(Geometry, RefusesWrongShapes) {
  const auto& K = two_triangles();
  EXPECT_THROW((void)Geometry<2>::from_points(K, std::vector<double>(7), 2), InputError);
  EXPECT_THROW((void)Geometry<2>::from_points(K, std::vector<double>(4), 1), InputError);
  EXPECT_THROW((void)Geometry<2>::from_corners(K, std::vector<double>(11), 2), InputError);
  EXPECT_THROW((void)Geometry<2>::from_squared_lengths(K, std::vector<double>(4, 1.0)), InputError);
  const SimplicialComplex<2> other(SimplexList{{0, 1, 2}});
  const auto g = Geometry<2>::from_points(other, std::vector<double>(6), 2);
  EXPECT_THROW(g.require_fits(K), InputError);
  MeshData abstract;
  abstract.simplices = SimplexList{{0, 1, 2}};
  abstract.vertex_count = 3;
  EXPECT_THROW((void)Geometry<2>::from_mesh(other, abstract), GeometryError);
}

TEST(Geometry, DemandsPurity) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}, {2, 3}});
  EXPECT_PRED2(mentions, message<TopologyError>([&] { (void)Geometry<2>::from_points(K, std::vector<double>(8), 2); }),
               "(2, 3)");
}

TEST(Geometry, CornersMustAgreeOnSharedEdges) {
  // Edge (1,2) has squared length 2 in the first triangle, 5 in the second.
  const std::vector<double> corners{0, 0, 1, 0, 0, 1, 0, 0, 2, 1, 0, 1};
  EXPECT_PRED2(mentions, message<GeometryError>([&] { (void)Geometry<2>::from_corners(two_triangles(), corners, 2); }),
               "(1, 2)");
  const MeshData torus = meshes::periodic_box(3, 3);
  const SimplicialComplex<3> K(torus.simplices);
  EXPECT_NO_THROW((void)Geometry<3>::from_mesh(K, torus));
}

TEST(Geometry, LengthsGiveASimplexWithTheseLengths) {
  const SimplicialComplex<3> K(SimplexList{{0, 1, 2, 3}});
  const std::vector<double> squares{1, 2, 1.5, 1.25, 1.75, 2.25};
  const auto g = Geometry<3>::from_squared_lengths(K, squares);
  EXPECT_EQ(g.ambient_dimension(), 0);
  EXPECT_FALSE(g.has_signed_volume());
  const auto p = g.corners(K, 0);
  for (Index e = 0; e < 6; ++e) {
    const auto v = K.simplex(1, e);
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::pow(p[v[0]][c] - p[v[1]][c], 2);
    EXPECT_NEAR(sum, squares[e], 1e-14);
  }
}

TEST(Geometry, LengthsMustSatisfyTheSimplexInequality) {
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  const auto lengths = [&](std::vector<double> squares) { (void)Geometry<2>::from_squared_lengths(K, squares); };
  EXPECT_PRED2(mentions, message<GeometryError>([&] { lengths({1, 1, 5}); }), "2-simplex 0 = (0, 1, 2)");
  EXPECT_PRED2(mentions, message<GeometryError>([&] { lengths({1, -1, 1}); }), "edge 1 = (0, 2)");
  EXPECT_NO_THROW(lengths({1, 1, 4}));  // flat
}

TEST(Geometry, PointsAndEmptyComplex) {
  const SimplicialComplex<0> points(SimplexList{{0}, {1}});
  EXPECT_EQ(Geometry<0>::from_points(points, {1, 2, 3, 4}, 2).corners(points, 1)[0][1], 4);
  const SimplicialComplex<3> empty;
  EXPECT_NO_THROW((void)Geometry<3>::from_points(empty, {}, 3));
}

// Cells of 0.25 and coordinates of 1e6: the coordinates' own rounding is 1e-9 of the squared lengths.
TEST(Geometry, CornersFarFromTheOriginMayDifferByTheirRounding) {
  const MeshData mesh = test::moved(meshes::periodic_box(2, 4), 2, 0.25, 1e6, 1);
  const SimplicialComplex<2> K(mesh.simplices);
  EXPECT_NO_THROW((void)Geometry<2>::from_mesh(K, mesh));
  MeshData wrong = mesh;
  wrong.corners[0] += 1e-4;
  const auto what = message<GeometryError>([&] { (void)Geometry<2>::from_mesh(K, wrong); });
  const auto digits = what.find("squared length 0.") + std::string("squared length 0.").size();
  EXPECT_GE(what.find_first_not_of("0123456789", digits) - digits, 15u) << what;
}

}  // namespace
}  // namespace derham
