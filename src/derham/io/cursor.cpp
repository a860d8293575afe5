#include "derham/io/cursor.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace derham {

std::string quoted_token(std::string_view bytes) {
  constexpr std::size_t longest = 40;
  constexpr const char* digits = "0123456789abcdef";
  std::string out = "'";
  for (const char c : bytes.substr(0, longest)) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code < 0x7f)
      out += c;
    else
      out += {'\\', 'x', digits[code >> 4], digits[code & 15]};
  }
  return out + (bytes.size() > longest ? "…'" : "'");
}

void Cursor::skip_line() noexcept {
  if (at_ == end_) return;
  const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
  at_ = newline ? static_cast<const char*>(newline) : end_;
}

bool Cursor::skip_past_line(std::string_view line) noexcept {
  const char* const start = at_;
  while (next_line()) {
    if (token() == line) {
      at_ += line.size();
      if (at_line_end()) return true;
    }
    skip_line();
  }
  at_ = start;
  return false;
}

std::string_view Cursor::token() const noexcept {
  const char* end = at_;
  while (end != end_ && !is_blank(*end) && *end != '\n' && *end != comment_) ++end;
  return {at_, static_cast<std::size_t>(end - at_)};
}

std::string_view Cursor::word(const char* what) {
  if (at_line_end()) fail_token(what, nullptr);
  const auto found = token();
  at_ += found.size();
  return found;
}

Index Cursor::count(const char* what, std::int64_t record_bytes) {
  return checked_count(integer(what, 0, std::numeric_limits<std::int64_t>::max()), what, record_bytes);
}

Index Cursor::checked_count(std::int64_t value, const char* what, std::int64_t record_bytes) const {
  // The last record may lack its newline.
  if (value > (remaining() + 1) / record_bytes)
    fail(text(what, " is ", value, ", but the ", remaining(), " bytes that are left cannot hold so many"));
  if (value > std::numeric_limits<Index>::max() - 1)
    throw LimitError(text(name_, ": ", what, " is ", value,
                          ", more than this build's index type can number; build with DERHAM_INDEX64"));
  return static_cast<Index>(value);
}

std::string_view Cursor::bytes(std::int64_t count, const char* what) {
  if (count < 0 || count > remaining())
    fail(text(what, " takes ", count < 0 ? std::string("more bytes than a file can have") : text(count, " bytes"),
              ", but the file ends after ", remaining(), " more"));
  const char* const start = std::exchange(at_, at_ + count);
  return {start, static_cast<std::size_t>(count)};
}

void Cursor::fail(const std::string& message) const {
  if (names_bytes_) throw FileError(FileError::Action::read, name_, 0, text("byte ", offset(), ": ", message));
  // A file that ends with a newline ends on its last line, not on an empty one after it.
  const char* const end = at_ == end_ && at_ != begin_ && end_[-1] == '\n' ? end_ - 1 : at_;
  throw FileError(FileError::Action::read, name_, 1 + std::count(begin_, end, '\n'), message);
}

void Cursor::fail_token(const char* expected, const char* what) const {
  const auto found = token();
  const std::string description = !found.empty() ? quoted_token(found)
                                  : at_ == end_  ? "the end of the file"
                                                 : "the end of the line";
  fail(text("found ", description, ", expected ", expected, what ? " as " : "", what ? what : ""));
}

void Cursor::fail_number(std::errc error, bool integral, const char* what) const {
  if (error == std::errc::result_out_of_range)
    fail_token(integral ? "an integer of at most 64 bits" : "a number within the range of a double", what);
  fail_token(integral ? "an integer" : "a number", what);
}

void Cursor::fail_range(const char* what, std::int64_t value, std::int64_t lowest, std::int64_t highest) const {
  if (highest == std::numeric_limits<std::int64_t>::max())
    fail(text(what, " is ", value, ", expected at least ", lowest));
  if (highest < lowest) fail(text(what, " is ", value, ", but there are none"));
  fail(text(what, " is ", value, ", expected ", lowest, " to ", highest));
}

}  // namespace derham
