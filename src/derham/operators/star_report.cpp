#include "derham/operators/star_report.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/geometry/top_volumes.hpp"
#include "derham/operators/de_rham_map.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>

namespace derham {
namespace {

using Eigen::VectorXd;

void require_degree(int n, int k) {
  if (k < 0 || k > n) throw InputError(text("a Hodge star of degree ", k, "; degrees are 0 to ", n));
}

StarReport of_diagonal(int k, const VectorXd& diagonal) {
  StarReport report;
  report.degree = k;
  if (diagonal.size() == 0) return report;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (diagonal[i] == 0) report.zero.push_back(static_cast<Index>(i));
    if (diagonal[i] < 0) report.negative.push_back(static_cast<Index>(i));
  }
  report.smallest = diagonal.minCoeff();
  report.largest = diagonal.maxCoeff();
  if (report.smallest <= 0) report.definiteness = Definiteness::not_positive;
  return report;
}

/// max |c_Iᵀ M c_J - δ_IJ ∫ A| / ∫ |A| over the constant forms dx^I; `apply` is M.
template <int n, int k, class Apply>
double constant_error(const SimplicialComplex<n>& K, const Geometry<n>& geometry, const Material& material,
                      Apply&& apply) {
  if (geometry.ambient_dimension() != n || material.width != 0) return std::numeric_limits<double>::quiet_NaN();
  const auto volume = top_volumes(K, geometry).volume;
  double expected = 0, scale = 0;
  for (Index t = 0; t < K.size(n); ++t) {
    const double part = *material.of(t) * std::abs(volume[static_cast<std::size_t>(t)]);
    expected += part;
    scale += std::abs(part);
  }
  const DeRhamMap<n> R(K, geometry, 0);
  const auto forms = static_cast<std::size_t>(binomial(n, k));
  Eigen::MatrixXd values(K.size(k), static_cast<Eigen::Index>(forms));
  for (std::size_t i = 0; i < forms; ++i) {
    std::vector<double> components(forms);
    components[i] = 1;
    const auto form = R.template components<k>(
        [&components](std::span<const double>) -> std::span<const double> { return components; });
    values.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const VectorXd>(form.values().data(), form.size());
  }
  const Eigen::MatrixXd products = values.transpose() * apply(values);
  return (products - expected * Eigen::MatrixXd::Identity(products.rows(), products.cols())).cwiseAbs().maxCoeff() /
         scale;
}

template <int n, class Apply>
double constant_error(const SimplicialComplex<n>& K, const Geometry<n>& geometry, int k, const Material& material,
                      Apply&& apply) {
  double error = 0;
  [&]<int... degree>(std::integer_sequence<int, degree...>) {
    ((k == degree ? void(error = constant_error<n, degree>(K, geometry, material, apply)) : void()), ...);
  }(std::make_integer_sequence<int, n + 1>{});
  return error;
}

/// The extreme Ritz values of M after some steps from a fixed random vector: they lie within its spectrum.
std::pair<double, double> extreme_ritz_values(const Eigen::SparseMatrix<double, Eigen::RowMajor>& M) {
  constexpr Eigen::Index most_steps = 40;
  const Eigen::Index steps = std::min(most_steps, M.rows());
  VectorXd alpha(steps), beta(steps), before = VectorXd::Zero(M.rows()), v(M.rows());
  std::mt19937 random(1);
  for (double& x : v) x = static_cast<double>(random()) / 0x1p31 - 1;
  v.normalize();
  Eigen::Index taken = 0;
  for (double last = 0; taken < steps; ++taken) {
    VectorXd w = M * v - last * before;
    alpha[taken] = w.dot(v);
    w -= alpha[taken] * v;
    last = beta[taken] = w.norm();
    if (!(last > 1e-14 * std::abs(alpha[0]))) {
      ++taken;
      break;
    }
    before = std::exchange(v, w / last);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(alpha.head(taken), beta.head(taken - 1), Eigen::EigenvaluesOnly);
  return {solver.eigenvalues()[0], solver.eigenvalues()[taken - 1]};
}

/// Whether every number and tensor is positive (definite).
bool is_positive(const Material& material) {
  if (material.width == 0) return std::ranges::all_of(material.values, [](double x) { return x > 0; });
  const std::size_t size = static_cast<std::size_t>(material.width) * static_cast<std::size_t>(material.width);
  for (std::size_t row = 0; row < material.values.size(); row += size)
    if (Eigen::Map<const Eigen::MatrixXd>(material.values.data() + row, material.width, material.width).llt().info() !=
        Eigen::Success)
      return false;
  return true;
}

constexpr double large_condition = 1e8;

std::string ill_conditioned(double condition) {
  return condition > large_condition && std::isfinite(condition)
             ? text("its condition is at least ", condition, ": scale by the diagonal, or improve the worst simplices")
             : std::string();
}

constexpr const char* material_not_positive =
    "the material is not positive on every top simplex: there may be no energy; solve with a factorisation for "
    "indefinite matrices";

/// The warning of a barycentric star.
template <int n>
std::string inconsistent(const StarKind& kind, int k, double error) {
  if (!std::holds_alternative<Barycentric>(kind) || k == 0 || k == n) return {};
  return text("barycentric dual cells are not orthogonal to the ", k, "-simplices: this star is not consistent",
              std::isnan(error) ? std::string() : text(" (error ", error, " on constant forms)"),
              ", and what is solved with it does not converge; use whitney_mass or Circumcentric{}");
}

template <int n>
std::string diagonal_advice(const SimplicialComplex<n>& K, const StarReport& report) {
  const int k = report.degree;
  if (!report.negative.empty())
    return text(report.negative.size(), " dual volumes are negative, those of ",
                simplices_text<n>(K, k, report.negative),
                ": no energy and no stable time step; use whitney_mass, weights that make them positive "
                "(hot_weights), or a Delaunay mesh");
  if (!report.zero.empty())
    return text(report.zero.size(), " dual volumes are zero, those of ", simplices_text<n>(K, k, report.zero),
                ": there is no inverse; use whitney_mass, a form without the inverse, weights that make them positive "
                "(hot_weights), or a well-centred mesh");
  return ill_conditioned(report.condition);
}

}  // namespace

template <int n>
StarReport star_report(const HodgeStar<n>& star, const Geometry<n>& geometry, int k) {
  require_degree(n, k);
  const auto& K = star.complex();
  geometry.require_fits(K);
  const VectorXd diagonal = Eigen::Map<const VectorXd>(star.diagonal(k).data(), K.size(k));
  StarReport report = of_diagonal(k, diagonal);
  if (diagonal.size() == 0) return report;
  if (report.definiteness != Definiteness::not_positive) {
    report.definiteness = Definiteness::positive;
    report.condition = report.largest / report.smallest;
  }
  report.constant_error =
      constant_error(K, geometry, k, star.material(),
                     [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return diagonal.asDiagonal() * x; });
  report.advice = inconsistent<n>(star.kind(), k, report.constant_error);
  if (report.advice.empty() && report.definiteness == Definiteness::not_positive && !is_positive(star.material()))
    report.advice = material_not_positive;
  if (report.advice.empty()) report.advice = diagonal_advice(K, report);
  return report;
}

template <int n>
StarReport star_report(const Eigen::SparseMatrix<double, Eigen::RowMajor>& mass, const SimplicialComplex<n>& K,
                       const Geometry<n>& geometry, int k, const Material& material) {
  require_degree(n, k);
  geometry.require_fits(K);
  require_fits(material, K, geometry);
  if (mass.rows() != K.size(k) || mass.cols() != K.size(k))
    throw InputError(
        text("a matrix of ", mass.rows(), " × ", mass.cols(), " for ", K.size(k), " simplices of degree ", k));
  StarReport report = of_diagonal(k, mass.diagonal());
  if (mass.rows() == 0) return report;
  const bool sound = is_positive(material);
  const auto [low, high] = extreme_ritz_values(mass);
  if (sound)
    report.definiteness = Definiteness::positive;
  else if (low <= 0)
    report.definiteness = Definiteness::not_positive;
  // Entries of the diagonal lie within the spectrum. A Ritz value that is not positive though all eigenvalues are is rounding.
  const double smallest = sound && low <= 0 ? report.smallest : std::min(low, report.smallest);
  if (report.definiteness != Definiteness::not_positive) report.condition = std::max(high, report.largest) / smallest;
  report.constant_error =
      constant_error(K, geometry, k, material, [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return mass * x; });
  report.advice = sound ? ill_conditioned(report.condition) : material_not_positive;
  return report;
}

#define DERHAM_INSTANTIATE(n)                                                                                       \
  template StarReport star_report(const HodgeStar<n>&, const Geometry<n>&, int);                                    \
  template StarReport star_report(const Eigen::SparseMatrix<double, Eigen::RowMajor>&, const SimplicialComplex<n>&, \
                                  const Geometry<n>&, int, const Material&);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
