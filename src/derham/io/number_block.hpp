#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace derham {

/// A number that stands as bytes in a file.
enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// How many bytes a number takes.
constexpr std::int64_t byte_width(NumberType type) noexcept {
  constexpr std::int64_t widths[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return widths[static_cast<std::size_t>(type)];
}

constexpr bool is_real(NumberType type) noexcept { return type >= NumberType::float32; }

/// Numbers of one type at any address, in the byte order of this machine or the other one: block[i] is number i.
template <class Number, bool is_swapped>
class NumberBlock {
 public:
  explicit NumberBlock(const char* bytes) noexcept : bytes_(bytes) {}
  [[nodiscard]] Number operator[](std::size_t i) const noexcept {
    using Bits =
        std::conditional_t<sizeof(Number) == 1, std::uint8_t,
                           std::conditional_t<sizeof(Number) == 2, std::uint16_t,
                                              std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>>;
    Bits bits;
    std::memcpy(&bits, bytes_ + i * sizeof bits, sizeof bits);
    if constexpr (is_swapped && sizeof bits == 2) bits = __builtin_bswap16(bits);
    if constexpr (is_swapped && sizeof bits == 4) bits = __builtin_bswap32(bits);
    if constexpr (is_swapped && sizeof bits == 8) bits = __builtin_bswap64(bits);
    return std::bit_cast<Number>(bits);
  }

 private:
  const char* bytes_;
};

/// Whether a double holds this integer: 53 bits suffice from its highest to its lowest one.
template <std::integral Integer>
constexpr bool is_exact_double(Integer integer) noexcept {
  // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
  auto magnitude = static_cast<std::uint64_t>(integer);
  if (integer < 0) magnitude = 0 - magnitude;
  return magnitude == 0 || std::bit_width(magnitude) - std::countr_zero(magnitude) <= 53;
}

/// Calls `use` with a number of that type; what it does in a loop is then compiled for every type.
template <class Use>
auto with_number_type(NumberType type, Use&& use) {
  switch (type) {
    case NumberType::int8:
      return use(std::int8_t{});
    case NumberType::uint8:
      return use(std::uint8_t{});
    case NumberType::int16:
      return use(std::int16_t{});
    case NumberType::uint16:
      return use(std::uint16_t{});
    case NumberType::int32:
      return use(std::int32_t{});
    case NumberType::uint32:
      return use(std::uint32_t{});
    case NumberType::int64:
      return use(std::int64_t{});
    case NumberType::uint64:
      return use(std::uint64_t{});
    case NumberType::float32:
      return use(float{});
    default:
      return use(double{});
  }
}

/// Calls `use` with the block of numbers that `bytes` are.
template <class Use>
void with_numbers(std::string_view bytes, NumberType type, bool swap, Use&& use) {
  with_number_type(type, [&]<class Number>(Number) {
    if (swap && sizeof(Number) > 1)
      use(NumberBlock<Number, true>(bytes.data()));
    else
      use(NumberBlock<Number, false>(bytes.data()));
  });
}

}  // namespace derham
