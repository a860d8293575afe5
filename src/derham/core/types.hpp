#pragma once

#include <cstddef>
#include <cstdint>

namespace derham {

/// Position of a simplex in its list, and id of a vertex. 32 bits unless built with DERHAM_INDEX64.
#ifdef DERHAM_INDEX64
using Index = std::int64_t;
#else
using Index = std::int32_t;
#endif

/// Position in a long array (the row pointers of a table): never overflows where Index might.
using Offset = std::int64_t;

/// +1, -1, or 0 where there is no sign (a repeated vertex, an absent simplex).
using Sign = std::int8_t;

/// The largest dimension of a complex that the library is instantiated for.
inline constexpr int max_dimension = 6;

/// The binomial coefficient C(n, k); 0 outside 0 <= k <= n.
constexpr Offset binomial(int n, int k) noexcept {
  if (k < 0 || k > n) return 0;
  Offset value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

/// k! for 0 <= k <= 20.
constexpr Offset factorial(int k) noexcept { return k < 2 ? 1 : k * factorial(k - 1); }

}  // namespace derham
