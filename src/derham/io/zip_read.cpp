// This follows PKWARE, .ZIP File Format Specification (APPNOTE.TXT), 6.3.10.
#include "derham/io/zip_read.hpp"

#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"
#include "derham/core/types.hpp"
#include "derham/io/byte_order.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_set>

namespace derham {
namespace {

constexpr std::int64_t end_bytes = 22, locator_bytes = 20, directory_bytes = 46, local_bytes = 30;
constexpr std::uint32_t full32 = 0xffffffff;
constexpr std::uint16_t encrypted = 1, sizes_follow = 8;
constexpr std::uint16_t harmless_flags = 2 | 4 | sizes_follow | 0x800;  // the others change what the bytes mean
constexpr std::uint16_t stored = 0, deflated = 8;

template <class Number>
Number number(std::string_view bytes, std::int64_t at) {
  return load_number<Number>(bytes.data() + at, is_foreign_order(true));
}
std::int64_t u16(std::string_view bytes, std::int64_t at) { return number<std::uint16_t>(bytes, at); }
std::uint32_t u32(std::string_view bytes, std::int64_t at) { return number<std::uint32_t>(bytes, at); }
// Too large ones as the largest: they are refused where they are compared with the size of the file.
std::int64_t u64(std::string_view bytes, std::int64_t at) {
  constexpr auto largest = std::uint64_t{std::numeric_limits<std::int64_t>::max()};
  return static_cast<std::int64_t>(std::min(number<std::uint64_t>(bytes, at), largest));
}

// The 64-bit values of a zip64 extra field, which are there only for fields that are full.
class Wide {
 public:
  explicit Wide(std::string_view extra) {
    while (extra.size() >= 4) {
      const auto length = static_cast<std::size_t>(u16(extra, 2));
      if (length > extra.size() - 4) return;
      if (u16(extra, 0) == 1) rest_ = extra.substr(4, length);
      extra.remove_prefix(4 + length);
    }
  }
  std::int64_t take(std::uint32_t narrow) {
    if (narrow != full32 || rest_.size() < 8) return narrow;
    const auto value = u64(rest_, 0);
    rest_.remove_prefix(8);
    return value;
  }

 private:
  std::string_view rest_;
};

// CRC-32, of blocks at the same time.
std::uint32_t checksum(std::string_view bytes) {
  constexpr std::size_t block = std::size_t{1} << 20;
  const auto blocks = static_cast<Offset>((bytes.size() + block - 1) / block);
  std::vector<uLong> crc(static_cast<std::size_t>(blocks));
  const auto bytes_of = [&](Offset i) { return bytes.substr(static_cast<std::size_t>(i) * block, block); };
  parallel_blocks(blocks, 1, [&](Offset begin, Offset end) {
    for (Offset i = begin; i < end; ++i) {
      const auto part = bytes_of(i);
      crc[static_cast<std::size_t>(i)] =
          crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(part.data()), part.size());
    }
  });
  uLong all = crc32_z(0, nullptr, 0);
  for (Offset i = 0; i < blocks; ++i)
    all = crc32_combine(all, crc[static_cast<std::size_t>(i)], static_cast<z_off_t>(bytes_of(i).size()));
  return static_cast<std::uint32_t>(all);
}

}  // namespace

ZipArchive::ZipArchive(Cursor& file) : file_(file) {
  file.name_bytes(true);
  file.rewind(0);
  all_ = file.bytes(file.remaining(), "the archive");
  read_directory(find_directory());
}

void ZipArchive::fail(std::int64_t position, const std::string& message) {
  file_.rewind(std::clamp<std::int64_t>(position, 0, static_cast<std::int64_t>(all_.size())));
  file_.fail(message);
}

std::string_view ZipArchive::at(std::int64_t position, std::int64_t count, const char* what) {
  const auto size = static_cast<std::int64_t>(all_.size());
  if (position < 0 || position > size || count > size - position)
    fail(size, text("the file ends before the end of ", what, " at byte ", position));
  return all_.substr(static_cast<std::size_t>(position), static_cast<std::size_t>(count));
}

