#include "derham/operators/tagged_facets.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "operators/sided_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace derham {
namespace {

template <class T>
struct TaggedFacets : testing::Test {};
TYPED_TEST_SUITE(TaggedFacets, test::Dimensions);

template <class Body>
void expect_message(Body&& body, const std::string& part) {
  try {
    body();
    ADD_FAILURE() << "nothing thrown; expected " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TYPED_TEST(TaggedFacets, OfAllSidesAreTheBoundary) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = test::with_sides<n>(test::random_mesh<n>(1, 2));
  const SimplicialComplex<n> K(mesh.simplices);
  std::vector<Index> all;
  for (const MeshPart& part : mesh.parts) {
    const auto facets = tagged_facets(K, mesh, part);
    EXPECT_TRUE(std::ranges::is_sorted(facets));
    all.insert(all.end(), facets.begin(), facets.end());
  }
  std::ranges::sort(all);
  const FacetCofaces cofaces = facet_cofaces(K);
  std::vector<Index> boundary;
  for (Index f = 0; f < K.size(n - 1); ++f)
    if (cofaces.count[static_cast<std::size_t>(f)] == 1) boundary.push_back(f);
  EXPECT_EQ(all, boundary);

  auto two = tagged_facets(K, mesh, {"0-", "0+"});
  EXPECT_EQ(two, tagged_facets(K, mesh, {"0+", "0-", "0+"})) << "each once";
  EXPECT_EQ(tagged_facets(K, mesh, {}), std::vector<Index>());
}

TEST(TaggedFacet, CountsOnceHoweverItIsListed) {
  MeshData mesh = meshes::box(2, 1);
  mesh.lower.resize(2);
  mesh.lower[1] = SimplexList{{0, 1}, {1, 0}};
  mesh.parts = {{"wall", 1, 1, {0, 1}}};
  const SimplicialComplex<2> K(mesh.simplices);
  EXPECT_EQ(tagged_facets(K, mesh, {"wall"}), std::vector<Index>{K.at({0, 1}).index});
}

TEST(TaggedFacetErrors, AreNamed) {
  MeshData mesh = meshes::box(2, 1);
  mesh.lower.resize(2);
  mesh.lower[1] = SimplexList{{0, 1}, {3, 0}, {1, 2}};
  mesh.parts = {{"wall", 1, 1, {0}}, {"sheet", 2, 1, {0, 1}}, {"all", 3, 2, {0, 1}}, {"nothing", 4, 1, {2}}};
  const SimplicialComplex<2> K(mesh.simplices);
  expect_message([&] { (void)tagged_facets(K, mesh, {"wall", "wal"}); }, "'wall' (1), 'sheet' (2)");
  expect_message([&] { (void)tagged_facets(K, mesh, {"sheet"}); }, "(0, 3), which is not on the boundary but in 2");
  expect_message([&] { (void)tagged_facets(K, mesh, mesh.parts[2]); }, "has degree 2");
  expect_message([&] { (void)tagged_facets(K, mesh, {"nothing"}); }, "is no simplex of the complex");
}

}  // namespace
}  // namespace derham
