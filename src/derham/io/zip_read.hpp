#pragma once

#include "derham/io/cursor.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// The zip archives that numpy writes. Not installed.
namespace derham {

/// The bytes of a zip archive in memory: entries stored or deflated, with or without zip64. Everything that is written
/// twice in an archive must agree; encrypted, overlapping and repeated entries are refused.
class ZipArchive {
 public:
  struct Entry {
    std::string_view name;
    std::int64_t header = 0;  ///< position of the local header
    std::int64_t data = 0;    ///< position of the first byte
    std::int64_t packed_size = 0, size = 0;
    std::uint32_t crc = 0;
    std::uint16_t flags = 0, method = 0;
  };

  /// Reads and checks the directory. `file` must outlive the archive. Throws FileError that names the byte.
  explicit ZipArchive(Cursor& file);

  [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }

  /// The bytes of an entry, verified by their checksum: of the file itself if the entry is stored, else in `unpacked`,
  /// which is never larger than 1032 times the packed bytes (deflate packs no better).
  [[nodiscard]] std::string_view contents(const Entry& entry, std::unique_ptr<char[]>& unpacked);

  /// FileError at a byte of the file.
  [[noreturn]] void fail(std::int64_t at, const std::string& message);

 private:
  struct Directory {
    std::int64_t begin, end, count;
  };
  [[nodiscard]] Directory find_directory();
  [[nodiscard]] Directory find_directory_64(std::int64_t end_record);
  void read_directory(const Directory& directory);
  void check_local_header(Entry& entry, std::int64_t directory_begin);
  [[nodiscard]] std::string_view at(std::int64_t position, std::int64_t count, const char* what);

  Cursor& file_;
  std::string_view all_;
  std::vector<Entry> entries_;
};

}  // namespace derham
