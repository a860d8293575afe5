#pragma once

#include "derham/core/types.hpp"
#include "derham/io/cursor.hpp"

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace derham {

/// A number of a binary file; `swap` if its byte order is not this machine's.
template <class Number>
[[nodiscard]] Number load(const char* bytes, bool swap) noexcept {
  using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
  static_assert(sizeof(Number) == sizeof(Bits));
  Bits bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  if (swap) {
    if constexpr (sizeof(Bits) == 8)
      bits = __builtin_bswap64(bits);
    else
      bits = __builtin_bswap32(bits);
  }
  return std::bit_cast<Number>(bits);
}

/// The numbers of a .msh file, whatever it is written in. Text is taken line by line (`next_record`, `end_record`), or
/// freely over the ends of lines (`free_layout`); bytes follow each other.
class GmshInput {
 public:
  /// Numbers of the types the format knows: int (32 bits), size_t (4 or 8 bytes) and double.
  explicit GmshInput(Cursor& cursor) : file(cursor) {}

  /// The section $MeshFormat behind its first line: says which of the formats the file is in.
  void read_header();

  [[nodiscard]] bool is_41() const noexcept { return is_41_; }
  [[nodiscard]] bool is_binary() const noexcept { return is_binary_; }
  [[nodiscard]] bool swaps() const noexcept { return swaps_; }
  /// Bytes of a size_t in a binary file.
  [[nodiscard]] int size_width() const noexcept { return size_width_; }

  std::int64_t integer(const char* what);
  std::int64_t integer(const char* what, std::int64_t lowest, std::int64_t highest);
  /// A number that is not negative, of type size_t.
  std::int64_t size(const char* what);
  double real(const char* what);
  /// Passes `count` doubles, which may be anything.
  void skip_reals(int count, const char* what);
  /// A number of records that follow, each of at least so many bytes (see Cursor::count); of type size_t.
  Index count(const char* what, std::int64_t text_bytes, std::int64_t binary_bytes);

  /// Text: moves to the next line that has a token, refuses the end of the file; `done` of `count` records are read.
  void next_record(const char* records, std::int64_t done, std::int64_t count) {
    if (!is_binary_ && !file.next_line()) fail_short(records, done, count);
  }
  void end_record() {
    if (!is_binary_) file.end_line();
  }
  /// Text: from now on numbers may stand on any line (true), or on one line per record again.
  void free_layout(bool on) noexcept { is_free_ = on; }

  /// The end of a line of text behind which bytes follow, if the file is binary.
  void end_line_before_bytes();

  /// The next size_t of a block of bytes.
  [[nodiscard]] std::int64_t load_size(const char* bytes) const noexcept {
    return size_width_ == 8 ? load<std::int64_t>(bytes, swaps_) : std::int64_t{load<std::uint32_t>(bytes, swaps_)};
  }

  [[noreturn]] void fail_short(const char* records, std::int64_t done, std::int64_t count) const;

  Cursor& file;

 private:
  void to_token() {
    if (is_free_) file.next_line();
  }
  bool is_41_ = false, is_binary_ = false, swaps_ = false, is_free_ = false;
  int size_width_ = 8;
};

}  // namespace derham
