#pragma once

#include "derham/core/types.hpp"

#include <bit>
#include <cstddef>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace derham {

/// As many numbers behind the one that is found may be read by `find_value`.
inline constexpr std::size_t find_value_margin = 16;

/// The first number from `begin` on that is `value`; there must be one. Of the few that are usually before it, sixteen are
/// compared at once: where a loop would end cannot be predicted.
inline const Index* find_value(const Index* begin, Index value) noexcept {
#ifdef __SSE2__
  if constexpr (sizeof(Index) == 4) {
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(value));
    for (;; begin += 16) {
      const auto equal = [&](int i) {
        return _mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(begin) + i), wanted);
      };
      const __m128i all = _mm_packs_epi16(_mm_packs_epi32(equal(0), equal(1)), _mm_packs_epi32(equal(2), equal(3)));
      const auto mask = static_cast<unsigned>(_mm_movemask_epi8(all));
      if (mask != 0) return begin + std::countr_zero(mask);
    }
  }
#endif
  while (*begin != value) ++begin;
  return begin;
}

}  // namespace derham
