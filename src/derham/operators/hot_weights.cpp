// This follows Mullen, Memari, de Goes, Desbrun, "HOT: Hodge-optimized triangulations", 2011.
#include "derham/operators/hot_weights.hpp"

#include "derham/core/cancel.hpp"
#include "derham/core/disjoint_sets.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/dual/power.hpp"
#include "derham/dual/power_simplex.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/operators/not_flat.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace derham {
namespace {

using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// E(w) = energy + ½ wᵀHw - rᵀw, and the dual lengths D(w) = length + A w of the facets.
struct Problem {
  double energy = 0;
  Matrix H;
  VectorXd r;
  RowMatrix A;
  VectorXd length, wanted, size;  ///< `wanted` is the least good length, `size` what a facet counts

  [[nodiscard]] VectorXd missing(const VectorXd& w) const { return (wanted - length - A * w).cwiseMax(0); }
  [[nodiscard]] double value(const VectorXd& w) const { return energy + w.dot(0.5 * (H * w) - r); }
  [[nodiscard]] double value(const VectorXd& w, double penalty) const {
    return value(w) + penalty / 2 * missing(w).cwiseAbs2().dot(size);
  }
};

/// The problem in units of `unit`, which is about the size of a top simplex.
template <int n>
Problem problem_of(const SimplicialComplex<n>& K, const Geometry<n>& geometry, double margin, double unit) {
  Problem problem;
  const Index facets = K.size(n - 1), vertices = K.size(0);
  problem.r = VectorXd::Zero(vertices);
  problem.length = problem.wanted = problem.size = VectorXd::Zero(facets);
  Triplets energy, lengths;
  std::vector<double> edges(static_cast<std::size_t>(n * geometry.coordinate_dimension()));
  for (Index t = 0; t < K.size(n); ++t) {
    const detail::PowerSimplex<n> simplex(
        detail::frame_of<n>(geometry.corners(K, t), geometry.coordinate_dimension(), unit, edges.data()));
    const double volume = simplex.zero.volume;
    const auto corner = K.template simplex<n>(t);
    problem.energy += volume * simplex.off_center;
    for (std::size_t i = 0; i <= n; ++i) {
      problem.r[corner[i]] += volume * (simplex.zero.lambda[i] - 1.0 / (n + 1));
      const Index facet = K.face_opposite(n, t, static_cast<int>(i));
      const double barycentric = simplex.zero.altitude[i] / (n + 1);
      problem.length[facet] += simplex.zero.height(static_cast<int>(i));
      problem.wanted[facet] += margin * barycentric;
      problem.size[facet] += volume / barycentric / barycentric;
      for (std::size_t j = 0; j <= n; ++j) {
        energy.emplace_back(corner[i], corner[j], volume * simplex.products[i][j] / 2);
        lengths.emplace_back(facet, corner[j], -simplex.products[i][j] * simplex.zero.altitude[i] / 2);
      }
    }
  }
  problem.H.resize(vertices, vertices);
  problem.H.setFromTriplets(energy.begin(), energy.end());
  problem.A.resize(facets, vertices);
  problem.A.setFromTriplets(lengths.begin(), lengths.end());
  return problem;
}

/// The component of every vertex, as its first vertex.
template <int n>
std::vector<Index> components(const SimplicialComplex<n>& K) {
  DisjointSets sets(K.size(0));
  for (Index e = 0; e < K.size(1); ++e) (void)sets.unite(K.simplex(1, e)[0], K.simplex(1, e)[1]);
  std::vector<Index> result(static_cast<std::size_t>(K.size(0)));
  for (Index v = 0; v < K.size(0); ++v) result[static_cast<std::size_t>(v)] = sets.root(v);
  return result;
}

/// The same number is added to all weights of a component, so that their mean is 0.
void center(const std::vector<Index>& component, VectorXd& w) {
  VectorXd sum = VectorXd::Zero(w.size()), count = sum;
  for (std::size_t v = 0; v < component.size(); ++v) {
    sum[component[v]] += w[static_cast<Eigen::Index>(v)];
    ++count[component[v]];
  }
  for (std::size_t v = 0; v < component.size(); ++v)
    w[static_cast<Eigen::Index>(v)] -= sum[component[v]] / count[component[v]];
}

/// A solution of (H + penalty AᵀSA) x = y with the sum over the facets that miss something; H is made regular by `pin`.
VectorXd newton_step(const Problem& problem, const Matrix& pin, double penalty, const VectorXd& missing,
                     const VectorXd& gradient) {
  poll_cancel();
  Matrix hessian = problem.H + pin;
  if (penalty > 0) {
    const VectorXd active = (missing.array() > 0).select(penalty * problem.size, 0.0);
    hessian += Matrix(problem.A.transpose() * active.asDiagonal() * problem.A);
  }
  const Eigen::SimplicialLDLT<Matrix> solver(hessian);
  return solver.solve(-gradient);
}

/// Minimises the energy plus penalty/2 Σ size missing², which is convex with piecewise linear gradient.
void minimize(const Problem& problem, const Matrix& pin, double penalty, VectorXd& w) {
  constexpr int most_steps = 50;
  double value = problem.value(w, penalty);
  for (int step = 0; step < most_steps; ++step) {
    const VectorXd missing = problem.missing(w);
    const VectorXd gradient =
        problem.H * w - problem.r - penalty * (problem.A.transpose() * problem.size.cwiseProduct(missing));
    const VectorXd direction = newton_step(problem, pin, penalty, missing, gradient);
    const double slope = gradient.dot(direction);
    double length = 1, next = problem.value(w + direction, penalty);
    while (next > value + 1e-4 * length * slope && length > 1e-6) {
      length /= 2;
      next = problem.value(w + length * direction, penalty);
    }
    if (!(next < value)) return;
    w += length * direction;
    if (value - next <= 1e-14 * std::abs(value)) return;
    value = next;
  }
}

/// What HotWeights::excluded_range says. With y = size · missing, yᵀ(D - wanted) is -yᵀ missing here, and at other weights the same
/// up to Aᵀy, which is nearly zero at the end of the minimisation.
double excluded_range(const Problem& problem, const VectorXd& w) {
  const VectorXd missing = problem.missing(w), y = problem.size.cwiseProduct(missing);
  const double changed = (problem.A.transpose() * y).cwiseAbs().sum() / 2;
  return std::max(0.0, y.dot(missing) / changed - (w.maxCoeff() - w.minCoeff()));
}

struct Solution {
  VectorXd weights;
  double excluded_range = 0;
};

/// The best weights, in units.
Solution solve(const Problem& problem, const Matrix& pin) {
  constexpr double largest_penalty = 1e10;
  const VectorXd zero = VectorXd::Zero(problem.r.size());
  const VectorXd best = newton_step(problem, pin, 0, zero, -problem.r);
  VectorXd w = best;
  for (double penalty = 1; penalty <= largest_penalty; penalty *= 10) {
    if ((problem.missing(w).array() <= problem.wanted.array() / 2).all()) return {w, 0};
    minimize(problem, pin, penalty, w);
  }
  return {best, excluded_range(problem, w)};
}

template <int n>
std::array<std::vector<Index>, n + 1> not_positive(const SimplicialComplex<n>& K, const Geometry<n>& geometry,
                                                   const std::vector<double>& weights) {
  const auto dual = power_dual(K, geometry, weights).dual;
  std::array<std::vector<Index>, n + 1> result;
  for (std::size_t k = 0; k <= n; ++k)
    for (std::size_t i = 0; i < dual[k].size(); ++i)
      if (!(dual[k][i] > 0)) result[k].push_back(static_cast<Index>(i));
  return result;
}

template <int n>
std::string advice(const SimplicialComplex<n>& K, const HotWeights<n>& result) {
  for (int k = n - 1; k >= 0; --k) {
    const auto& list = result.not_positive[static_cast<std::size_t>(k)];
    if (list.empty()) continue;
    return text(list.size(), " dual volumes of degree ", k, " stay without a positive value, those of ",
                simplices_text<n>(K, k, list),
                result.excluded_range > 0 ? text("; no weights that differ by less than ", result.excluded_range,
                                                 " give all facets the length they should have")
                                          : std::string(),
                ": use whitney_mass, or another triangulation");
  }
  return {};
}

}  // namespace

