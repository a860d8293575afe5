#pragma once

#include "derham/io/text_writer.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace derham {

/// Writes a zip archive of stored entries, each beginning at a multiple of 64 bytes so that it can be mapped. Not
/// installed.
class ZipWriter {
 public:
  /// Sizes and positions from `full` on are written as 64-bit numbers; only tests give another value.
  explicit ZipWriter(TextWriter& file, std::int64_t full = 0xffffffff) : file_(file), full_(full) {}

  /// Adds an entry: `head` and `body` one after the other.
  void add(const std::string& name, std::string_view head, std::string_view body);

  /// Writes the directory. Nothing can be added afterwards.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::int64_t header, size;
    std::uint32_t crc;
  };
  template <class Number>
  void put(std::int64_t value);
  [[nodiscard]] std::int64_t narrow(std::int64_t value) const noexcept { return value >= full_ ? 0xffffffff : value; }

  TextWriter& file_;
  std::int64_t full_, written_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace derham
