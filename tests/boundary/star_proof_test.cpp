// The quick proof against the judgement of every link, on manifolds and on complexes that fail to be one in every way.
#include "derham/boundary/star_proof.hpp"

#include "derham/boundary/manifold.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/boxes.hpp"
#include "derham/meshes/classics.hpp"
#include "derham/meshes/constructions.hpp"
#include "derham/meshes/polytopes.hpp"
#include "derham/meshes/voxels.hpp"
#include "reference/reference_complex.hpp"
#include "support/random_rows.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace derham {
namespace {

using support::Random;
using support::Rows;

SimplexList shuffled(const SimplexList& rows, unsigned seed) {
  Random random(seed);
  return support::simplex_list(support::shuffled(reference::tuples(rows), random));
}

/// Whether K is a manifold by every link; the quick proof and both reports agree on it.
template <int n>
bool expect_agreement(const SimplexList& rows) {
  const SimplicialComplex<n> K(rows);
  const ManifoldReport expected = detail::check_every_link(K), report = check_manifold(K);
  const detail::StarProof proof = detail::prove_by_stars(K);
  const bool is_manifold = expected.verdict == Verdict::yes;
  EXPECT_EQ(proof.is_manifold, is_manifold);
  EXPECT_EQ(proof.closed, is_manifold && expected.closed);
  EXPECT_EQ(report.verdict, expected.verdict);
  EXPECT_EQ(report.pure, expected.pure);
  EXPECT_EQ(report.closed, expected.closed);
  EXPECT_EQ(report.orientable, expected.orientable);
  EXPECT_EQ(report.defects.size(), expected.defects.size());
  for (std::size_t i = 0; i < std::min(report.defects.size(), expected.defects.size()); ++i) {
    EXPECT_EQ(report.defects[i].kind, expected.defects[i].kind);
    EXPECT_EQ(report.defects[i].simplex, expected.defects[i].simplex);
    EXPECT_EQ(report.defects[i].detail, expected.defects[i].detail);
  }
  return is_manifold;
}

template <int n>
void expect_verdict(bool is_manifold, const SimplexList& rows) {
  EXPECT_EQ(expect_agreement<n>(rows), is_manifold);
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_EQ(expect_agreement<n>(shuffled(rows, seed)), is_manifold);
  }
}

TEST(StarProof, ProvesManifolds) {
  using namespace meshes;
  expect_verdict<2>(true, box(2, 7).simplices);
  expect_verdict<2>(true, csaszar_torus());
  expect_verdict<2>(true, klein_bottle());
  expect_verdict<2>(true, disjoint_union(moebius_strip(), projective_plane()));
  expect_verdict<3>(true, box(3, 5).simplices);
  expect_verdict<3>(true, grid_torus(3));
  expect_verdict<3>(true, sphere(3));
  expect_verdict<3>(true, cell_600().simplices);
  expect_verdict<3>(true, lens_space(3, 1));
  expect_verdict<3>(true, poincare_sphere());
  expect_verdict<3>(true, product(klein_bottle(), path(2)));
  expect_verdict<3>(true, disjoint_union(sphere(3), box(3, 2).simplices));
  expect_verdict<3>(true, voxels("5x5x3-1:3,1:3,1+2,2,1").simplices);
  expect_verdict<3>(true, {{0, 1, 2, 3}});
  expect_verdict<2>(true, {});
  expect_verdict<3>(true, {});
}

TEST(StarProof, RefusesWhatIsNoManifold) {
  using namespace meshes;
  expect_verdict<2>(false, {{0, 1, 2}, {0, 3, 4}});
  expect_verdict<2>(false, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  expect_verdict<2>(false, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}});
  expect_verdict<2>(false, {{0, 1, 2}, {2, 3}});
  expect_verdict<3>(false, {{0, 1, 2, 3}, {0, 1, 4, 5}});
  expect_verdict<3>(false, {{0, 1, 2, 3}, {0, 4, 5, 6}});
  expect_verdict<3>(false, {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}});
  expect_verdict<3>(false, {{0, 1, 2, 3}, {3, 4, 5}});
  expect_verdict<3>(false, cone(csaszar_torus()));
  expect_verdict<3>(false, cone(annulus()));
  expect_verdict<3>(false, cone(moebius_strip()));
  expect_verdict<3>(false, suspension(projective_plane()));
  expect_verdict<3>(false, suspension(klein_bottle()));
  // Euler characteristic 2, or 1 with a boundary, but in two parts.
  expect_verdict<3>(false, cone(disjoint_union(sphere(2), csaszar_torus())));
  expect_verdict<3>(false, cone(disjoint_union(projective_plane(), projective_plane())));
  expect_verdict<3>(false, cone(disjoint_union(SimplexList{{0, 1, 2}}, csaszar_torus())));
  expect_verdict<3>(false, voxels("2x2x1-0,0,0-1,1,0").simplices);
}

