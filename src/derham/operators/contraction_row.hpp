#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/quadrature.hpp"
#include "derham/operators/simplex_frame.hpp"
#include "derham/operators/whitney_simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace derham {

/// Which of the values on the top simplices around a simplex an interior product takes.
enum class Trace : std::uint8_t {
  mean,   ///< their mean, weighted by volume
  upwind  ///< that of the top simplex where X comes from; 0 where X comes in from outside
};

// Internal to this room.
namespace detail {

template <int n>
using Corners = std::array<const double*, static_cast<std::size_t>(n) + 1>;
template <int n>
using Barycentric = std::array<double, static_cast<std::size_t>(n) + 1>;

/// X at a point of a simplex, written to `to`; x (d,) becomes the point.
/// Throws   InputError if X has not d components
template <int n, class Field>
void evaluate_field(const Field& X, const Corners<n>& corners, const Barycentric<n>& lambda, std::span<double> x,
                    double* to) {
  for (std::size_t c = 0; c < x.size(); ++c) {
    x[c] = 0;
    for (std::size_t v = 0; v <= n; ++v) x[c] += lambda[v] * corners[v][c];
  }
  const auto& value = X(std::span<const double>(x));
  if (value.size() != x.size()) throw InputError(text("a field of ", value.size(), " components; expected ", x.size()));
  for (std::size_t c = 0; c < x.size(); ++c) to[c] = value[c];
}

/// The row of an interior product of k-forms for one (k-1)-simplex after another: what it weighs the values on k-simplices
/// with. Keeps its room between calls.
template <int n, int k>
class ContractionRow {
 public:
  struct Entry {
    Index simplex;
    double weight;
  };

  ContractionRow(const SimplicialComplex<n>& K, const Geometry<n>& geometry, Trace trace, int order)
      : complex_(&K), geometry_(&geometry), trace_(trace), rule_(simplex_rule<k - 1>(order)),
        d_(static_cast<std::size_t>(geometry.coordinate_dimension())), whitney_(geometry.coordinate_dimension()),
        columns_(subsets<k>(geometry.coordinate_dimension())), minors_(columns_.size()),
        vectors_(static_cast<std::size_t>(k) * d_), point_(d_) {}

  /// The row of s, given the top simplices around it; a k-simplex of two of them stands there twice.
  template <class Field>
  const std::vector<Entry>& of(const Field& X, Index s, std::span<const Index> tops) {
    trials_.clear();
    for (const Index t : tops) try_top(X, s, t);
    row_.clear();
    const std::size_t nodes = rule_.weights.size();
    taken_.assign(nodes, 0);
    for (std::size_t i = 0; i < trials_.size(); ++i)
      if (takes(trials_[i])) taken_[i % nodes] += trials_[i].volume;
    for (std::size_t i = 0; i < tops.size(); ++i) append(tops[i], std::span(trials_).subspan(i * nodes, nodes));
    return row_;
  }

 private:
  /// At one node of the rule, in one top simplex: the weights of its k-faces, and how far X points out of its interior
  /// backwards, <= 0 if it comes from it.
  struct Trial {
    FaceArray<n, double> weights;
    double upstream, volume;
  };

  [[nodiscard]] bool takes(const Trial& trial) const noexcept {
    constexpr double parallel = 1e-12;  // a cosine: X runs along the facet
    return trace_ == Trace::mean || trial.upstream <= parallel;
  }

  template <class Field>
  void try_top(const Field& X, Index s, Index t) {
    const auto corners = geometry_->corners(*complex_, t);
    whitney_.set(corners);
    const auto place = places(s, t);
    for (std::size_t i = 1; i < k; ++i)
      for (std::size_t c = 0; c < d_; ++c) vectors_[i * d_ + c] = corners[place[i]][c] - corners[place[0]][c];
    std::array<const double*, static_cast<std::size_t>(k)> rows{};
    for (std::size_t i = 0; i < k; ++i) rows[i] = vectors_.data() + i * d_;
    for (const auto& point : rule_.points) {
      Barycentric<n> lambda{};
      for (std::size_t i = 0; i < k; ++i) lambda[place[i]] = point[i];
      evaluate_field<n>(X, corners, lambda, point_, vectors_.data());
      for (std::size_t c = 0; c < columns_.size(); ++c) minors_[c] = minor_of<k>(rows, columns_[c]);
      Trial& trial = trials_.emplace_back();
      whitney_.weights(lambda.data(), minors_.data(), trial.weights);
      trial.upstream = upstream(place);
      trial.volume = whitney_.frame().volume();
    }
  }

  /// Where the vertices of (k-1)-simplex s are in top simplex t.
  [[nodiscard]] std::array<std::size_t, static_cast<std::size_t>(k)> places(Index s, Index t) const {
    std::array<std::size_t, static_cast<std::size_t>(k)> result{};
    const auto all = complex_->template simplex<n>(t);
    const auto own = complex_->template simplex<k - 1>(s);
    for (std::size_t i = 0; i < k; ++i)
      result[i] = static_cast<std::size_t>(std::ranges::find(all, own[i]) - all.begin());
    return result;
  }

  /// The largest cosine of X with the ∇λ_v that vanish on s: not positive if X comes from inside.
  [[nodiscard]] double upstream(const std::array<std::size_t, static_cast<std::size_t>(k)>& place) const {
    const auto& frame = whitney_.frame();
    double speed = 0, largest = -1;
    for (std::size_t c = 0; c < d_; ++c) speed += vectors_[c] * vectors_[c];
    speed = std::sqrt(speed);
    for (std::size_t v = 0; v <= n; ++v) {
      if (std::ranges::find(place, v) != place.end()) continue;
      double along = 0, square = 0;
      for (const double g : frame.gradients()[v]) square += g * g;
      for (std::size_t c = 0; c < d_; ++c) along += vectors_[c] * frame.gradient(v, c);
      largest = std::max(largest, speed > 0 ? along / (speed * std::sqrt(square)) : 0);
    }
    return largest;
  }

  /// The part of one top simplex, given what was found at the nodes.
  void append(Index t, std::span<const Trial> nodes) {
    const auto index = face_indices(*complex_, t);
    for (const unsigned face : masks_of<n, k + 1>()) {
      double weight = 0;
      for (std::size_t q = 0; q < nodes.size(); ++q)
        if (takes(nodes[q])) weight += rule_.weights[q] * nodes[q].volume / taken_[q] * nodes[q].weights[face];
      if (weight != 0)
        row_.push_back({index[face], weight * complex_->sign(k, index[face]) / static_cast<double>(factorial(k - 1))});
    }
  }

  const SimplicialComplex<n>* complex_;
  const Geometry<n>* geometry_;
  Trace trace_;
  SimplexRule<k - 1> rule_;
  std::size_t d_;
  WhitneySimplex<n, k> whitney_;
  std::vector<std::array<int, static_cast<std::size_t>(k)>> columns_;
  std::vector<double> minors_, vectors_, point_;  // vectors: X, then the edges of the (k-1)-simplex, (k, d)
  std::vector<Trial> trials_;                     // (tops, nodes)
  std::vector<double> taken_;                     // (nodes,) volume of the top simplices whose values are taken
  std::vector<Entry> row_;
};

}  // namespace detail
}  // namespace derham
