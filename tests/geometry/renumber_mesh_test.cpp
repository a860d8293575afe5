#include "derham/geometry/renumber_mesh.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/volumes.hpp"
#include "derham/meshes/boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace derham {
namespace {

std::size_t at(Offset i) { return static_cast<std::size_t>(i); }

/// Points of a grid of size^m cells, shuffled, without simplices but one.
MeshData grid_points(int m, int size, unsigned seed) {
  MeshData mesh;
  mesh.ambient_dimension = m;
  mesh.vertex_count = static_cast<Index>(std::pow(size, m));
  std::vector<int> order(at(mesh.vertex_count));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  for (int cell : order)
    for (int a = 0; a < m; ++a, cell /= size) mesh.points.push_back(cell % size);
  mesh.simplices = SimplexList{{0, 1}};
  return mesh;
}

/// What makes the curve a Hilbert curve: it visits every cell, each next to the one before.
TEST(HilbertOrder, GoesFromCellToNeighbouringCell) {
  for (const int m : {1, 2, 3, 4}) {
    for (const int size : {2, 4, 8}) {
      SCOPED_TRACE(testing::Message() << "m = " << m << ", size " << size);
      MeshData mesh = grid_points(m, size, 7);
      renumber(mesh, hilbert_order(mesh));
      for (std::size_t v = 1; v < at(mesh.vertex_count); ++v) {
        double distance = 0;
        for (std::size_t a = 0; a < at(m); ++a)
          distance += std::abs(mesh.points[v * at(m) + a] - mesh.points[(v - 1) * at(m) + a]);
        ASSERT_EQ(distance, 1) << "vertex " << v;
      }
    }
  }
}

TEST(HilbertOrder, PlacesThatAreEqualOrNoNumbersDoNoHarm) {
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2}, {1, 2, 3}};
  mesh.vertex_count = 4;
  mesh.ambient_dimension = 2;
  mesh.points.assign(8, 3.5);
  EXPECT_EQ(hilbert_order(mesh).new_vertex, (std::vector<Index>{0, 1, 2, 3}));
  mesh.points[2] = std::nan("");
  mesh.points[5] = HUGE_VAL;
  auto order = hilbert_order(mesh).new_vertex;
  std::ranges::sort(order);
  EXPECT_EQ(order, (std::vector<Index>{0, 1, 2, 3}));
}

TEST(HilbertOrder, NeedsPositionsAndVerticesThatExist) {
  MeshData mesh;
  mesh.simplices = SimplexList{{0, 1, 2}};
  mesh.vertex_count = 3;
  EXPECT_THROW((void)hilbert_order(mesh), InputError);
  mesh.ambient_dimension = 2;
  mesh.points.assign(4, 0);
  mesh.vertex_count = 2;
  EXPECT_THROW((void)hilbert_order(mesh), InputError);
}

/// The vertex of another order in which nothing is near: i -> 7i mod the number of vertices.
Renumbering scattered(const MeshData& mesh) {
  std::vector<Index> new_vertex(at(mesh.vertex_count));
  for (Index v = 0; v < mesh.vertex_count; ++v) new_vertex[at(v)] = (7 * v + 3) % mesh.vertex_count;
  return with_rows_in_order(std::move(new_vertex), mesh.simplices);
}

double linear(std::span<const double> p) { return 3 * p[0] - 2 * p[1] + 5; }

/// A square in which every value can be told from positions alone.
MeshData square_with_everything() {
  MeshData mesh = meshes::box(2, 5);
  const SimplicialComplex<2> K(mesh.simplices);
  const auto point = [&](Index v) { return std::span(mesh.points).subspan(2 * at(v), 2); };
  const auto middle = [&](std::span<const Index> simplex) {
    double sum = 0;
    for (const Index v : simplex) sum += linear(point(v));
    return sum / static_cast<double>(simplex.size());
  };
  MeshField on_vertices{"vertices", MeshField::On::vertices, 1, {}}, on_rows{"rows", MeshField::On::rows, 1, {}};
  MeshForm function{"function", 0, false, {}}, gradient{"gradient", 1, false, {}}, area{"area", 2, false, {}};
  MeshForm dual_function{"dual function", 0, true, {}}, flux{"flux", 1, true, {}};
  MeshPart left{"left", 1, 0, {}}, low_rows{"low", 2, 2, {}};
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    on_vertices.values.push_back(linear(point(v)));
    if (point(v)[0] == 0) left.members.push_back(v);
  }
  for (Index t = 0; t < K.size(2); ++t) {
    on_rows.values.push_back(middle(mesh.simplices[t]));
    dual_function.values.push_back(middle(K.simplex(2, t)));
    area.values.push_back(1.0 / 50);
    if (middle(K.simplex(2, t)) < 5) low_rows.members.push_back(t);
  }
  for (Index e = 0; e < K.size(1); ++e) {
    const auto edge = K.simplex(1, e);
    gradient.values.push_back(linear(point(edge[1])) - linear(point(edge[0])));
    mesh.edge_lengths_squared.push_back(
        std::hypot(point(edge[1])[0] - point(edge[0])[0], point(edge[1])[1] - point(edge[0])[1]));
  }
  flux.values = gradient.values;
  function.values = on_vertices.values;
  mesh.fields = {on_vertices, on_rows};
  mesh.forms = {function, gradient, area, dual_function, flux};
  mesh.parts = {left, low_rows, {"bottom", 3, 1, {0}}};
  mesh.lower = {SimplexList{{0}}, SimplexList{{1, 0}}};
  return mesh;
}

