#include "derham/operators/whitney_mass.hpp"

#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/meshes/tori.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/whitney_map.hpp"
#include "operators/polynomial.hpp"
#include "operators/spaces.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace derham {
namespace {

using test::for_each_degree;
using test::for_each_space;
using test::Space;
using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

template <class T>
struct WhitneyMass : testing::Test {};
TYPED_TEST_SUITE(WhitneyMass, test::Dimensions);

Material random_numbers(Index rows, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.5, 2);
  Material material{.values = {}};
  for (Index i = 0; i < rows; ++i) material.values.push_back(uniform(random));
  return material;
}

/// Positive definite.
Material random_tensors(Index rows, int width, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Material material{.values = {}, .width = width};
  for (Index row = 0; row < rows; ++row) {
    Eigen::MatrixXd root(width, width);
    for (double& x : root.reshaped()) x = normal(random);
    const Eigen::MatrixXd tensor = root * root.transpose() + Eigen::MatrixXd::Identity(width, width);
    material.values.insert(material.values.end(), tensor.data(), tensor.data() + width * width);
  }
  return material;
}

/// All minors of order k.
template <int k>
Eigen::MatrixXd compound(const Eigen::MatrixXd& A) {
  const auto sets = subsets<k>(static_cast<int>(A.rows()));
  const auto size = static_cast<Eigen::Index>(sets.size());
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index p = 0; p < size; ++p)
    for (Eigen::Index q = 0; q < size; ++q) {
      Eigen::MatrixXd minor(k, k);
      for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j)
          minor(i, j) = A(sets[static_cast<std::size_t>(p)][static_cast<std::size_t>(i)],
                          sets[static_cast<std::size_t>(q)][static_cast<std::size_t>(j)]);
      result(p, q) = minor.determinant();
    }
  return result;
}

/// The specification: ∫ ⟨W_σ, A W_τ⟩ by quadrature, simplex by simplex, every form evaluated by the Whitney map.
template <int n, int k>
Eigen::MatrixXd by_quadrature(const Space<n>& space, const Material& material) {
  const int d = space.g.coordinate_dimension();
  const WhitneyMap<n> W(space.K, space.g);
  const auto rule = simplex_rule<n>(2);
  const auto volume = primal_volumes(space.K, space.g)[n];
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(space.K.size(k), space.K.size(k));
  for (Index t = 0; t < space.K.size(n); ++t) {
    const auto index = face_indices(space.K, t);
    std::vector<Index> faces;
    for (unsigned mask = 1; mask <= full_mask<n>; ++mask)
      if (mask_degree(mask) == k) faces.push_back(index[mask]);
    const double* const A = material.of(t);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      Eigen::MatrixXd value(binomial(d, k), static_cast<Eigen::Index>(faces.size()));
      for (std::size_t a = 0; a < faces.size(); ++a) {
        PrimalForm<n, k> basis(space.K);
        basis[faces[a]] = 1;
        auto x = W.at(basis, BarycentricPoint<n>{t, rule.points[q]});
        if (material.width != 0 && 2 * k > n) x = flux_vectors(x, d);
        for (std::size_t c = 0; c < x.size(); ++c)
          value(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(a)) = x[c];
      }
      Eigen::MatrixXd local;
      if (material.width == 0) {
        local = *A * value.transpose() * value;
      } else {
        const Eigen::MatrixXd tensor = Eigen::Map<const Eigen::MatrixXd>(A, d, d);
        local = value.transpose() * (2 * k > n ? tensor : compound<k>(tensor)) * value;
      }
      for (std::size_t a = 0; a < faces.size(); ++a)
        for (std::size_t b = 0; b < faces.size(); ++b)
          M(faces[a], faces[b]) += rule.weights[q] * volume[static_cast<std::size_t>(t)] *
                                   local(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
    }
  }
  return M;
}

void expect_near(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double relative) {
  ASSERT_EQ(a.rows(), b.rows());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), relative * b.cwiseAbs().maxCoeff());
}

