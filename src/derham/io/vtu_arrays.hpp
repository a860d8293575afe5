#pragma once

#include "derham/core/types.hpp"
#include "derham/io/byte_stream.hpp"
#include "derham/io/number_array.hpp"
#include "derham/io/vtu_document.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// The arrays of a .vtu file. Not installed.
namespace derham {

/// Reads the arrays of a .vtu file: numbers as text, base64 or raw bytes, perhaps compressed.
class VtuArrays {
 public:
  /// zlib cannot do better: the most bytes that one compressed byte can become.
  static constexpr std::int64_t largest_ratio = 1032;

  /// Reads the attributes of the document that all arrays share.
  explicit VtuArrays(const VtuDocument& document);

  using Use = std::function<void(NumberArray&)>;
  /// Calls `use` with the array of `count` times `components` numbers.
  void read(const pugi::xml_node& array, Offset count, Offset components, const Use& use);

 private:
  using Node = pugi::xml_node;
  // The bytes of a compressed array: how many a block becomes, all but perhaps the last one, and those of every block.
  struct ZlibBlocks {
    std::int64_t size;
    std::vector<std::int64_t> compressed;
  };
  void read_text(const Node& array, Offset count, Offset components, NumberType type, const Use& use);
  [[nodiscard]] ByteStream stream_of(const Node& array);
  void read_plain(const Node& array, ByteStream& stream, std::int64_t size, NumberType type, const Use& use);
  void read_compressed(const Node& array, ByteStream& stream, std::int64_t size, NumberType type, const Use& use);
  void demand_end(const Node& array, ByteStream& stream);
  [[nodiscard]] std::vector<std::int64_t> header_words(const Node& array, ByteStream& stream, std::int64_t count);
  [[nodiscard]] ZlibBlocks zlib_blocks(const Node& array, ByteStream& stream, std::int64_t size);
  void demand_unshared(const Node& array, std::int64_t begin, std::int64_t end);
  [[noreturn]] void fail(const Node& array, const std::string& message) const;

  const VtuDocument& document_;
  std::map<std::int64_t, std::int64_t> taken_;  // begin and end of the appended arrays read so far
  bool swap_ = false, is_compressed_ = false, appended_is_base64_ = true;
  NumberType header_type_ = NumberType::uint32;
};

}  // namespace derham
