// This follows PKWARE, .ZIP File Format Specification (APPNOTE.TXT), 6.3.10.
#include "derham/io/zip_write.hpp"

#include "derham/io/byte_order.hpp"

#include <zlib.h>

namespace derham {
namespace {

constexpr std::int64_t alignment = 64;
constexpr std::int64_t version_64 = 45;   // of the specification that has zip64
constexpr std::int64_t first_day = 0x21;  // 1980-01-01: the same mesh makes the same file

// What numpy would otherwise take for a code page of 1981.
bool is_utf8(std::string_view bytes) noexcept {
  std::size_t more = 0;
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    if (more > 0) {
      if ((code & 0xc0) != 0x80) return false;
      --more;
    } else if (code >= 0x80) {
      more = code >= 0xc2 && code <= 0xdf ? 1 : code >= 0xe1 && code <= 0xec ? 2 : code >= 0xf1 && code <= 0xf3 ? 3 : 0;
      if (more == 0) return false;
    }
  }
  return more == 0;
}

std::int64_t flags_of(std::string_view name) noexcept { return is_utf8(name) ? 0x800 : 0; }

}  // namespace

template <class Number>
void ZipWriter::put(std::int64_t value) {
  file_.put_bytes(static_cast<Number>(value), is_foreign_order(true));
  written_ += static_cast<std::int64_t>(sizeof(Number));
}

void ZipWriter::add(const std::string& name, std::string_view head, std::string_view body) {
  Entry entry{name, written_, static_cast<std::int64_t>(head.size() + body.size()), 0};
  uLong crc = crc32_z(0, nullptr, 0);
  for (const auto bytes : {head, body})
    if (!bytes.empty()) crc = crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  entry.crc = static_cast<std::uint32_t>(crc);

  const bool is_wide = entry.size >= full_;
  const auto name_bytes = static_cast<std::int64_t>(name.size());
  const std::int64_t wide_bytes = is_wide ? 20 : 0;
  // The extra field 0xd935 holds nothing but zeros: it moves the contents to a multiple of the alignment.
  const auto unaligned = written_ + 30 + name_bytes + wide_bytes + 4;
  const auto padding = (alignment - unaligned % alignment) % alignment;

  put<std::uint32_t>(0x04034b50);
  put<std::uint16_t>(version_64);
  put<std::uint16_t>(flags_of(name));
  put<std::uint16_t>(0);  // stored
  put<std::uint16_t>(0);
  put<std::uint16_t>(first_day);
  put<std::uint32_t>(entry.crc);
  put<std::uint32_t>(narrow(entry.size));
  put<std::uint32_t>(narrow(entry.size));
  put<std::uint16_t>(name_bytes);
  put<std::uint16_t>(wide_bytes + 4 + padding);
  file_.put(name);
  written_ += name_bytes;
  if (is_wide) {
    put<std::uint16_t>(1);
    put<std::uint16_t>(16);
    put<std::uint64_t>(entry.size);
    put<std::uint64_t>(entry.size);
  }
  put<std::uint16_t>(0xd935);
  put<std::uint16_t>(padding);
  for (std::int64_t i = 0; i < padding; ++i) put<std::uint8_t>(0);
  file_.put(head).put(body);
  written_ += entry.size;
  entries_.push_back(std::move(entry));
}

void ZipWriter::finish() {
  const auto directory = written_;
  for (const auto& entry : entries_) {
    const std::int64_t wide_bytes = (entry.size >= full_ ? 16 : 0) + (entry.header >= full_ ? 8 : 0);
    put<std::uint32_t>(0x02014b50);
    put<std::uint16_t>(version_64);
    put<std::uint16_t>(version_64);
    put<std::uint16_t>(flags_of(entry.name));
    put<std::uint16_t>(0);
    put<std::uint16_t>(0);
    put<std::uint16_t>(first_day);
    put<std::uint32_t>(entry.crc);
    put<std::uint32_t>(narrow(entry.size));
    put<std::uint32_t>(narrow(entry.size));
    put<std::uint16_t>(static_cast<std::int64_t>(entry.name.size()));
    put<std::uint16_t>(wide_bytes > 0 ? wide_bytes + 4 : 0);
    put<std::uint16_t>(0);
    put<std::uint16_t>(0);
    put<std::uint16_t>(0);
    put<std::uint32_t>(0);
    put<std::uint32_t>(narrow(entry.header));
    file_.put(entry.name);
    written_ += static_cast<std::int64_t>(entry.name.size());
    if (wide_bytes == 0) continue;
    put<std::uint16_t>(1);
    put<std::uint16_t>(wide_bytes);
    if (entry.size >= full_) {
      put<std::uint64_t>(entry.size);
      put<std::uint64_t>(entry.size);
    }
    if (entry.header >= full_) put<std::uint64_t>(entry.header);
  }
  const auto end = written_;
  const auto count = static_cast<std::int64_t>(entries_.size());
  const bool is_wide = directory >= full_ || end - directory >= full_ || count >= 0xffff;
  if (is_wide) {
    put<std::uint32_t>(0x06064b50);
    put<std::uint64_t>(44);
    put<std::uint16_t>(version_64);
    put<std::uint16_t>(version_64);
    put<std::uint32_t>(0);
    put<std::uint32_t>(0);
    put<std::uint64_t>(count);
    put<std::uint64_t>(count);
    put<std::uint64_t>(end - directory);
    put<std::uint64_t>(directory);
    put<std::uint32_t>(0x07064b50);
    put<std::uint32_t>(0);
    put<std::uint64_t>(end);
    put<std::uint32_t>(1);
  }
  put<std::uint32_t>(0x06054b50);
  put<std::uint16_t>(0);
  put<std::uint16_t>(0);
  put<std::uint16_t>(is_wide ? 0xffff : count);
  put<std::uint16_t>(is_wide ? 0xffff : count);
  put<std::uint32_t>(is_wide ? 0xffffffff : end - directory);
  put<std::uint32_t>(is_wide ? 0xffffffff : directory);
  put<std::uint16_t>(0);
}

}  // namespace derham