TYPED_TEST(WhitneyMass, IsTheIntegralOfProductsOfWhitneyForms) {
  constexpr int n = TypeParam::value;
  const auto expect_agreement = [](const Space<n>& space) {
    for_each_degree<n>([&]<int k>() {
      if (space.K.size(k) > 600) return;
      const auto numbers = random_numbers(space.K.size(n), 1);
      expect_near(whitney_mass(space.K, space.g, k), (by_quadrature<n, k>(space, {})), 1e-12);
      expect_near(whitney_mass(space.K, space.g, k, numbers), (by_quadrature<n, k>(space, numbers)), 1e-12);
      const bool as_flux = k > 1 && space.g.coordinate_dimension() == n;
      if (0 < k && k < n && (2 * k <= n || as_flux)) {
        const auto tensors = random_tensors(space.K.size(n), space.g.coordinate_dimension(), 2);
        expect_near(whitney_mass(space.K, space.g, k, tensors), (by_quadrature<n, k>(space, tensors)), 1e-12);
      }
    });
  };
  if constexpr (n < 4) {
    for_each_space<n>(expect_agreement);
  } else {
    const MeshData mesh = test::random_mesh<n>(1, 1);
    const Space<n> flat(mesh);
    expect_agreement(flat);
    expect_agreement(Space<n>(test::moved(mesh, n + 1, 1, 1, 1)));
    expect_agreement(Space<n>(mesh, squared_lengths(flat.K, flat.g)));
  }
}

// cᵀ M c = ∫ ⟨c, A c⟩, with a boundary, without one, and for pieces of planes in space.
TYPED_TEST(WhitneyMass, HasTheEnergyOfConstantForms) {
  constexpr int n = TypeParam::value;
  std::vector<Index> id;
  const Space<n> box(test::random_mesh<n>(2)),
      torus(test::shuffled(meshes::periodic_box(n, 3, {.jitter = 0.4 / n}), 1, id));
  for (const Space<n>* space : {&box, &torus}) {
    const DeRhamMap<n> R(space->K, space->g, 0);
    for_each_degree<n>([&]<int k>() {
      const auto form = test::random_form<k>(n, 0, 3);
      const auto c = R.template components<k>(form);
      double square = 0;
      for (const double x : form(std::vector<double>(n))) square += x * x;
      const Eigen::Map<const Eigen::VectorXd> values(c.values().data(), c.size());
      EXPECT_NEAR(values.dot(whitney_mass(space->K, space->g, k) * values), square, 1e-12 * (1 + square));
    });
  }
}

TYPED_TEST(WhitneyMass, IsSymmetricBitForBitAndPositiveDefinite) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(3, n < 4 ? 2 : 1));
  for_each_degree<n>([&]<int k>() {
    const Sparse M = whitney_mass(space.K, space.g, k);
    for (Eigen::Index row = 0; row < M.outerSize(); ++row) {
      Eigen::Index before = -1;
      for (Sparse::InnerIterator entry(M, row); entry; ++entry) {
        EXPECT_GT(entry.col(), before);
        before = entry.col();
        EXPECT_EQ(entry.value(), M.coeff(entry.col(), row));
      }
    }
    const Eigen::MatrixXd dense = M;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues()[0], 0);
  });
}

TYPED_TEST(WhitneyMass, IsDiagonalInTheTopDegreeAndSumsToTheLumpedMassOfFunctions) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::moved(test::random_mesh<n>(4), n + 1, 1, 1, 1));
  const auto material = random_numbers(space.K.size(n), 5);
  const Sparse top = whitney_mass(space.K, space.g, n, material);
  const auto volume = primal_volumes(space.K, space.g)[n];
  EXPECT_EQ(top.nonZeros(), space.K.size(n));
  const auto lumped_top = lumped_mass(space.K, space.g, n, material);
  for (Index t = 0; t < space.K.size(n); ++t) {
    const double expected = *material.of(t) / volume[static_cast<std::size_t>(t)];
    EXPECT_NEAR(top.coeff(t, t), expected, 1e-11 * expected);
    EXPECT_NEAR(lumped_top[static_cast<std::size_t>(t)], expected, 1e-11 * expected);
  }
  const Sparse functions = whitney_mass(space.K, space.g, 0, material);
  const auto lumped = lumped_mass(space.K, space.g, 0, material);
  const Eigen::VectorXd sums = functions * Eigen::VectorXd::Ones(space.K.size(0));
  for (Index v = 0; v < space.K.size(0); ++v) EXPECT_NEAR(sums[v], lumped[static_cast<std::size_t>(v)], 1e-14);
}