ZipArchive::Directory ZipArchive::find_directory() {
  const auto size = static_cast<std::int64_t>(all_.size());
  constexpr std::int64_t longest_comment = 0xffff;
  std::int64_t end = size - end_bytes;
  const auto is_end = [&] {
    const auto record = all_.substr(static_cast<std::size_t>(end));
    return u32(record, 0) == 0x06054b50 && end + end_bytes + u16(record, 20) == size;
  };
  while (end >= 0 && end >= size - end_bytes - longest_comment && !is_end()) --end;
  if (end < 0 || end < size - end_bytes - longest_comment)
    fail(size,
         "the file does not end with the directory of a zip archive; expected an .npz file of numpy: is it cut off?");
  const auto record = at(end, end_bytes, "the end record");
  const Directory directory{u32(record, 16), end, u16(record, 10)};
  if (directory.begin + std::int64_t{u32(record, 12)} != end) return find_directory_64(end);
  if (u16(record, 4) != 0 || u16(record, 6) != 0 || u16(record, 8) != directory.count)
    fail(end, "this is one part of an archive in several files; expected all in one");
  return directory;
}

ZipArchive::Directory ZipArchive::find_directory_64(std::int64_t end_record) {
  const auto locator_at = end_record - locator_bytes;
  if (locator_at < 0 || u32(at(locator_at, locator_bytes, "the zip64 locator"), 0) != 0x07064b50)
    fail(end_record, "the directory does not end where this record begins");
  const auto begin = u64(at(locator_at, locator_bytes, "the zip64 locator"), 8);
  const auto record = at(begin, 56, "the zip64 end record");
  if (u32(record, 0) != 0x06064b50 || u64(record, 4) != locator_at - begin - 12)
    fail(locator_at, text("there is no zip64 end record at byte ", begin, " that ends here"));
  const Directory directory{u64(record, 48), begin, u64(record, 32)};
  if (directory.begin > begin || u64(record, 40) != begin - directory.begin)
    fail(begin, "the directory does not end where this record begins");
  if (u32(record, 16) != 0 || u32(record, 20) != 0 || u64(record, 24) != directory.count)
    fail(begin, "this is one part of an archive in several files; expected all in one");
  return directory;
}

void ZipArchive::read_directory(const Directory& directory) {
  if (directory.count > (directory.end - directory.begin) / directory_bytes)
    fail(directory.begin, text("the number of entries is ", directory.count, ", but their directory has ",
                               directory.end - directory.begin, " bytes"));
  entries_.reserve(static_cast<std::size_t>(directory.count));
  std::unordered_set<std::string_view> names;
  auto position = directory.begin;
  for (std::int64_t i = 0; i < directory.count; ++i) {
    const auto record = at(position, directory_bytes, "the directory");
    if (u32(record, 0) != 0x02014b50)
      fail(position, text("entry ", i, " of the directory does not begin as it should"));
    const auto name_bytes = u16(record, 28), extra_bytes = u16(record, 30);
    Entry entry;
    entry.flags = number<std::uint16_t>(record, 8);
    entry.method = number<std::uint16_t>(record, 10);
    entry.crc = u32(record, 16);
    entry.name = at(position + directory_bytes, name_bytes, "a name");
    Wide wide(at(position + directory_bytes + name_bytes, extra_bytes, "an extra field"));
    entry.size = wide.take(u32(record, 24));
    entry.packed_size = wide.take(u32(record, 20));
    entry.header = wide.take(u32(record, 42));
    if (!names.insert(entry.name).second)
      fail(position, text("the entry ", quoted_token(entry.name), " is there twice"));
    check_local_header(entry, directory.begin);
    entries_.push_back(entry);
    position += directory_bytes + name_bytes + extra_bytes + u16(record, 32);
  }
  if (position != directory.end) fail(position, "the directory does not end with its last entry");

  std::vector<const Entry*> order;
  for (const auto& entry : entries_) order.push_back(&entry);
  std::ranges::sort(order, {}, &Entry::header);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (order[i]->header < order[i - 1]->data + order[i - 1]->packed_size)
      fail(order[i]->header,
           text("the entries ", quoted_token(order[i - 1]->name), " and ", quoted_token(order[i]->name), " overlap"));
}

