#pragma once

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"
#include "derham/operators/simplex_frame.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

// Internal to this room.
namespace derham::detail {

template <int n>
using Corners = std::array<const double*, static_cast<std::size_t>(n) + 1>;
template <int n>
using Barycentric = std::array<double, static_cast<std::size_t>(n) + 1>;

/// X at a point of top simplex t, written to `to`; x (d,) becomes the point.
/// Throws   InputError if X has not d components, or one is not finite
template <int n, class Field>
void evaluate_field(const SimplicialComplex<n>& K, Index t, const Field& X, const Corners<n>& corners,
                    const Barycentric<n>& lambda, std::span<double> x, double* to) {
  for (std::size_t c = 0; c < x.size(); ++c) {
    x[c] = 0;
    for (std::size_t v = 0; v <= n; ++v) x[c] += lambda[v] * corners[v][c];
  }
  const auto& value = X(std::span<const double>(x));
  if (value.size() != x.size()) throw InputError(text("a field of ", value.size(), " components; expected ", x.size()));
  for (std::size_t c = 0; c < x.size(); ++c) {
    to[c] = value[c];
    if (!std::isfinite(to[c]))
      throw InputError(text("component ", c, " of the vector field is ", to[c], " in ", simplex_text(K, n, t),
                            "; it must be finite on the whole complex"));
  }
}

/// X·∇λ_v: how fast the barycentric coordinates of a point change that moves with X (d,). Their sum is 0.
/// Units    1/time
template <int n>
[[nodiscard]] Barycentric<n> barycentric_rates(const SimplexFrame<n>& frame, std::span<const double> X) noexcept {
  Barycentric<n> rates{};
  for (std::size_t v = 0; v <= n; ++v)
    for (std::size_t c = 0; c < X.size(); ++c) rates[v] += X[c] * frame.gradient(v, c);
  return rates;
}

/// The rate at which all that is in the simplex is replaced.
template <int n>
[[nodiscard]] double through_flow(const Barycentric<n>& rates) noexcept {
  double sum = 0;
  for (const double rate : rates) sum += std::abs(rate);
  return sum / 2;
}

}  // namespace derham::detail
