#pragma once

#include <array>
#include <cstddef>
#include <cstring>

namespace derham {

/// How many of the first `count` of `values` are smaller than each of them: its place in sorted order if all are distinct.
/// Else the places add up to less than 0 + 1 + … + (count - 1). Internal to the room.
///
/// Always looks at all `capacity` values, 16 bytes of them at once: nothing but `count` decides where a branch goes.
template <int capacity, class T>
[[nodiscard]] std::array<T, capacity> counted_places(const T* values, std::size_t count) noexcept {
  constexpr std::size_t packs = capacity * sizeof(T) / 16;
  using Pack [[gnu::vector_size(16)]] = T;
  Pack value[packs], smaller[packs] = {};
  std::memcpy(value, values, sizeof value);
  for (std::size_t i = 0; i < count; ++i) {
    const Pack other = values[i] - Pack{};
    for (std::size_t j = 0; j < packs; ++j) smaller[j] -= value[j] > other;  // true is -1
  }
  std::array<T, capacity> result{};
  std::memcpy(result.data(), smaller, sizeof result);
  return result;
}

}  // namespace derham
