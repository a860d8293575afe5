#pragma once

#include "derham/core/text.hpp"
#include "derham/core/types.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/number_block.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

namespace derham {

/// An array of numbers of a VTK file: text, its first number the next token of `file`, or bytes, decoded already.
class NumberArray {
 public:
  /// Text. The caller has checked that the rest of the file can hold the numbers.
  NumberArray(Cursor& file, NumberType type) : file_(file), type_(type) {}

  /// Bytes; `offset` is where they stand in the file, for messages, or -1 if they are not part of it.
  NumberArray(Cursor& file, std::string_view bytes, NumberType type, bool swap, std::int64_t offset)
      : file_(file), is_text_(false), bytes_(bytes), type_(type), swap_(swap), offset_(offset) {}

  /// Calls `use(value)` for each of `count` integers; a value for which it returns false is refused, with `expected`.
  template <class Use>
  void integers(Offset count, const char* what, const char* expected, Use use) {
    if (is_real(type_)) fail(0, text(what, " is given as a real number; expected integers"));
    if (is_text_) {
      for (Offset i = 0; i < count; ++i) {
        (void)file_.next_line();
        const auto start = file_.offset();
        const auto value = file_.integer(what);
        if (use(value)) continue;
        file_.rewind(start);
        file_.fail(text(what, " is ", value, ", ", expected));
      }
      return;
    }
    with_numbers(bytes_, type_, swap_, [&](auto numbers) {
      using Number = decltype(numbers[0]);
      if constexpr (std::is_integral_v<Number>)
        for (Offset i = 0; i < count; ++i) {
          // Beyond the range of 64 bits with sign it becomes negative, which nothing here may be.
          // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
          const auto value = static_cast<std::int64_t>(numbers[static_cast<std::size_t>(i)]);
          if (!use(value)) fail(i, text(what, " is ", value, ", ", expected));
        }
    });
  }

  /// Appends `count` vertex ids, each in [0, vertices).
  void ids(Offset count, Index vertices, std::vector<Index>& out);

  /// Appends `count` coordinates, all finite.
  void coordinates(Offset count, std::vector<double>& out);

  /// Appends `count` values of a field. True if an integer was rounded, being beyond 2^53.
  [[nodiscard]] bool values(Offset count, std::vector<double>& out);

  /// FileError at number i.
  [[noreturn]] void fail(Offset i, const std::string& message);

 private:
  Cursor& file_;
  bool is_text_ = true;
  std::string_view bytes_;
  NumberType type_ = NumberType::float64;
  bool swap_ = false;
  std::int64_t offset_ = -1;
};

}  // namespace derham
