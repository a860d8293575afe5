#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace derham {

/// Bytes that stand in a text as they are or in base64; read from front to back, as far as they are asked for.
class ByteStream {
 public:
  /// In base64 blanks and line ends may stand anywhere, and padding may be followed by more: a file that encodes a header
  /// and its data one by one reads like one that encodes them together.
  ByteStream(std::string_view text, bool is_base64) noexcept : text_(text), is_base64_(is_base64) {}

  /// The next `count` bytes; `room` holds them where they had to be decoded. False if there are not so many, or they are
  /// not base64; `offset` then says where it ended.
  [[nodiscard]] bool take(std::int64_t count, std::string& room, std::string_view& bytes);

  [[nodiscard]] bool is_base64() const noexcept { return is_base64_; }

  /// No more bytes than this are left.
  [[nodiscard]] std::int64_t bound() const noexcept;

  /// Whether nothing is left but blanks.
  [[nodiscard]] bool at_end();

  /// Where in the text it stands.
  [[nodiscard]] std::int64_t offset() const noexcept { return static_cast<std::int64_t>(at_); }

 private:
  bool decode_group();
  void skip_blanks() noexcept;

  std::string_view text_;
  std::size_t at_ = 0;
  bool is_base64_;
  char group_[3] = {};  // decoded, but not taken yet: the last `left_` of the `group_size_`
  std::size_t left_ = 0, group_size_ = 0;
};

}  // namespace derham
