#pragma once

#include "derham/core/cancel.hpp"
#include "derham/core/types.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace derham {

/// A strict, bounded walk over the lines and tokens of a text file held in memory. All mesh readers stand on it.
///
/// A record is one line; empty lines and comments (from the comment character to the end of the line) are skipped.
/// Blanks are space, tab, carriage return, form feed and vertical tab, so CRLF files and files without a final newline
/// read like any other; a byte order mark at the start is skipped. The line number is found only when an error needs
/// it. `what` names in every function what is expected there, for the message of the FileError.
class Cursor {
 public:
  /// For formats without comments.
  static constexpr char no_comment = '\n';

  /// `bytes` must outlive the cursor. `name` is the file's name in messages.
  Cursor(std::string_view bytes, std::string name, char comment)
      : begin_(bytes.data()), end_(bytes.data() + bytes.size()), at_(begin_), name_(std::move(name)),
        comment_(comment) {
    if (bytes.starts_with("\xef\xbb\xbf")) at_ += 3;
  }

  /// Moves to the first token of the next line that has one; stays if it stands on one. False at the end of the file.
  bool next_line() {
    if (++lines_met_ % 256 == 0) poll_cancel();
    while (at_line_end()) {
      if (at_ == end_) return false;
      if (*at_ == '\n')
        ++at_;
      else
        skip_line();
    }
    return true;
  }

  /// Whether the current line holds no further token.
  [[nodiscard]] bool at_line_end() noexcept {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    return at_ == end_ || *at_ == '\n' || *at_ == comment_;
  }

  /// The next token of the line as a decimal integer.
  std::int64_t integer(const char* what) {
    std::int64_t value = 0;
    accept(value, what);
    return value;
  }

  /// As `integer`, which must lie in [lowest, highest].
  std::int64_t integer(const char* what, std::int64_t lowest, std::int64_t highest) {
    const auto value = integer(what);
    if (value < lowest || value > highest) fail_range(what, value, lowest, highest);
    return value;
  }

  /// A number of records that follow, each of at least `record_bytes` bytes. Refused at once when the rest of the file
  /// cannot hold so many, so that nothing is ever reserved that the file does not fill. LimitError if it overflows
  /// Index.
  Index count(const char* what, std::int64_t record_bytes);

  /// As `count`, of a number that was read already, e.g. from bytes.
  Index checked_count(std::int64_t value, const char* what, std::int64_t record_bytes) const;

  /// The next token of the line as a finite real number; out of the range of a double is refused.
  double real(const char* what) {
    double value = 0;
    const char* const token = accept(value, what);
    if (!std::isfinite(value)) {
      at_ = token;
      fail_token("a finite number", what);
    }
    return value;
  }

  /// As `real`, but infinities and NaN are taken, too: for fields, where they stand for missing values.
  double real_or_nan(const char* what) {
    double value = 0;
    accept(value, what);
    return value;
  }

  /// The next token of the line, whatever it is.
  std::string_view word(const char* what);

  /// Demands that no token is left on the line.
  void end_line() {
    if (!at_line_end()) fail_token("the end of the line", nullptr);
  }

  /// Demands that no token is left in the file.
  void end_file() {
    if (next_line()) fail_token("the end of the file", nullptr);
  }

  /// Moves to the end of the current line.
  void skip_line() noexcept;

  /// Moves behind the next line that is exactly `line` (blanks around it allowed). False, without moving, if there is
  /// none.
  bool skip_past_line(std::string_view line) noexcept;

  /// The next `count` bytes as they are, e.g. a block of binary numbers. Refused if the file has fewer; a negative
  /// count, or one that would not fit, counts as more than the file has.
  std::string_view bytes(std::int64_t count, const char* what);

  /// From here on errors name the byte instead of the line (true), or the line again.
  void name_bytes(bool on) noexcept { names_bytes_ = on; }

  [[nodiscard]] std::int64_t remaining() const noexcept { return end_ - at_; }
  [[nodiscard]] std::int64_t offset() const noexcept { return at_ - begin_; }
  void rewind(std::int64_t offset) noexcept { at_ = begin_ + offset; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// FileError at the current line.
  [[noreturn]] void fail(const std::string& message) const;
  /// FileError that quotes the token at the cursor.
  [[noreturn]] void fail_token(const char* expected, const char* what) const;

 private:
  static bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); }

  // Returns the start of the token.
  template <class Number>
  const char* accept(Number& value, const char* what) {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const char* const token = at_;
    if constexpr (std::is_integral_v<Number>)
      if (accept_short(value)) return token;
    const char* start = at_;
    if constexpr (std::is_floating_point_v<Number>)  // from_chars takes no plus sign, some writers set it
      if (end_ - at_ > 1 && *at_ == '+' && at_[1] != '-') ++start;
    const auto [end, error] = std::from_chars(start, end_, value);
    if (error != std::errc() || (end != end_ && !is_blank(*end) && *end != '\n' && *end != comment_))
      fail_number(error, std::is_integral_v<Number>, what);
    at_ = end;
    return token;
  }

  // Nearly all integers are so short that they cannot overflow: no need of the checks in from_chars.
  bool accept_short(std::int64_t& value) noexcept {
    constexpr std::ptrdiff_t safe_digits = 18;
    const char* digit = at_;
    const bool is_negative = digit != end_ && *digit == '-';
    if (is_negative) ++digit;
    const char* const first = digit;
    const char* const stop = end_ - digit > safe_digits ? digit + safe_digits : end_;
    std::int64_t magnitude = 0;
    for (; digit != stop && *digit >= '0' && *digit <= '9'; ++digit) magnitude = 10 * magnitude + (*digit - '0');
    if (digit == first || (digit != end_ && !is_blank(*digit) && *digit != '\n' && *digit != comment_)) return false;
    value = is_negative ? -magnitude : magnitude;
    at_ = digit;
    return true;
  }

  [[noreturn]] void fail_number(std::errc error, bool integral, const char* what) const;
  [[noreturn]] void fail_range(const char* what, std::int64_t value, std::int64_t lowest, std::int64_t highest) const;
  [[nodiscard]] std::string_view token() const noexcept;

  const char *begin_, *end_, *at_;
  std::string name_;
  char comment_;
  bool names_bytes_ = false;
  unsigned lines_met_ = 0;
};

/// `bytes` in single quotes, at most 40 of them, everything but printable ASCII as \xNN: safe to print anywhere.
[[nodiscard]] std::string quoted_token(std::string_view bytes);

}  // namespace derham
