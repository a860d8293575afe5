#include "derham/io/vtu_arrays.hpp"

#include "derham/core/text.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <limits>
#include <optional>

namespace derham {
namespace {

using pugi::xml_node;

std::optional<NumberType> number_type(std::string_view name) {
  constexpr std::array<std::string_view, 10> names{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                   "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  const auto* const found = std::ranges::find(names, name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<NumberType>(found - names.begin()));
}

std::string quoted_name(const xml_node& array) { return quoted_token(array.attribute("Name").value()); }

}  // namespace

VtuArrays::VtuArrays(const VtuDocument& document) : document_(document) {
  const auto root = document_.root();
  const auto refuse = [&](const xml_node& node, const auto&... message) { document_.fail_at(node, text(message...)); };
  const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    refuse(root, "byte_order is ", quoted_token(order), ", expected LittleEndian or BigEndian");
  swap_ = (order == "LittleEndian") != (std::endian::native == std::endian::little);
  const std::string_view header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64")
    refuse(root, "header_type is ", quoted_token(header), ", expected UInt32 or UInt64");
  header_type_ = header == "UInt32" ? NumberType::uint32 : NumberType::uint64;
  const std::string_view compressor = root.attribute("compressor").value();
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    refuse(root, "the data are compressed by ", quoted_token(compressor),
           "; expected vtkZLibDataCompressor: write the file with zlib or without compression");
  is_compressed_ = !compressor.empty();
  const auto appended = root.child("AppendedData");
  const std::string_view encoding = appended.attribute("encoding").as_string("base64");
  if (appended && encoding != "raw" && encoding != "base64")
    refuse(appended, "the encoding is ", quoted_token(encoding), ", expected raw or base64");
  appended_is_base64_ = encoding == "base64";
  if (appended && !appended_is_base64_) document_.file().name_bytes(true);
}

void VtuArrays::fail(const xml_node& array, const std::string& message) const {
  document_.fail_at(array, text("array ", quoted_name(array), ": ", message));
}

void VtuArrays::read(const xml_node& array, Offset count, Offset components, const Use& use) {
  const std::string_view type_name = array.attribute("type").value();
  const auto type = number_type(type_name);
  if (!type)
    document_.fail_at(
        array, text("an array of type ", quoted_token(type_name), "; expected Int8 to UInt64, Float32 or Float64"));
  if (std::string_view(array.attribute("format").as_string("ascii")) == "ascii")
    return read_text(array, count, components, *type, use);
  const Offset width = byte_width(*type);
  if (count > std::numeric_limits<Offset>::max() / largest_ratio / width / components)
    fail(array, text(count, " times ", components, " numbers are more than a file can hold"));
  std::string room;
  const auto data = bytes(array, count * components * width, room);
  const bool is_in_file = room.empty() && !data.empty();
  document_.stand_at(array);
  NumberArray numbers(document_.file(), data, *type, swap_, is_in_file ? data.data() - document_.whole().data() : -1);
  use(numbers);
}

void VtuArrays::read_text(const xml_node& array, Offset count, Offset components, NumberType type, const Use& use) {
  const auto numbers = document_.text_of(array);
  if (count > static_cast<Offset>(numbers.size() + 1) / 2 / components)
    document_.fail_at(array, text("the array ", quoted_name(array), " of ", count, " times ", components,
                                  " numbers has only ", numbers.size(), " bytes of text"));
  const auto whole = document_.whole();
  const auto begin = static_cast<std::size_t>(numbers.data() - whole.data());
  Cursor part(whole.substr(0, begin + numbers.size()), document_.file().name(), Cursor::no_comment);
  part.rewind(static_cast<std::int64_t>(begin));
  NumberArray text_array(part, type);
  use(text_array);
  if (part.next_line()) part.fail_token("the end of the array", nullptr);
}

// The bytes of an array, which are in the file or in `room`.
std::string_view VtuArrays::bytes(const xml_node& array, std::int64_t size, std::string& room) {
  const std::string_view format = array.attribute("format").value();
  if (format == "binary") {
    const auto encoded = document_.text_of(array);
    ByteStream stream(encoded, true);
    const auto data = take(array, stream, size, room);
    if (size > 0 && !stream.at_end())
      document_.fail_at(static_cast<std::size_t>(encoded.data() - document_.whole().data() + stream.offset()),
                        "the array goes on after its last number");
    return data;
  }
  if (format != "appended")
    document_.fail_at(array, text("format is ", quoted_token(format), ", expected ascii, binary or appended"));
  const auto appended = document_.appended();
  const auto at = document_.number(array, "offset", -1);
  if (at > static_cast<std::int64_t>(appended.size()))
    document_.fail_at(array, text("offset is ", at, ", but there are ", appended.size(), " bytes of appended data"));
  ByteStream stream(appended.substr(static_cast<std::size_t>(at)), appended_is_base64_);
  const auto data = take(array, stream, size, room);
  demand_unshared(array, at, at + stream.offset());
  return data;
}

// Arrays that share bytes could take memory out of all proportion to the file.
void VtuArrays::demand_unshared(const xml_node& array, std::int64_t begin, std::int64_t end) {
  if (begin == end) return;
  const auto next = taken_.lower_bound(begin);
  if ((next != taken_.end() && next->first < end) || (next != taken_.begin() && std::prev(next)->second > begin))
    document_.fail_at(array, text("the array ", quoted_name(array),
                                  " shares its bytes with another; expected every array on its own"));
  taken_.emplace(begin, end);
}

// A header says how many bytes there are; they follow, perhaps in compressed blocks.
std::string_view VtuArrays::take(const xml_node& array, ByteStream& stream, std::int64_t size, std::string& room) {
  std::string_view data;
  if (size == 0) return data;
  if (is_compressed_) {
    inflate(array, stream, size, room);
    return room;
  }
  const auto announced = header_words(array, stream, 1)[0];
  if (announced != size) fail(array, text("has ", announced, " bytes, expected ", size));
  if (!stream.take(size, room, data)) fail(array, text("its ", size, " bytes are cut short or are not base64"));
  return data;
}

std::vector<std::int64_t> VtuArrays::header_words(const xml_node& array, ByteStream& stream, std::int64_t count) {
  std::string room;
  std::string_view header;
  const auto width = byte_width(header_type_);
  if (count > stream.bound() / width || !stream.take(count * width, room, header))
    fail(array, "its header is cut short or is not base64");
  std::vector<std::int64_t> words;
  with_numbers(header, header_type_, swap_, [&](auto numbers) {
    for (std::int64_t i = 0; i < count; ++i)
      words.push_back(static_cast<std::int64_t>(numbers[static_cast<std::size_t>(i)]));
  });
  return words;
}

void VtuArrays::inflate(const xml_node& array, ByteStream& stream, std::int64_t size, std::string& room) {
  // The number of blocks, the size of each, of the last one (0: like the others).
  const auto first = header_words(array, stream, 3);
  const auto blocks = first[0], block_size = first[1], last_size = first[2];
  const auto overflow = std::numeric_limits<std::int64_t>::max() / largest_ratio;
  if (blocks < 1 || block_size < 1 || last_size < 0 || last_size > block_size || block_size > overflow / blocks ||
      (blocks - (last_size > 0 ? 1 : 0)) * block_size + last_size != size)
    fail(array, text("has ", blocks, " blocks of ", block_size, " bytes and one of ", last_size, "; expected ", size,
                     " bytes in all"));
  const auto sizes = header_words(array, stream, blocks);
  std::int64_t compressed = 0;
  for (const auto s : sizes) {
    if (s < 0 || s > stream.bound() - compressed) fail(array, "its blocks are cut short");
    compressed += s;
  }
  if (size / largest_ratio > compressed) fail(array, text(compressed, " compressed bytes cannot become ", size));
  room.resize(static_cast<std::size_t>(size));
  std::string block_room;
  std::string_view block;
  for (std::int64_t i = 0; i < blocks; ++i) {
    const auto begin = i * block_size, end = std::min(begin + block_size, size);
    if (!stream.take(sizes[static_cast<std::size_t>(i)], block_room, block)) fail(array, "a block is not base64");
    auto written = static_cast<uLongf>(end - begin);
    const int status = ::uncompress(reinterpret_cast<Bytef*>(room.data() + begin), &written,
                                    reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
    if (status != Z_OK || written != static_cast<uLongf>(end - begin))
      fail(array, text("block ", i, " is not ", end - begin, " bytes compressed by zlib"));
  }
}

}  // namespace derham