void ZipArchive::check_local_header(Entry& entry, std::int64_t directory_begin) {
  const auto name = quoted_token(entry.name);
  if (entry.header < 0 || entry.header > directory_begin - local_bytes)
    fail(directory_begin, text("the entry ", name, " is said to be at byte ", entry.header));
  const auto record = at(entry.header, local_bytes, "an entry");
  if ((entry.flags & encrypted) != 0)
    fail(entry.header, text("the entry ", name, " is encrypted; expected an archive without a password"));
  if ((entry.flags & ~harmless_flags) != 0)
    fail(entry.header, text("the entry ", name, " has flags ", entry.flags, " that derham does not know"));
  if (entry.method != stored && entry.method != deflated)
    fail(entry.header, text("the entry ", name, " is compressed by method ", entry.method,
                            "; expected stored or deflated, as numpy.savez and savez_compressed write"));
  entry.data = entry.header + local_bytes + u16(record, 26) + u16(record, 28);
  const auto own_name = at(entry.header + local_bytes, u16(record, 26), "a name");
  Wide wide(at(entry.header + local_bytes + u16(record, 26), u16(record, 28), "an extra field"));
  const auto size = wide.take(u32(record, 22));
  const auto packed_size = wide.take(u32(record, 18));
  const bool is_later = (entry.flags & sizes_follow) != 0;
  const auto agrees = [is_later](std::int64_t here, std::int64_t there) {
    return here == there || (is_later && (here == 0 || here == full32));
  };
  if (u32(record, 0) != 0x04034b50 || own_name != entry.name || number<std::uint16_t>(record, 6) != entry.flags ||
      number<std::uint16_t>(record, 8) != entry.method || !agrees(u32(record, 14), entry.crc) ||
      !agrees(size, entry.size) || !agrees(packed_size, entry.packed_size))
    fail(entry.header, text("the entry ", name, " differs from what the directory says of it"));
  if (entry.packed_size > directory_begin - entry.data)
    fail(entry.header, text("the entry ", name, " has ", entry.packed_size, " bytes, but ",
                            std::max<std::int64_t>(directory_begin - entry.data, 0), " are there"));
  if (entry.method == stored ? entry.size != entry.packed_size : entry.size / 1032 > entry.packed_size)
    fail(entry.header, text("the entry ", name, " is said to have ", entry.size, " bytes, packed into ",
                            entry.packed_size, "; that cannot be"));
}

std::string_view ZipArchive::contents(const Entry& entry, std::unique_ptr<char[]>& unpacked) {
  const auto packed = at(entry.data, entry.packed_size, "an entry");
  auto bytes = packed;
  constexpr std::int64_t longest = 1 << 30;  // zlib counts in 32 bits
  if (entry.method == deflated) {
    unpacked = std::make_unique_for_overwrite<char[]>(static_cast<std::size_t>(entry.size) + 1);
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    std::int64_t in = 0, out = 0;
    int state = Z_OK;
    // One byte more than declared would be taken, to see that there is none.
    while (state == Z_OK && out <= entry.size) {
      const auto in_now = std::min(entry.packed_size - in, longest), out_now = std::min(entry.size + 1 - out, longest);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + in));
      stream.avail_in = static_cast<uInt>(in_now);
      stream.next_out = reinterpret_cast<Bytef*>(unpacked.get() + out);
      stream.avail_out = static_cast<uInt>(out_now);
      state = inflate(&stream, Z_NO_FLUSH);
      in += in_now - stream.avail_in;
      out += out_now - stream.avail_out;
    }
    inflateEnd(&stream);
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state != Z_STREAM_END || out != entry.size || in != entry.packed_size)
      fail(entry.data, text("the entry ", quoted_token(entry.name), " does not unpack to the ", entry.size,
                            " bytes it should have"));
    bytes = {unpacked.get(), static_cast<std::size_t>(entry.size)};
  }
  const auto crc = checksum(bytes);
  if (crc != entry.crc)
    fail(entry.data, text("the entry ", quoted_token(entry.name), " is damaged: its checksum is wrong"));
  return bytes;
}

}  // namespace derham
