// d, ⋆, Δ and the wedge product as operators: applied without matrices, by their matrix, and Eigen's product with that matrix.
#include "bench/support/kernel.hpp"
#include "bench/support/meshes.hpp"
#include "bench/support/operators.hpp"
#include "bench/support/program.hpp"
#include "bench/support/yardsticks.hpp"
#include "derham/hodge/up_laplacian.hpp"
#include "derham/operators/wedge_operator.hpp"

#include <Eigen/SparseCore>

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace derham::bench {
namespace {

using Vector = std::vector<double>;

/// What the operators of one of the meshes are made of.
struct Parts {
  explicit Parts(const BenchMesh& mesh) : K(complex_of<3>(mesh)), star(K, Geometry<3>::from_mesh(K, mesh.data)), d(K) {}
  const SimplicialComplex<3>& K;
  HodgeStar<3> star;
  Derivative<3> d;

  [[nodiscard]] Offset table(int k) const { return static_cast<Offset>(K.face_table(k).size_bytes()); }
  [[nodiscard]] Offset values(int k) const { return 8 * Offset{K.size(k)}; }
};

/// Built at the first call.
template <class T>
const T& kept(const std::string& name, const BenchMesh& mesh, auto&& make) {
  static std::map<std::pair<std::string, const BenchMesh*>, std::unique_ptr<const T>> built;
  auto& place = built[{name, &mesh}];
  if (!place) place = std::make_unique<const T>(make());
  return *place;
}

const Parts& parts_of(const BenchMesh& mesh) {
  return kept<Parts>("parts", mesh, [&mesh] { return Parts(mesh); });
}

template <class From, class To>
Kernel applied(const BenchMesh& mesh, const Operator<From, To>& A, Offset tables) {
  return application(mesh, From(A.from()).size(), To(A.to()).size(), tables,
                     [map = A.map()](const Vector& x, Vector& y) { map->apply(x, y); });
}

Offset bytes(const SparseMatrix& A) { return 12 * Offset{A.nonZeros()} + 4 * Offset{A.rows()}; }

Kernel eigen(const BenchMesh& mesh, const SparseMatrix& A) {
  return application(mesh, A.cols(), A.rows(), bytes(A), [&A](const Vector& x, Vector& y) {
    Eigen::Map<Eigen::VectorXd>(y.data(), A.rows()).noalias() =
        A * Eigen::Map<const Eigen::VectorXd>(x.data(), A.cols());
  });
}

/// make(parts) is an Operator, tables(parts) the bytes of tables and of vectors in between that it reads and writes.
template <class Make, class Tables>
void add_operator(const std::string& name, const Options& options, const Make& make, const Tables& tables) {
  using Map = decltype(make(std::declval<const Parts&>()));
  const auto made = [=](const BenchMesh& mesh) -> const Map& {
    return kept<Map>(name, mesh, [&] { return make(parts_of(mesh)); });
  };
  add(name, solids(options), [=](const BenchMesh& mesh) {  // prepared for the number of threads that it is measured on
    return applied(mesh, make(parts_of(mesh)), tables(parts_of(mesh)));
  });
  add(name + " assembled", solids(options), [=](const BenchMesh& mesh) {
    const Map& A = made(mesh);
    return applied(mesh, A.assembled(), bytes(A.matrix()));
  });
  add(
      name + " by Eigen", solids(options), [=](const BenchMesh& mesh) { return eigen(mesh, made(mesh).matrix()); },
      Runs::one_thread);
}

template <int k>
void add_derivative(const Options& options) {
  add_operator(
      "d_" + std::to_string(k), options,
      [](const Parts& p) -> Operator<PrimalForm<3, k>, PrimalForm<3, k + 1>> { return p.d; },
      [](const Parts& p) { return p.table(k + 1) + (k == 2 ? Offset{p.K.size(3)} : 0); });
}

template <int k>
void add_star(const Options& options) {
  add_operator(
      "⋆_" + std::to_string(k), options,
      [](const Parts& p) -> Operator<PrimalForm<3, k>, DualForm<3, 3 - k>> { return p.star; },
      [](const Parts& p) { return p.values(k); });
}

template <int p, int q>
void add_wedge(const Options& options) {
  add_operator(
      "wedge of " + std::to_string(p) + " and " + std::to_string(q), options,
      [](const Parts& parts) -> Operator<PrimalForm<3, p>, PrimalForm<3, p + q>> {
        PrimalForm<3, q> ones(parts.K);
        for (double& value : ones.values()) value = 1;
        return WedgeWith(std::move(ones));
      },
      [](const Parts& parts) { return bytes_of_wedge(parts.K, p, q) + parts.values(q); });
}

using Functions = Operator<PrimalForm<3, 0>, PrimalForm<3, 0>>;

/// Δ of functions in one pass and a division, and as four operators.
void add_laplacian(const Options& options) {
  add_operator(
      "Δ_0", options,
      [](const Parts& p) {
        const auto up = std::make_shared<const UpLaplacian<3>>(p.star, 0);
        const auto apply = [&p, up](std::span<const double> x, std::span<double> y) {
          up->apply(x, y);
          p.star.apply_inverse(0, y, y);
        };
        const Functions composed = p.star * p.d * p.star * p.d;
        return Functions(p.K, p.K, apply, [composed] { return SparseMatrix(-composed.matrix()); });
      },
      [](const Parts& p) { return p.table(1) + p.values(1) + 3 * p.values(0); });
  add_operator(
      "Δ_0 composed", options, [](const Parts& p) -> Functions { return -(p.star * p.d * p.star * p.d); },
      [](const Parts& p) { return 2 * p.table(1) + 5 * p.values(1) + 3 * p.values(0); });
}

const Suite suite([](const Options& options) {
  add_copy();
  add_derivative<0>(options);
  add_derivative<1>(options);
  add_derivative<2>(options);
  add_star<0>(options);
  add_star<1>(options);
  add_star<2>(options);
  add_star<3>(options);
  add_laplacian(options);
  add_wedge<0, 1>(options);
  add_wedge<1, 1>(options);
  add_wedge<1, 2>(options);
});

}  // namespace
}  // namespace derham::bench