/// Rows with some vertices identified; rows that become degenerate or equal are left out.
Rows pinched(Rows rows, int identifications, Random& random) {
  Index vertices = 0;
  for (const auto& row : rows)
    for (const Index v : row) vertices = std::max(vertices, v + 1);
  for (int i = 0; i < identifications; ++i) {
    const Index from = support::uniform(random, 0, static_cast<int>(vertices) - 1),
                to = support::uniform(random, 0, static_cast<int>(vertices) - 1);
    for (auto& row : rows) std::ranges::replace(row, from, to);
  }
  std::erase_if(rows, [](const auto& row) { return std::set(row.begin(), row.end()).size() < row.size(); });
  return support::shuffled(rows, random);
}

/// Rows without some of them.
Rows thinned(Rows rows, int removed, Random& random) {
  for (int i = 0; i < removed && rows.size() > 1; ++i)
    rows.erase(rows.begin() + support::uniform(random, 0, static_cast<int>(rows.size()) - 1));
  return support::shuffled(rows, random);
}

/// Pinching two vertices of a surface gives a link of two circles; of a solid, two spheres or discs in one link; closer
/// vertices make pinched spheres and worse. Removing tets gives edges with several rings.
template <int n>
void expect_agreement_on_damaged(const SimplexList& rows, int rounds) {
  int manifolds = 0;
  for (int round = 0; round < rounds; ++round) {
    SCOPED_TRACE(testing::Message() << "n = " << n << ", round " << round);
    Random random(static_cast<unsigned>(round));
    const Rows damaged = round % 2 == 0 ? pinched(reference::tuples(rows), support::uniform(random, 1, 2), random)
                                        : thinned(reference::tuples(rows), support::uniform(random, 1, 6), random);
    if (!damaged.empty()) manifolds += expect_agreement<n>(support::simplex_list(damaged)) ? 1 : 0;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_LT(manifolds, rounds);
}

TEST(StarProof, AgreesWithEveryLinkOnDamagedManifolds) {
  using namespace meshes;
  expect_agreement_on_damaged<2>(box(2, 4).simplices, 200);
  expect_agreement_on_damaged<2>(csaszar_torus(), 100);
  expect_agreement_on_damaged<3>(box(3, 2).simplices, 300);
  expect_agreement_on_damaged<3>(grid_torus(3), 60);
  expect_agreement_on_damaged<3>(sphere(3), 60);
  expect_agreement_on_damaged<3>(product(projective_plane(), path(1)), 100);
  expect_agreement_on_damaged<3>(suspension(csaszar_torus()), 60);
}

/// The suspension of a surface whose vertices are identified: links that are pinched spheres, two points of which are one.
TEST(StarProof, AgreesWithEveryLinkOnSuspensionsOfPinchedSurfaces) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Rows surface = reference::tuples(seed % 2 == 0 ? meshes::box(2, 4).simplices
                                                   : meshes::disjoint_union(meshes::sphere(2), meshes::sphere(2)));
    surface = pinched(surface, support::uniform(random, 0, 2), random);
    const SimplexList base = support::simplex_list(surface);
    expect_agreement<3>(shuffled(meshes::suspension(base), seed));
    expect_agreement<3>(shuffled(meshes::cone(base), seed));
    if (HasFailure()) return;
  }
}

TEST(StarProof, AgreesWithEveryLinkOnRandomComplexes) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expect_agreement<2>(support::simplex_list(support::random_pure(2, random)));
    expect_agreement<2>(support::simplex_list(support::random_mixed(2, random)));
    expect_agreement<3>(support::simplex_list(support::random_pure(3, random)));
    expect_agreement<3>(support::simplex_list(support::random_components(3, 2, random)));
    expect_agreement<3>(support::simplex_list(support::random_rips(3, random)));
    if (HasFailure()) return;
  }
}

/// In a shuffled star of many simplices more trees begin than a vertex has digits for.
TEST(StarProof, StarsOfManyTrees) {
  const Index size = 500;
  SimplexList fan, cut, wheel, two_wheels;
  for (Index i = 0; i < size; ++i) {
    const Index next = (i + 1) % size;
    fan.push_back({0, 1, 2 + i, 2 + next});
    if (i != 100 && i != 300) cut.push_back({0, 1, 2 + i, 2 + next});
    wheel.push_back({0, 1 + i, 1 + next});
    two_wheels.push_back({0, 1 + i, 1 + next});
    two_wheels.push_back({0, 1 + size + i, 1 + size + next});
  }
  expect_verdict<3>(true, fan);
  expect_verdict<3>(false, cut);  // two rings about an edge
  expect_verdict<2>(true, wheel);
  expect_verdict<2>(false, two_wheels);
  expect_verdict<3>(true, meshes::cone(meshes::box(2, 20).simplices));
  expect_verdict<3>(false, meshes::cone(meshes::grid_torus(2)));
}

}  // namespace
}  // namespace derham
