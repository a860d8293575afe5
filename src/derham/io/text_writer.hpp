#pragma once

#include "derham/io/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <concepts>
#include <memory>
#include <string_view>
#include <type_traits>

namespace derham {

/// Buffered text into an AtomicFile: integers and shortest doubles that read back to the same bits, locale-free; and
/// raw bytes for binary formats.
class TextWriter {
 public:
  explicit TextWriter(AtomicFile& file) : file_(file), buffer_(std::make_unique_for_overwrite<char[]>(capacity)) {}
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  /// Throws FileError if the file cannot be written; so do all `put`s.
  TextWriter& put(std::string_view bytes);
  TextWriter& put(char c) {
    make_room();
    buffer_[used_++] = c;
    return *this;
  }
  template <class Number>
    requires(std::integral<Number> || std::floating_point<Number>)
  TextWriter& put(Number value) {
    make_room();
    used_ = static_cast<std::size_t>(std::to_chars(&buffer_[used_], &buffer_[0] + capacity, value).ptr - &buffer_[0]);
    return *this;
  }

  /// The bytes of a number, in the order of this machine, or (`swap`) in the other one.
  template <class Number>
  TextWriter& put_bytes(Number value, bool swap = false) {
    static_assert(std::is_arithmetic_v<Number> && sizeof value <= longest_token);
    make_room();
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if (swap) std::ranges::reverse(bytes);
    std::ranges::copy(bytes, &buffer_[used_]);
    used_ += sizeof value;
    return *this;
  }

  /// Hands everything to the file. To be called once at the end.
  void flush();

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 16;
  static constexpr std::size_t longest_token = 32;
  void make_room() {
    if (used_ + longest_token > capacity) flush();
  }

  AtomicFile& file_;
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
};

}  // namespace derham