TYPED_TEST(WhitneyMass, DoesNotSeeIsometriesAndScalesWithLength) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = test::random_mesh<n>(5);
  const Space<n> a(mesh), b(test::moved(mesh, n + 2, 1, 1, 2)), c(test::moved(mesh, n, 1e-3, 0, 3)),
      d(mesh, squared_lengths(a.K, a.g));
  for_each_degree<n>([&]<int k>() {
    const Sparse M = whitney_mass(a.K, a.g, k);
    expect_near(whitney_mass(b.K, b.g, k), M, 1e-11);
    expect_near(whitney_mass(c.K, c.g, k) * std::pow(1e-3, 2 * k - n), M, 1e-11);
    expect_near(whitney_mass(d.K, d.g, k), M, 1e-11);
  });
}

TYPED_TEST(WhitneyMass, FollowsTheLabelsOfVertices) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = meshes::box(n, n < 4 ? 2 : 1, {.jitter = 0.5 / n});
  std::vector<Index> id;
  const MeshData other = test::shuffled(mesh, 7, id);
  const Space<n> a(mesh), b(other);
  for_each_degree<n>([&]<int k>() {
    const Sparse A = whitney_mass(a.K, a.g, k), B = whitney_mass(b.K, b.g, k);
    ASSERT_EQ(A.nonZeros(), B.nonZeros());
    std::vector<SignedIndex> place;
    for (Index i = 0; i < a.K.size(k); ++i) {
      std::vector<Index> alias;
      for (const Index v : a.K.simplex(k, i)) alias.push_back(id[static_cast<std::size_t>(v)]);
      place.push_back(b.K.at(alias));
    }
    for (Eigen::Index row = 0; row < A.outerSize(); ++row)
      for (Sparse::InnerIterator entry(A, row); entry; ++entry) {
        const auto i = place[static_cast<std::size_t>(row)], j = place[static_cast<std::size_t>(entry.col())];
        EXPECT_NEAR(i.sign * j.sign * B.coeff(i.index, j.index), entry.value(), 1e-11 * A.coeff(row, row));
      }
  });
}

TYPED_TEST(WhitneyMass, TakesMaterialsByTag) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(6, n < 4 ? 2 : 1));
  Material tagged{.values = {2, 5}, .row_of = {}}, spread{.values = {}};
  for (Index t = 0; t < space.K.size(n); ++t) {
    tagged.row_of.push_back(t % 2);
    spread.values.push_back(t % 2 == 0 ? 2 : 5);
  }
  for_each_degree<n>([&]<int k>() {
    const Eigen::MatrixXd one = whitney_mass(space.K, space.g, k);
    EXPECT_EQ(Eigen::MatrixXd(whitney_mass(space.K, space.g, k, tagged)),
              Eigen::MatrixXd(whitney_mass(space.K, space.g, k, spread)));
    expect_near(whitney_mass(space.K, space.g, k, Material{.values = {3}}), 3 * one, 1e-15);
  });
}

Material material_of(const Eigen::MatrixXd& tensor) {
  return {.values = {tensor.data(), tensor.data() + tensor.size()}, .width = static_cast<int>(tensor.rows())};
}

// The identity as a tensor is the number 1, in every reading, on surfaces in space, too.
TYPED_TEST(WhitneyMass, OfTheIdentityTensorIsThatOfOne) {
  constexpr int n = TypeParam::value;
  const MeshData mesh = test::random_mesh<n>(1, 2);
  const Space<n> box(mesh), raised(test::moved(mesh, n + 2, 1, 1, 1));
  for (const Space<n>* space : {&box, &raised}) {
    const int d = space->g.coordinate_dimension();
    for (int k = 1; k < n; ++k)
      expect_near(whitney_mass(space->K, space->g, k, material_of(Eigen::MatrixXd::Identity(d, d))),
                  whitney_mass(space->K, space->g, k), 1e-12);
  }
}

TEST(WhitneyMass, OfTheIdentityTensorIsThatOfOneOnACurvedSurface) {
  const Space<2> torus(meshes::torus(7, 5));
  expect_near(whitney_mass(torus.K, torus.g, 1, material_of(Eigen::MatrixXd::Identity(3, 3))),
              whitney_mass(torus.K, torus.g, 1), 1e-13);
}

