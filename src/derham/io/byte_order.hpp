#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace derham {

/// Whether numbers of the given order must be turned around on this machine.
constexpr bool is_foreign_order(bool little_endian) noexcept {
  return little_endian != (std::endian::native == std::endian::little);
}

/// The number whose bytes begin at `at`, which need not be aligned; `swap`: in the order this machine does not have.
template <class Number>
[[nodiscard]] Number load_number(const char* at, bool swap = false) noexcept {
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(Number));
  if (swap) std::ranges::reverse(bytes);
  return std::bit_cast<Number>(bytes);
}

}  // namespace derham
