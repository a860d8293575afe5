#pragma once

#include "derham/core/types.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

// Internal to the operators of boundary and hodge: a k-simplex and its k+1 faces, unrolled; and the columns of several
// vectors, in panels. Face j of the table omits vertex k-j and has the sign (-1)^(k-j).
namespace derham::detail {

/// -value or value, by the sign bit: exact, and cheaper than the conversion of a sign and a product.
[[nodiscard]] inline double negated_if(bool negative, double value) noexcept {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ static_cast<std::uint64_t>(negative) << 63);
}

/// Σ_j (-1)^(k-j) value(j), added up from j = 0.
template <int k, class Value>
[[nodiscard, gnu::always_inline]] inline double alternating_sum(Value&& value) {
  double sum = k % 2 == 0 ? value(0) : -value(0);
  [&]<int... j>(std::integer_sequence<int, j...>) __attribute__((always_inline)) {
    ((sum = (k - j) % 2 == 1 ? sum + value(j + 1) : sum - value(j + 1)), ...);
  }
  (std::make_integer_sequence<int, k>());
  return sum;
}

/// sum[j] += (-1)^(k-j) term for every face j; `place(j)` is where sum[j] is kept.
template <int k, int width, class Place>
[[gnu::always_inline]] inline void add_to_faces(const double (&term)[width], Place&& place) {
  const auto add = [&](int j, bool negative) __attribute__((always_inline)) {
    double* const sum = place(j);
    for (int q = 0; q < width; ++q) sum[q] = negative ? sum[q] - term[q] : sum[q] + term[q];
  };
  [&]<int... j>(std::integer_sequence<int, j...>) __attribute__((always_inline)) { (add(j, (k - j) % 2 == 1), ...); }
  (std::make_integer_sequence<int, k + 1>());
}

/// For each set of faces, as bits: all bits of a number for those that are in it, none for the others.
template <int k>
inline constexpr auto face_masks = [] {
  std::array<std::array<std::uint64_t, k + 1>, std::size_t{1} << (k + 1)> masks{};
  for (std::size_t set = 0; set < masks.size(); ++set)
    for (std::size_t j = 0; j <= k; ++j) masks[set][j] = (set >> j & 1U) != 0 ? ~std::uint64_t{0} : 0;
  return masks;
}();

/// As add_to_faces, but what is kept of a face that is not in the set `begun` counts as zero, whatever it is.
template <int k, int width, class Place>
[[gnu::always_inline]] inline void add_to_begun_faces(const double (&term)[width], std::uint8_t begun, Place&& place) {
  const auto& masks = face_masks<k>[begun];
  const auto add = [&](int j, bool negative) __attribute__((always_inline)) {
    double* const sum = place(j);
    for (int q = 0; q < width; ++q) {
      const auto so_far =
          std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum[q]) & masks[static_cast<std::size_t>(j)]);
      sum[q] = negative ? so_far - term[q] : so_far + term[q];
    }
  };
  [&]<int... j>(std::integer_sequence<int, j...>) __attribute__((always_inline)) { (add(j, (k - j) % 2 == 1), ...); }
  (std::make_integer_sequence<int, k + 1>());
}

/// Calls f with the degree k, low <= k <= high, as a constant that loops can be unrolled by.
template <int low, int high, class F>
void with_degree(int k, F&& f) {
  if constexpr (low <= high) {
    if (k == low)
      f(std::integral_constant<int, low>());
    else
      with_degree<low + 1, high>(k, f);
  }
}

/// Calls f with the number of columns, as a constant when there is one.
template <class F>
void with_columns(Index columns, F&& f) {
  if (columns == 1)
    f(std::integral_constant<Offset, 1>());
  else
    f(static_cast<Offset>(columns));
}

/// Calls f(c, width) for panels of columns c … c+width-1. The width is a constant, 4 or 1, so that a panel is kept in
/// registers and the loops over it are vectorised.
template <class Columns, class F>
[[gnu::always_inline]] inline void for_panels(Columns columns, F&& f) {
  constexpr int wide = 4;
  Offset c = 0;
  if constexpr (std::is_same_v<Columns, Offset>)
    for (; c + wide <= columns; c += wide) f(c, std::integral_constant<int, wide>());
  for (; c < columns; ++c) f(c, std::integral_constant<int, 1>());
}

}  // namespace derham::detail
