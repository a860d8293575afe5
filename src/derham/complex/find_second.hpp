#pragma once

#include "derham/core/types.hpp"

#include <bit>
#include <cstddef>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace derham {

/// As many pairs behind the one that is found may be read by `find_second`.
inline constexpr std::size_t find_second_margin = 8;

/// The number of the first pair whose second entry is `value`; there must be one. Of the few that are usually before it, eight
/// are compared at once: where a loop would end cannot be predicted.
inline Index find_second(const Index* pairs, Index value) noexcept {
  Index before = 0;
#ifdef __SSE2__
  if constexpr (sizeof(Index) == 4) {
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(value));
    for (;; before += 8, pairs += 16) {
      const auto equal = [&](int i) {  // of four pairs
        const auto load = [&](int at) {
          return _mm_castsi128_ps(_mm_loadu_si128(reinterpret_cast<const __m128i*>(pairs) + at));
        };
        return _mm_cmpeq_epi32(_mm_castps_si128(_mm_shuffle_ps(load(i), load(i + 1), _MM_SHUFFLE(3, 1, 3, 1))), wanted);
      };
      const auto mask = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi32(equal(0), equal(2))));  // two bits each
      if (mask != 0) return before + std::countr_zero(mask) / 2;
    }
  }
#endif
  while (pairs[2 * before + 1] != value) ++before;
  return before;
}

}  // namespace derham
