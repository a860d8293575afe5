#pragma once

#include "derham/core/text.hpp"
#include "derham/core/types.hpp"
#include "derham/geometry/mesh_data.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/number_block.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace derham {

/// An array of numbers of a VTK file: text, its first number the next token of `file`, or bytes.
class NumberArray {
 public:
  /// The bytes of the next numbers, at least of one and of none in part, until the next call. Asked for only as long as
  /// numbers are missing.
  using NextBytes = std::function<std::string_view()>;

  /// Text. The caller has checked that the rest of the file can hold the numbers.
  NumberArray(Cursor& file, NumberType type) : file_(file), type_(type) {}

  /// All bytes at once, which stand at `offset` in the file.
  NumberArray(Cursor& file, std::string_view bytes, NumberType type, bool swap, std::int64_t offset)
      : NumberArray(
            file, [bytes] { return bytes; }, type, swap) {
    offset_ = offset;
  }

  /// Bytes that are no part of the file as they are, piece by piece: so they need never be in memory as a whole.
  NumberArray(Cursor& file, NextBytes next, NumberType type, bool swap)
      : file_(file), is_text_(false), next_(std::move(next)), type_(type), swap_(swap) {}

  /// Calls `use(value)` for each of `count` integers; a value for which it returns false is refused, with `expected`.
  template <class Use>
  void integers(Offset count, const char* what, const char* expected, Use use) {
    if (is_real(type_)) fail(0, text(what, " is given as a real number; expected integers"));
    if (is_text_) {
      for (Offset i = 0; i < count; ++i) {
        (void)file_.next_line();
        const auto start = file_.offset();
        const auto value = next_integer(what);
        if (use(value)) continue;
        file_.rewind(start);
        file_.fail(text(what, " is ", value, ", ", expected));
      }
      return;
    }
    pieces(count, [&](Offset first, Offset size, auto numbers) {
      using Number = decltype(numbers[0]);
      if constexpr (std::is_integral_v<Number>)
        for (Offset i = 0; i < size; ++i) {
          // Beyond the range of 64 bits with sign it becomes negative, which nothing here may be.
          // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
          const auto value = static_cast<std::int64_t>(numbers[static_cast<std::size_t>(i)]);
          if (!use(value)) fail(first + i, text(what, " is ", value, ", ", expected));
        }
    });
  }

  /// Appends `count` vertex ids, each in [0, vertices).
  void ids(Offset count, Index vertices, std::vector<Index>& out);

  /// Appends `count` coordinates, all finite. Returns how many integers were rounded, because no double holds them.
  [[nodiscard]] Offset coordinates(Offset count, std::vector<double>& out) {
    return reals(count, "a coordinate", true, out);
  }

  /// As `coordinates`, but of a field, whose values may be infinite or NaN.
  [[nodiscard]] Offset values(Offset count, std::vector<double>& out) { return reals(count, "a value", false, out); }

  /// FileError at number i.
  [[noreturn]] void fail(Offset i, const std::string& message);

 private:
  // Calls `use(first, size, numbers)` for the numbers from `first` on, until it has been called for `count`.
  template <class Use>
  void pieces(Offset count, Use use) {
    for (Offset first = 0, size = 0; first < count; first += size) {
      const auto bytes = next_();
      size = std::min(count - first, static_cast<Offset>(bytes.size()) / byte_width(type_));
      with_numbers(bytes, type_, swap_, [&](auto numbers) { use(first, size, numbers); });
    }
  }

  [[nodiscard]] Offset reals(Offset count, const char* what, bool is_finite, std::vector<double>& out);

  // The next integer of a text, within the range of its type.
  [[nodiscard]] std::int64_t next_integer(const char* what);
  [[nodiscard]] std::uint64_t next_unsigned(const char* what);

  Cursor& file_;
  bool is_text_ = true;
  NextBytes next_;
  NumberType type_ = NumberType::float64;
  bool swap_ = false;
  std::int64_t offset_ = -1;  // of bytes in the file
};

/// Says in the notes how many integers of an array were rounded, if any.
void note_rounded(MeshData& mesh, std::string_view array, Offset count);

}  // namespace derham