template <int n>
HotWeights<n> hot_weights(const SimplicialComplex<n>& K, const Geometry<n>& geometry, double margin) {
  geometry.require_fits(K);
  if (!(margin > 0 && margin < 1)) throw InputError(text("a margin of ", margin, "; it must be between 0 and 1"));
  detail::require_not_flat(K, geometry);
  HotWeights<n> result;
  if (K.size(n) == 0) return result;
  const double unit = std::pow(total_volume(K, geometry) / static_cast<double>(K.size(n)), 1.0 / n);
  const Problem problem = problem_of(K, geometry, margin, unit);
  const auto component = components(K);
  Matrix pin(K.size(0), K.size(0));
  for (Index v = 0; v < K.size(0); ++v)
    if (component[static_cast<std::size_t>(v)] == v) pin.insert(v, v) = problem.H.coeff(v, v);
  auto [w, excluded] = solve(problem, pin);
  center(component, w);
  const double square = unit * unit;
  result.excluded_range = excluded * square;
  result.weights.resize(component.size());
  VectorXd::Map(result.weights.data(), w.size()) = square * w;
  result.energy_before = problem.energy * square * std::pow(unit, n);
  result.energy = std::max(0.0, problem.value(w)) * square * std::pow(unit, n);
  result.not_positive_before = not_positive(K, geometry, {});
  result.not_positive = not_positive(K, geometry, result.weights);
  result.advice = advice(K, result);
  return result;
}

template HotWeights<1> hot_weights(const SimplicialComplex<1>&, const Geometry<1>&, double);
template HotWeights<2> hot_weights(const SimplicialComplex<2>&, const Geometry<2>&, double);
template HotWeights<3> hot_weights(const SimplicialComplex<3>&, const Geometry<3>&, double);
template HotWeights<4> hot_weights(const SimplicialComplex<4>&, const Geometry<4>&, double);

}  // namespace derham
