#pragma once

#include "derham/complex/local_faces.hpp"
#include "derham/forms/form.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/operators/minors.hpp"
#include "derham/operators/simplex_frame.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

// Internal to this room.
namespace derham::detail {

/// The sets of `count` of the local vertices 0, …, n as masks.
template <int n, int count>
constexpr auto masks_of() noexcept {
  std::array<unsigned, static_cast<std::size_t>(binomial(n + 1, count))> result{};
  for (unsigned mask = 0, i = 0; mask <= full_mask<n>; ++mask)
    if (std::popcount(mask) == count) result[i++] = mask;
  return result;
}

/// (-1)^(place of v among the vertices of mask).
constexpr int place_sign(unsigned mask, int v) noexcept {
  return std::popcount(mask & ((1U << v) - 1)) % 2 == 0 ? 1 : -1;
}

/// A Whitney k-form on one top simplex. With dλ_S the wedge of the dλ_v over a set S of k vertices, it is
/// k! Σ_S Σ_{v not in S} ± λ_v w(S ∪ v) dλ_S.
template <int n, int k>
class WhitneySimplex {
 public:
  explicit WhitneySimplex(int d)
      : frame_(d), columns_(subsets<k>(d)), gradients_(static_cast<std::size_t>((n + 1) * d)),
        wedge_(sets.size() * columns_.size()) {}

  /// Number of components, C(d, k).
  [[nodiscard]] std::size_t components() const noexcept { return columns_.size(); }

  void set(const Geometry<n>& geometry, const PrimalForm<n, k>& w, Index t) {
    const auto& K = w.complex();
    const auto index = face_indices(K, t);
    for (const unsigned face : masks_of<n, k + 1>()) value_[face] = w[index[face]] * K.sign(k, index[face]);
    set(geometry.corners(K, t));
  }

  /// The simplex alone, for `weights`.
  void set(const std::array<const double*, n + 1>& corners) {
    frame_.set(corners);
    const std::size_t d = gradients_.size() / (n + 1);
    for (std::size_t v = 0; v <= n; ++v)
      for (std::size_t c = 0; c < d; ++c) gradients_[v * d + c] = frame_.gradient(v, c);
    for (std::size_t s = 0; s < sets.size(); ++s) {
      std::array<const double*, static_cast<std::size_t>(k)> rows{};
      for (std::size_t v = 0, i = 0; v <= n; ++v)
        if ((sets[s] >> v) & 1U) rows[i++] = gradients_.data() + v * d;
      for (std::size_t c = 0; c < columns_.size(); ++c)
        wedge_[s * columns_.size() + c] = minor_of<k>(rows, columns_[c]);
    }
  }

  /// Its components where the barycentric coordinates are `lambda` (n+1,).
  void evaluate(const double* lambda, double* components) const noexcept {
    for (std::size_t c = 0; c < columns_.size(); ++c) components[c] = 0;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      double sum = 0;
      for (int v = 0; v <= n; ++v) {
        const unsigned face = sets[s] | (1U << v);
        if (face != sets[s]) sum += place_sign(face, v) * lambda[v] * value_[face];
      }
      sum *= static_cast<double>(factorial(k));
      for (std::size_t c = 0; c < columns_.size(); ++c) components[c] += sum * wedge_[s * columns_.size() + c];
    }
  }

  /// What the form is on k vectors is Σ weights[face] w(face): `minors` are the components of v_1 ∧ … ∧ v_k.
  void weights(const double* lambda, const double* minors, FaceArray<n, double>& weights) const noexcept {
    for (const unsigned face : masks_of<n, k + 1>()) weights[face] = 0;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      double value = 0;
      for (std::size_t c = 0; c < columns_.size(); ++c) value += wedge_[s * columns_.size() + c] * minors[c];
      value *= static_cast<double>(factorial(k));
      for (int v = 0; v <= n; ++v) {
        const unsigned face = sets[s] | (1U << v);
        if (face != sets[s]) weights[face] += place_sign(face, v) * lambda[v] * value;
      }
    }
  }

  [[nodiscard]] const SimplexFrame<n>& frame() const noexcept { return frame_; }

 private:
  static constexpr auto sets = masks_of<n, k>();

  SimplexFrame<n> frame_;
  std::vector<std::array<int, static_cast<std::size_t>(k)>> columns_;
  std::vector<double> gradients_;  // (n+1, d)
  std::vector<double> wedge_;      // (sets, components)
  FaceArray<n, double> value_{};   // of the k-faces
};

}  // namespace derham::detail