/// A linear map of determinant not 1.
template <int n>
Eigen::MatrixXd stretch() {
  Eigen::MatrixXd B = 1.3 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) B(i, j) += 0.5 * std::sin(1.0 + 3 * i + 5 * j);
  return B;
}

// The mesh moved by B has the mass of the mesh with the metric Bᵀ B, which is a tensor.
TYPED_TEST(WhitneyMass, OfATensorIsThatOfAnAffineImage) {
  constexpr int n = TypeParam::value;
  MeshData mesh = test::random_mesh<n>(1, 2);
  const Space<n> before(mesh);
  const auto B = stretch<n>();
  for (std::size_t v = 0; v < mesh.points.size(); v += n) {
    const Eigen::VectorXd image = B * Eigen::Map<const Eigen::VectorXd>(mesh.points.data() + v, n);
    std::copy(image.begin(), image.end(), mesh.points.begin() + static_cast<std::ptrdiff_t>(v));
  }
  const Space<n> after(mesh);
  const Eigen::MatrixXd metric = B.transpose() * B;
  const double volume = std::abs(B.determinant());
  EXPECT_GT(std::abs(volume - 1), 0.05);
  for (int k = 1; k < n; ++k) {
    const Eigen::MatrixXd tensor = 2 * k <= n ? Eigen::MatrixXd(std::pow(volume, 1.0 / k) * metric.inverse())
                                              : Eigen::MatrixXd(std::pow(volume, -1.0 / (n - k)) * metric);
    const Eigen::MatrixXd symmetric = (tensor + tensor.transpose()) / 2;
    expect_near(whitney_mass(before.K, before.g, k, material_of(symmetric)), whitney_mass(after.K, after.g, k), 1e-11);
  }
}

// cᵀ M c = |M| αᵀ C α, C the minors of A of order k, or beyond n/2 det(A) times those of its inverse; and M is positive.
TYPED_TEST(WhitneyMass, OfTensorsIsExactOnConstantFormsAndPositive) {
  constexpr int n = TypeParam::value;
  const Space<n> space(test::random_mesh<n>(2, 2));
  const auto volumes = primal_volumes(space.K, space.g)[n];
  const double volume = Eigen::Map<const Eigen::VectorXd>(volumes.data(), space.K.size(n)).sum();
  const Material material = random_tensors(1, n, 5);
  const Eigen::MatrixXd A = Eigen::Map<const Eigen::MatrixXd>(material.values.data(), n, n);
  for_each_degree<n - 1>([&]<int k>() {
    if constexpr (k > 0) {
      const auto form = test::random_form<k>(n, 0, 3);
      const auto c = DeRhamMap<n>(space.K, space.g, 0).template components<k>(form);
      const auto components = form(std::vector<double>(n));
      const Eigen::VectorXd alpha =
          Eigen::Map<const Eigen::VectorXd>(components.data(), static_cast<Eigen::Index>(components.size()));
      const Eigen::MatrixXd C =
          2 * k <= n ? compound<k>(A) : Eigen::MatrixXd(A.determinant() * compound<k>(A.inverse()));
      const double expected = volume * alpha.dot(C * alpha);
      const Sparse M = whitney_mass(space.K, space.g, k, material);
      const Eigen::Map<const Eigen::VectorXd> values(c.values().data(), c.size());
      EXPECT_NEAR(values.dot(M * values), expected, 1e-11 * expected) << "degree " << k;
      const Sparse varied = whitney_mass(space.K, space.g, k, random_tensors(space.K.size(n), n, 6));
      EXPECT_EQ(Sparse(varied - Sparse(varied.transpose())).norm(), 0) << "symmetric bit for bit";
      if (M.rows() < 800) {
        EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(varied, Eigen::EigenvaluesOnly).eigenvalues()[0], 0);
      }
    }
  });
}

