#pragma once

#include "derham/geometry/geometry.hpp"
#include "derham/operators/field_on_simplex.hpp"
#include "derham/operators/inflow.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/quadrature.hpp"
#include "derham/operators/whitney_simplex.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace derham {

/// Which of the values on the top simplices around a simplex an interior product takes.
enum class Trace : std::uint8_t {
  mean,   ///< their mean, weighted by volume
  upwind  ///< that of the top simplex where X comes from, or nearest to there; 0 where X comes in from outside
};

// Internal to this room.
namespace detail {

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

  /// The row of s, given the top simplices around it and whether X comes in through a boundary facet around it; a
  /// k-simplex of two top simplices stands there twice.
  template <class Field>
  const std::vector<Entry>& of(const Field& X, Index s, std::span<const Index> tops, bool entered) {
    trials_.clear();
    for (const Index t : tops) try_top(X, s, t);
    const std::size_t nodes = rule_.weights.size();
    choose(nodes, entered);
    row_.clear();
    for (std::size_t i = 0; i < tops.size(); ++i) append(tops[i], std::span(trials_).subspan(i * nodes, nodes));
    return row_;
  }

 private:
  /// At one node of the rule, in one top simplex: the weights of its k-faces, and how far X points out of its interior
  /// backwards, <= 0 if it comes from it.
  struct Trial {
    FaceArray<n, double> weights;
    double upstream, volume;
    bool taken;
  };

  /// Whether the top simplex nearest to where X comes from, `least` away, is not where it comes from. What flows through a
  /// facet (k = n) comes from one of its sides, or does not flow.
  [[nodiscard]] static bool from_outside(double least, bool entered) noexcept {
    return k == n ? least > 0 : entered && least > grazing;
  }

  /// Settles which trials are taken at every node, and their volume.
  void choose(std::size_t nodes, bool entered) {
    taken_.assign(nodes, 0);
    for (std::size_t q = 0; q < nodes; ++q) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = q; i < trials_.size(); i += nodes) least = std::min(least, trials_[i].upstream);
      const bool nothing = trace_ == Trace::upwind && from_outside(least, entered);
      for (std::size_t i = q; i < trials_.size(); i += nodes) {
        Trial& trial = trials_[i];
        trial.taken = !nothing && (trace_ == Trace::mean || trial.upstream == least);
        if (trial.taken) taken_[q] += trial.volume;
      }
    }
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
      evaluate_field<n>(*complex_, t, X, corners, lambda, point_, vectors_.data());
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

  /// The largest X·∇λ_v of those that vanish on s, as a part of what flows through: not positive if X comes from inside.
  [[nodiscard]] double upstream(const std::array<std::size_t, static_cast<std::size_t>(k)>& place) const {
    const auto rates = barycentric_rates<n>(whitney_.frame(), std::span(vectors_).first(d_));
    const double through = through_flow<n>(rates);
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v <= n; ++v)
      if (std::ranges::find(place, v) == place.end()) largest = std::max(largest, rates[v]);
    return through > 0 ? largest / through : 0;
  }

  /// The part of one top simplex, given what was found at the nodes.
  void append(Index t, std::span<const Trial> nodes) {
    const auto index = face_indices(*complex_, t);
    for (const unsigned face : masks_of<n, k + 1>()) {
      double weight = 0;
      for (std::size_t q = 0; q < nodes.size(); ++q)
        if (nodes[q].taken) weight += rule_.weights[q] * nodes[q].volume / taken_[q] * nodes[q].weights[face];
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
