#include "derham/io/byte_stream.hpp"

#include <algorithm>
#include <array>

namespace derham {
namespace {

constexpr std::uint8_t no_digit = 64;

constexpr auto digit_table = [] {
  std::array<std::uint8_t, 256> table{};
  table.fill(no_digit);
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    table[static_cast<std::uint8_t>(digits[i])] = static_cast<std::uint8_t>(i);
  return table;
}();

unsigned digit(char c) noexcept { return digit_table[static_cast<std::uint8_t>(c)]; }
bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void ByteStream::skip_blanks() noexcept {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

bool ByteStream::decode_group() {
  std::array<char, 4> group{};
  for (char& c : group) {
    skip_blanks();
    if (at_ == text_.size()) return false;
    c = text_[at_++];
  }
  const std::size_t padding = group[3] != '=' ? 0 : group[2] != '=' ? 1 : 2;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const unsigned value = i + padding >= 4 ? 0 : digit(group[i]);
    if (value == no_digit) return false;
    bits = bits << 6 | value;
  }
  group_size_ = left_ = 3 - padding;
  for (std::size_t i = 0; i < 3; ++i) group_[i] = static_cast<char>(bits >> (16 - 8 * i));
  return true;
}

bool ByteStream::take(std::int64_t count, std::string& room, std::string_view& bytes) {
  if (count < 0 || count > bound()) return false;
  const auto size = static_cast<std::size_t>(count);
  if (!is_base64_) {
    bytes = text_.substr(at_, size);
    at_ += size;
    return true;
  }
  room.resize(size);
  std::size_t done = 0;
  while (done < size) {
    if (left_ == 0) {
      // Groups of four digits without blanks or padding, as long as there are any.
      while (size - done >= 3 && text_.size() - at_ >= 4) {
        const unsigned a = digit(text_[at_]), b = digit(text_[at_ + 1]), c = digit(text_[at_ + 2]),
                       d = digit(text_[at_ + 3]);
        if (((a | b | c | d) & no_digit) != 0) break;
        const std::uint32_t bits = a << 18 | b << 12 | c << 6 | d;
        room[done] = static_cast<char>(bits >> 16);
        room[done + 1] = static_cast<char>(bits >> 8);
        room[done + 2] = static_cast<char>(bits);
        done += 3;
        at_ += 4;
      }
      if (done == size) break;
      if (!decode_group()) return false;
    }
    while (left_ > 0 && done < size) room[done++] = group_[group_size_ - left_--];
  }
  bytes = room;
  return true;
}

std::int64_t ByteStream::bound() const noexcept {
  const auto rest = text_.size() - at_;
  return static_cast<std::int64_t>(is_base64_ ? left_ + rest / 4 * 3 : rest);
}

bool ByteStream::at_end() {
  if (is_base64_) skip_blanks();
  return at_ == text_.size() && left_ == 0;
}

}  // namespace derham