TEST(WhitneyMass, NamesTheSimplexOfABadTensor) {
  const Space<4> space(meshes::box(4, 1));
  const auto message = [&](int k, const Material& material) -> std::string {
    try {
      (void)whitney_mass(space.K, space.g, k, material);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  Material material = random_tensors(2, 4, 1);
  material.row_of.assign(24, 0);
  material.row_of[7] = 1;
  EXPECT_EQ(message(2, material), "");
  const auto expect_named = [&](int k) {
    EXPECT_NE(message(k, material).find("4-simplex 7 = ("), std::string::npos) << message(k, material);
  };
  material.values[16 + 1] += 0.1;
  expect_named(1);
  material.values[16 + 1] = std::nan("");
  expect_named(3);
  for (std::size_t i = 16; i < 32; ++i) material.values[i] = i % 5 == 1 ? -1 : 0;
  expect_named(2);
  EXPECT_EQ(message(1, material), "") << "what minors do not hide";
}

TEST(WhitneyMass, HasTheSameBitsOnAnyNumberOfThreads) {
  const Space<3> space(meshes::box(3, 9, {.jitter = 0.2}));
  const int before = thread_count();
  for (int k = 0; k <= 3; ++k) {
    set_thread_count(1);
    const Sparse expected = whitney_mass(space.K, space.g, k);
    for (const int threads : {2, 4}) {
      set_thread_count(threads);
      const Sparse M = whitney_mass(space.K, space.g, k);
      ASSERT_EQ(M.nonZeros(), expected.nonZeros());
      EXPECT_TRUE(std::equal(M.valuePtr(), M.valuePtr() + M.nonZeros(), expected.valuePtr()));
      EXPECT_TRUE(std::equal(M.innerIndexPtr(), M.innerIndexPtr() + M.nonZeros(), expected.innerIndexPtr()));
    }
  }
  set_thread_count(before);
}

// No sign of a top simplex enters.
TEST(WhitneyMass, NeedsNoOrientation) {
  const SimplicialComplex<2> moebius(SimplexList{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  const auto g = Geometry<2>::from_squared_lengths(moebius, std::vector<double>(10, 1.0));
  ASSERT_FALSE(moebius.is_orientable());
  for (int k = 0; k <= 2; ++k) {
    const Eigen::MatrixXd M = whitney_mass(moebius, g, k);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues()[0], 0);
  }
}

// One triangle of legs 1, by hand.
TEST(WhitneyMass, KnowsTheRightTriangle) {
  const Space<2> space(test::single({0, 0, 1, 0, 0, 1}, 2));
  Eigen::Matrix3d functions, edges;
  functions << 2, 1, 1, 1, 2, 1, 1, 1, 2;
  edges << 4, 2, 0, 2, 4, 0, 0, 0, 2;  // of (0, 1), (0, 2), (1, 2)
  expect_near(whitney_mass(space.K, space.g, 0), functions / 24, 1e-15);
  expect_near(whitney_mass(space.K, space.g, 1), edges / 12, 1e-15);
  expect_near(whitney_mass(space.K, space.g, 2), Eigen::MatrixXd::Constant(1, 1, 2), 1e-15);
}

TEST(WhitneyMass, RefusesWhatDoesNotFit) {
  const Space<3> space(meshes::box(3, 1));
  const auto mass = [&](int k, const Material& material) { return whitney_mass(space.K, space.g, k, material); };
  EXPECT_THROW((void)mass(-1, {}), InputError);
  EXPECT_THROW((void)mass(4, {}), InputError);
  EXPECT_THROW((void)mass(0, {.values = {1, 2}}), InputError);
  EXPECT_THROW((void)mass(0, {.values = {}}), InputError);
  EXPECT_THROW((void)mass(0, {.values = {1, 2}, .row_of = {0, 1, 0, 1, 0, 2}}), InputError);
  EXPECT_THROW((void)mass(0, {.values = {std::nan("")}}), InputError);
  EXPECT_THROW((void)mass(1, {.values = {1, 0, 0, 1}, .width = 2}), InputError);
  EXPECT_THROW((void)mass(1, {.values = {1, 0.1, 0, 0, 1, 0, 0, 0, 1}, .width = 3}), InputError);
  EXPECT_THROW((void)mass(0, random_tensors(6, 3, 1)), InputError);
  EXPECT_NO_THROW((void)mass(2, random_tensors(6, 3, 1)));
  EXPECT_THROW((void)lumped_mass(space.K, space.g, 1), InputError);
  const SimplicialComplex<2> K(SimplexList{{0, 1, 2}});
  try {
    (void)whitney_mass(K, Geometry<2>::from_points(K, {0, 0, 1, 1, 2, 2}, 2), 1);
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("(0, 1, 2)"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)whitney_mass(K, Geometry<2>::from_points(K, {0, 0, 1e200, 0, 0, 1e200}, 2), 0), GeometryError);
}

}  // namespace
}  // namespace derham
