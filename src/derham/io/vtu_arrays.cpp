#include "derham/io/vtu_arrays.hpp"

#include "derham/core/text.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>

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
  const auto size = count * components * width;
  ByteStream stream = stream_of(array);
  if (size == 0) {
    NumberArray none(document_.file(), std::string_view(), *type, swap_, 0);
    return use(none);
  }
  if (is_compressed_)
    read_compressed(array, stream, size, *type, use);
  else
    read_plain(array, stream, size, *type, use);
  demand_end(array, stream);
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

ByteStream VtuArrays::stream_of(const xml_node& array) {
  const std::string_view format = array.attribute("format").value();
  if (format == "binary") return {document_.text_of(array), true};
  if (format != "appended")
    document_.fail_at(array, text("format is ", quoted_token(format), ", expected ascii, binary or appended"));
  const auto appended = document_.appended();
  const auto at = document_.number(array, "offset", -1);
  if (at > static_cast<std::int64_t>(appended.size()))
    document_.fail_at(array, text("offset is ", at, ", but there are ", appended.size(), " bytes of appended data"));
  return {appended.substr(static_cast<std::size_t>(at)), appended_is_base64_};
}

// Between its tags an array is alone; appended it ends where the next one may begin.
void VtuArrays::demand_end(const xml_node& array, ByteStream& stream) {
  if (std::string_view(array.attribute("format").value()) == "appended") {
    const auto at = document_.number(array, "offset", -1);
    return demand_unshared(array, at, at + stream.offset());
  }
  if (!stream.at_end())
    document_.fail_at(
        static_cast<std::size_t>(document_.text_of(array).data() - document_.whole().data() + stream.offset()),
        "the array goes on after its last number");
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

// A header says how many bytes there are; they follow.
void VtuArrays::read_plain(const xml_node& array, ByteStream& stream, std::int64_t size, NumberType type,
                           const Use& use) {
  const auto announced = header_words(array, stream, 1)[0];
  if (announced != size) fail(array, text("has ", announced, " bytes, expected ", size));
  const auto refuse = [&] { fail(array, text("its ", size, " bytes are cut short or are not base64")); };
  if (size > stream.bound()) refuse();
  document_.stand_at(array);
  std::string room;
  std::string_view data;
  if (!stream.is_base64()) {
    if (!stream.take(size, room, data)) refuse();
    NumberArray numbers(document_.file(), data, type, swap_, data.data() - document_.whole().data());
    return use(numbers);
  }
  constexpr std::int64_t most_at_once = 3 << 16;
  auto left = size;
  NumberArray numbers(
      document_.file(),
      [&] {
        const auto next = std::min(left, most_at_once);
        if (!stream.take(next, room, data)) refuse();
        left -= next;
        return data;
      },
      type, swap_);
  use(numbers);
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

// The header of compressed data: the number of blocks, the size of each, of the last one (0: like the others).
VtuArrays::ZlibBlocks VtuArrays::zlib_blocks(const xml_node& array, ByteStream& stream, std::int64_t size) {
  const auto first = header_words(array, stream, 3);
  const auto blocks = first[0], block_size = first[1], last_size = first[2];
  const auto overflow = std::numeric_limits<std::int64_t>::max() / largest_ratio;
  if (blocks < 1 || block_size < 1 || last_size < 0 || last_size > block_size || block_size > overflow / blocks ||
      (blocks - (last_size > 0 ? 1 : 0)) * block_size + last_size != size)
    fail(array, text("has ", blocks, " blocks of ", block_size, " bytes and one of ", last_size, "; expected ", size,
                     " bytes in all"));
  auto sizes = header_words(array, stream, blocks);
  std::int64_t compressed = 0;
  for (const auto s : sizes) {
    if (s < 0 || s > stream.bound() - compressed) fail(array, "its blocks are cut short");
    compressed += s;
  }
  if (size / largest_ratio > compressed) fail(array, text(compressed, " compressed bytes cannot become ", size));
  return {block_size, std::move(sizes)};
}

void VtuArrays::read_compressed(const xml_node& array, ByteStream& stream, std::int64_t size, NumberType type,
                                const Use& use) {
  const auto blocks = zlib_blocks(array, stream, size);
  document_.stand_at(array);
  std::string packed_room, unpacked;
  std::string_view packed;
  std::size_t block = 0, used = 0;
  // Appends what the next block becomes.
  const auto unpack = [&] {
    const auto expected = std::min(blocks.size, size - static_cast<std::int64_t>(block) * blocks.size);
    if (!stream.take(blocks.compressed[block], packed_room, packed)) fail(array, "a block is not base64");
    const auto begin = unpacked.size();
    unpacked.resize(begin + static_cast<std::size_t>(expected));
    auto written = static_cast<uLongf>(expected);
    const int status = ::uncompress(reinterpret_cast<Bytef*>(unpacked.data() + begin), &written,
                                    reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    if (status != Z_OK || written != static_cast<uLongf>(expected))
      fail(array, text("block ", block, " is not ", expected, " bytes compressed by zlib"));
    ++block;
  };
  const auto width = static_cast<std::size_t>(byte_width(type));
  NumberArray numbers(
      document_.file(),
      [&] {
        unpacked.erase(0, used);  // what is left is a part of a number
        while (unpacked.size() < width) unpack();
        used = unpacked.size() / width * width;
        return std::string_view(unpacked).substr(0, used);
      },
      type, swap_);
  use(numbers);
}

}  // namespace derham