TEST(RenumberMesh, EverythingGoesWithItsVertexAndRow) {
  const MeshData original = square_with_everything();
  MeshData mesh = original;
  renumber(mesh, scattered(mesh));
  ASSERT_NE(mesh.simplices, original.simplices);
  const auto point = [&](Index v) { return std::span(mesh.points).subspan(2 * at(v), 2); };
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    EXPECT_EQ(mesh.fields[0].values[at(v)], linear(point(v)));
    EXPECT_EQ(mesh.forms[0].values[at(v)], linear(point(v)));
    EXPECT_EQ(std::ranges::binary_search(mesh.parts[0].members, v), point(v)[0] == 0);
    EXPECT_TRUE(std::ranges::equal(point(v), std::span(original.points).subspan(2 * at(mesh.vertex_tags[at(v)]), 2)));
  }
  SimplicialComplex<2> K(mesh.simplices, mesh.vertex_count);
  orient_by_volume(K, Geometry<2>::from_mesh(K, mesh));
  for (Index t = 0; t < K.size(2); ++t) {
    double sum = 0;
    for (const Index v : mesh.simplices[t]) sum += linear(point(v));
    EXPECT_NEAR(mesh.fields[1].values[at(t)], sum / 3, 1e-13);
    EXPECT_NEAR(mesh.forms[3].values[at(t)], sum / 3, 1e-13);
    EXPECT_EQ(mesh.forms[2].values[at(t)], 1.0 / 50);
    EXPECT_EQ(std::ranges::binary_search(mesh.parts[1].members, t), mesh.fields[1].values[at(t)] < 5);
    const auto old = original.simplices[mesh.row_tags[at(t)]];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(mesh.vertex_tags[at(mesh.simplices[t][i])], old[i]);
  }
  for (Index e = 0; e < K.size(1); ++e) {
    const auto a = point(K.simplex(1, e)[0]), b = point(K.simplex(1, e)[1]);
    EXPECT_NEAR(mesh.forms[1].values[at(e)], linear(b) - linear(a), 1e-13);
    EXPECT_EQ(mesh.forms[4].values[at(e)], mesh.forms[1].values[at(e)]);
    EXPECT_NEAR(mesh.edge_lengths_squared[at(e)], std::hypot(b[0] - a[0], b[1] - a[1]), 1e-13);
  }
  EXPECT_EQ(mesh.parts[2].members, (std::vector<Index>{0}));
  EXPECT_EQ(mesh.vertex_tags[at(mesh.lower[0][0][0])], 0);
  EXPECT_EQ(mesh.vertex_tags[at(mesh.lower[1][0][0])], 1);
}

/// The tags lead back.
TEST(RenumberMesh, RoundTrip) {
  const MeshData original = square_with_everything();
  MeshData mesh = original;
  renumber(mesh, scattered(mesh));
  Renumbering back;
  back.new_vertex.assign(mesh.vertex_tags.begin(), mesh.vertex_tags.end());
  back.old_row.resize(mesh.row_tags.size());
  for (std::size_t row = 0; row < mesh.row_tags.size(); ++row)
    back.old_row[at(mesh.row_tags[row])] = static_cast<Index>(row);
  renumber(mesh, back);
  EXPECT_EQ(mesh.simplices, original.simplices);
  EXPECT_EQ(mesh.points, original.points);
  EXPECT_EQ(mesh.fields, original.fields);
  EXPECT_EQ(mesh.forms, original.forms);
  EXPECT_EQ(mesh.parts, original.parts);
  EXPECT_EQ(mesh.lower, original.lower);
  EXPECT_EQ(mesh.edge_lengths_squared, original.edge_lengths_squared);
}

TEST(RenumberMesh, CornersGoWithTheirRow) {
  const MeshData original = meshes::periodic_box(3, 4);
  MeshData mesh = original;
  renumber(mesh, hilbert_order(mesh));
  EXPECT_LT(vertex_gaps(mesh.simplices).mean, 64);
  for (Offset row = 0; row < mesh.simplices.size(); ++row)
    EXPECT_TRUE(std::ranges::equal(std::span(mesh.corners).subspan(12 * at(row), 12),
                                   std::span(original.corners).subspan(12 * at(mesh.row_tags[at(row)]), 12)));
}

TEST(RenumberMesh, TagsOfTheSourceAreKept) {
  MeshData mesh = meshes::box(2, 1);
  mesh.vertex_tags = {11, 12, 13, 14};
  mesh.row_tags = {5, 6};
  renumber(mesh, {{3, 2, 1, 0}, {1, 0}});
  EXPECT_EQ(mesh.vertex_tags, (std::vector<std::int64_t>{14, 13, 12, 11}));
  EXPECT_EQ(mesh.row_tags, (std::vector<std::int64_t>{6, 5}));
}

TEST(RenumberMesh, RefusesTheRenumberingOfAnotherMesh) {
  MeshData mesh = meshes::box(2, 1);
  EXPECT_THROW(renumber(mesh, {{0, 1, 2}, {0, 1}}), InputError);
  EXPECT_THROW(renumber(mesh, {{0, 1, 2, 3}, {0}}), InputError);
}

/// A shuffled mesh is as good as one in the order of its generator.
TEST(RenumberMesh, BringsNeighboursTogether) {
  const MeshData box = meshes::box(3, 12);
  MeshData mesh = box;
  renumber(mesh, scattered(mesh));
  const int threads = thread_count();
  for (const int count : {1, 2, 4}) {
    set_thread_count(count);
    MeshData copy = mesh;
    renumber(copy, hilbert_order(copy));
    EXPECT_LT(vertex_gaps(copy.simplices).mean, 1.5 * vertex_gaps(box.simplices).mean);
    MeshData other = mesh;
    renumber(other, hilbert_order(other));
    EXPECT_EQ(copy.simplices, other.simplices);
  }
  set_thread_count(threads);
}

}  // namespace
}  // namespace derham
