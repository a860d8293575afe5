#pragma once

#include "derham/io/text_writer.hpp"

#include <array>
#include <bit>
#include <cstdint>

namespace derham {

/// Writes the bytes of numbers, in the order of this machine, in base64.
class Base64Writer {
 public:
  explicit Base64Writer(TextWriter& file) : file_(file) {}

  template <class Number>
  void put(Number value) {
    for (const auto byte : std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(value)) {
      group_ = group_ << 8 | byte;
      if (++held_ == 3) put_group();
    }
  }

  /// Writes what is left. To be called once at the end.
  void finish() {
    if (held_ == 0) return;
    group_ <<= 8 * (3 - held_);
    put_group();
  }

 private:
  // Four characters of 6 bits, of which those that no byte reaches are padding.
  void put_group() {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < 4; ++i) file_.put(i <= held_ ? digits[group_ >> (18 - 6 * i) & 63U] : '=');
    group_ = 0;
    held_ = 0;
  }

  TextWriter& file_;
  std::uint32_t group_ = 0;  // the last `held_` bytes
  int held_ = 0;
};

}  // namespace derham
