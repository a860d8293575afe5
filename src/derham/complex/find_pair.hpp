#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <ranges>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace derham {

/// As many pairs behind the last may be read by `find_pair`.
inline constexpr std::size_t find_pair_margin = 8;

/// Of the pairs begin to end - 1, in increasing order of their second entries, the first in which it is not less than `second`.
[[gnu::noinline, gnu::cold]] inline Index halve_for_pair(const Index* pairs, Index begin, Index end,
                                                         Index second) noexcept {
  return *std::ranges::lower_bound(std::views::iota(begin, end), second, {},
                                   [pairs](Index i) { return pairs[2 * static_cast<std::size_t>(i) + 1]; });
}

/// The number of the pair (first, second), which must be there: those that begin with v are bucket[v] to bucket[v + 1] - 1, in
/// increasing order. Of the few that are usually before it, eight are compared at once: where a loop would end cannot be
/// predicted. After 64 the rest is halved.
inline Index find_pair(const Index* pairs, const Index* bucket, Index first, Index second) noexcept {
  constexpr Index patience = 64;
  const Index begin = bucket[first];
  const Index* const from = pairs + 2 * static_cast<std::size_t>(begin);
  Index before = 0;
#ifdef __SSE2__
  if constexpr (sizeof(Index) == 4) {
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(second));
    for (; before < patience; before += 8) {
      const auto equal = [&](int i) {  // of four pairs
        const auto load = [&](int at) {
          return _mm_castsi128_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from + 2 * before) + at));
        };
        return _mm_cmpeq_epi32(_mm_castps_si128(_mm_shuffle_ps(load(i), load(i + 1), _MM_SHUFFLE(3, 1, 3, 1))), wanted);
      };
      const auto mask = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi32(equal(0), equal(2))));  // two bits each
      if (mask != 0) return begin + before + std::countr_zero(mask) / 2;
    }
  }
#endif
  for (; before < patience; ++before)
    if (from[2 * before + 1] == second) return begin + before;
  return halve_for_pair(pairs, begin + before, bucket[first + 1], second);
}

}  // namespace derham
