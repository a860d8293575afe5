#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/byte_stream.hpp"
#include "derham/io/formats.hpp"
#include "derham/io/number_array.hpp"
#include "derham/io/vtk_cells.hpp"

#include <zlib.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

using pugi::xml_node;

// zlib cannot do better: the most bytes that one compressed byte can become.
constexpr std::int64_t largest_ratio = 1032;

std::optional<NumberType> number_type(std::string_view name) {
  constexpr std::array<std::string_view, 10> names{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                   "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<NumberType>(found - names.begin()));
}

std::size_t trimmed_size(std::string_view bytes) {
  return bytes.find_last_not_of(" \t\r\n\f\v") + 1;  // npos + 1 is 0
}

class VtuReader {
 public:
  VtuReader(Cursor& file, const ReadOptions& options) : file_(file), options_(options) {
    file_.rewind(0);
    whole_ = file_.bytes(file_.remaining(), "the file");
  }

  MeshData read() && {
    parse();
    const auto root = document_.document_element();
    if (std::string_view(root.name()) != "VTKFile") fail_at(root, "found no element VTKFile");
    read_layout(root);
    const auto pieces = root.child("UnstructuredGrid");
    const auto piece = pieces.child("Piece");
    if (!piece) fail_at(pieces ? pieces : root, "the file has no Piece");
    if (const auto second = piece.next_sibling("Piece"))
      fail_at(second, "the file has several pieces; expected one: merge them first");
    for (const auto grid_data : {pieces.child("FieldData"), root.child("FieldData")})
      for (const auto array : grid_data.children())
        mesh_.notes.push_back(
            text("array ", quoted_token(array.attribute("Name").value()), " of the whole data set is not kept"));

    mesh_.ambient_dimension = 3;
    mesh_.vertex_count = item_count(piece, "NumberOfPoints");
    const Offset cells = item_count(piece, "NumberOfCells");
    read_points(only_child(piece, "Points"));
    read_cells(only_child(piece, "Cells"), cells);
    read_fields(piece.child("PointData"), MeshField::On::vertices, mesh_.vertex_count);
    read_fields(piece.child("CellData"), MeshField::On::rows, cells);
    stand_at(piece.child("Cells"));
    std::move(cells_).move_to(mesh_, options_, file_);
    return std::move(mesh_);
  }

 private:
  void stand_at(const xml_node& node) {
    const auto offset = node.offset_debug();
    file_.rewind(std::clamp<std::int64_t>(offset, 0, static_cast<std::int64_t>(whole_.size())));
  }
  [[noreturn]] void fail_at(const xml_node& node, const std::string& message) {
    stand_at(node);
    file_.fail(message);
  }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) {
    file_.rewind(static_cast<std::int64_t>(std::min(offset, whole_.size())));
    file_.fail(message);
  }

  // Appended data are no XML: what stands before them is parsed, closed by ourselves.
  void parse() {
    auto end = trimmed_size(whole_);
    const auto drop = [&](std::string_view tag) {
      if (!whole_.substr(0, end).ends_with(tag)) fail_at(end, text("the file does not end with ", tag));
      end -= tag.size();
    };
    drop("</VTKFile>");
    auto head = whole_;
    const auto tag = whole_.find("<AppendedData");
    const auto tag_end = whole_.find('>', tag);
    if (tag_end != std::string_view::npos && whole_[tag_end - 1] != '/') {
      end = trimmed_size(whole_.substr(0, end));
      drop("</AppendedData>");  // the bytes before it are data, also where they look like blanks
      const auto begin = whole_.find_first_not_of(" \t\r\n", tag_end + 1);
      if (begin == std::string_view::npos || begin >= end || whole_[begin] != '_')
        fail_at(tag_end, "the appended data do not begin with an underscore");
      appended_ = whole_.substr(begin + 1, end - begin - 1);
      head = whole_.substr(0, tag_end + 1);
    }
    constexpr std::ptrdiff_t most_tags = 1'000'000;
    if (std::ranges::count(head, '<') > most_tags)
      fail_at(0, text("the file has more than ", most_tags, " elements; expected few, with long arrays"));
    xml_ = head;
    if (head.size() < whole_.size()) xml_ += "</AppendedData></VTKFile>";
    const auto result =
        document_.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_escapes, pugi::encoding_utf8);
    if (!result)
      fail_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)),
              text("not well-formed XML: ", result.description()));
  }

  void read_layout(const xml_node& root) {
    const std::string_view type = root.attribute("type").value();
    if (type != "UnstructuredGrid")
      fail_at(root, text("this is a VTK file of type ", quoted_token(type), "; expected UnstructuredGrid"));
    const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian")
      fail_at(root, text("byte_order is ", quoted_token(order), ", expected LittleEndian or BigEndian"));
    swap_ = (order == "LittleEndian") != (std::endian::native == std::endian::little);
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64")
      fail_at(root, text("header_type is ", quoted_token(header), ", expected UInt32 or UInt64"));
    header_type_ = header == "UInt32" ? NumberType::uint32 : NumberType::uint64;
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      fail_at(root, text("the data are compressed by ", quoted_token(compressor),
                         "; expected vtkZLibDataCompressor: write the file with zlib or without compression"));
    is_compressed_ = !compressor.empty();
    const auto appended = root.child("AppendedData");
    const std::string_view encoding = appended.attribute("encoding").as_string("base64");
    if (appended && encoding != "raw" && encoding != "base64")
      fail_at(appended, text("the encoding is ", quoted_token(encoding), ", expected raw or base64"));
    appended_is_base64_ = encoding == "base64";
    if (appended && !appended_is_base64_) file_.name_bytes(true);
  }

  xml_node only_child(const xml_node& parent, const char* name) {
    const auto child = parent.child(name);
    if (!child) fail_at(parent, text("the piece has no element ", name));
    if (const auto second = child.next_sibling(name)) fail_at(second, text("a second element ", name));
    return child;
  }

  std::int64_t number(const xml_node& node, const char* name, std::int64_t usual) {
    const auto attribute = node.attribute(name);
    const std::string_view digits = attribute.value();
    if (!attribute && usual >= 0) return usual;
    std::int64_t value = -1;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < 0)
      fail_at(node, text(name, " is ", quoted_token(digits), ", expected a number that is not negative"));
    return value;
  }

  Index item_count(const xml_node& piece, const char* name) {
    const auto count = number(piece, name, -1);
    if (count / largest_ratio > static_cast<std::int64_t>(whole_.size()))
      fail_at(piece, text(name, " is ", count, ", but the file cannot hold so many"));
    if (count > std::numeric_limits<Index>::max() - 1)
      throw LimitError(text(file_.name(), ": ", name, " is ", count,
                            ", more than this build's index type can number; build with DERHAM_INDEX64"));
    return static_cast<Index>(count);
  }

  // Where the text of an element stands in the file; other elements may follow it.
  std::string_view text_of(const xml_node& array, std::size_t& begin) {
    for (const auto child : array.children())
      if (child.type() == pugi::node_pcdata) {
        begin = static_cast<std::size_t>(child.offset_debug());
        return whole_.substr(begin, whole_.find('<', begin) - begin);
      }
    begin = static_cast<std::size_t>(array.offset_debug());
    return {};
  }

  // Calls `use` with the array of `count` times `components` numbers.
  template <class Use>
  void with_array(const xml_node& array, Offset count, Offset components, Use use) {
    const std::string_view type_name = array.attribute("type").value();
    const auto type = number_type(type_name);
    if (!type)
      fail_at(array,
              text("an array of type ", quoted_token(type_name), "; expected Int8 to UInt64, Float32 or Float64"));
    const std::string_view format = array.attribute("format").as_string("ascii");
    std::size_t begin = 0;
    if (format == "ascii") {
      const auto numbers = text_of(array, begin);
      if (components > 0 && count > static_cast<Offset>(numbers.size() + 1) / 2 / components)
        fail_at(array, text("the array ", quoted_token(array.attribute("Name").value()), " of ", count, " times ",
                            components, " numbers has only ", numbers.size(), " bytes of text"));
      Cursor part(whole_.substr(0, begin + numbers.size()), file_.name(), Cursor::no_comment);
      part.rewind(static_cast<std::int64_t>(begin));
      NumberArray text_array(part, *type);
      use(text_array);
      if (part.next_line()) part.fail_token("the end of the array", nullptr);
      return;
    }

    std::string room;
    std::string_view data;
    std::int64_t offset = -1;
    if (format == "binary") {
      const auto encoded = text_of(array, begin);
      ByteStream stream(encoded, true);
      take(array, stream, count, components, *type, room, data);
      if (count > 0 && !stream.at_end())
        fail_at(begin + static_cast<std::size_t>(stream.offset()), "the array goes on after its last number");
    } else if (format == "appended") {
      const auto at = number(array, "offset", -1);
      if (at > static_cast<std::int64_t>(appended_.size()))
        fail_at(array, text("offset is ", at, ", but there are ", appended_.size(), " bytes of appended data"));
      ByteStream stream(appended_.substr(static_cast<std::size_t>(at)), appended_is_base64_);
      take(array, stream, count, components, *type, room, data);
      demand_unshared(array, at, at + stream.offset());
      if (!appended_is_base64_ && !is_compressed_) offset = data.data() - whole_.data();
    } else {
      fail_at(array, text("format is ", quoted_token(format), ", expected ascii, binary or appended"));
    }
    stand_at(array);
    NumberArray numbers(file_, data, *type, swap_, offset);
    use(numbers);
  }

  // Arrays that share bytes could take memory out of all proportion to the file.
  void demand_unshared(const xml_node& array, std::int64_t begin, std::int64_t end) {
    if (begin == end) return;
    const auto next = taken_.lower_bound(begin);
    if ((next != taken_.end() && next->first < end) || (next != taken_.begin() && std::prev(next)->second > begin))
      fail_at(array, text("the array ", quoted_token(array.attribute("Name").value()),
                          " shares its bytes with another; expected every array on its own"));
    taken_.emplace(begin, end);
  }

  // The bytes of an array: a header that says how many there are, then the bytes, perhaps in compressed blocks.
  void take(const xml_node& array, ByteStream& stream, Offset count, Offset components, NumberType type,
            std::string& room, std::string_view& data) {
    if (count == 0) return;
    const Offset width = byte_width(type);
    const auto fail = [&](const std::string& message) {
      fail_at(array, text("array ", quoted_token(array.attribute("Name").value()), ": ", message));
    };
    if (count > std::numeric_limits<Offset>::max() / largest_ratio / width / components)
      fail(text(count, " times ", components, " numbers are more than a file can hold"));
    const std::int64_t size = count * components * width;
    std::string header_room;
    std::string_view header;
    const auto header_words = [&](std::int64_t words) {
      std::vector<std::int64_t> out;
      if (words > stream.bound() / byte_width(header_type_) ||
          !stream.take(words * byte_width(header_type_), header_room, header))
        fail("its header is cut short or is not base64");
      with_numbers(header, header_type_, swap_, [&](auto numbers) {
        for (std::int64_t i = 0; i < words; ++i)
          out.push_back(static_cast<std::int64_t>(numbers[static_cast<std::size_t>(i)]));
      });
      return out;
    };
    if (!is_compressed_) {
      const auto announced = header_words(1)[0];
      if (announced != size) fail(text("has ", announced, " bytes, expected ", size));
      if (!stream.take(size, room, data)) fail(text("its ", size, " bytes are cut short or are not base64"));
      return;
    }

    const auto first = header_words(3);  // the number of blocks, the size of each, of the last one (0: like the others)
    const auto blocks = first[0], block_size = first[1], last_size = first[2];
    const auto overflow = std::numeric_limits<std::int64_t>::max() / largest_ratio;
    if (blocks < 1 || block_size < 1 || last_size < 0 || last_size > block_size || block_size > overflow / blocks ||
        (blocks - (last_size > 0 ? 1 : 0)) * block_size + last_size != size)
      fail(text("has ", blocks, " blocks of ", block_size, " bytes and one of ", last_size, "; expected ", size,
                " bytes in all"));
    const auto sizes = header_words(blocks);
    std::int64_t compressed = 0;
    for (const auto s : sizes) {
      if (s < 0 || s > stream.bound() - compressed) fail("its blocks are cut short");
      compressed += s;
    }
    if (size / largest_ratio > compressed) fail(text(compressed, " compressed bytes cannot become ", size));
    room.resize(static_cast<std::size_t>(size));
    std::string block_room;
    std::string_view block;
    for (std::int64_t i = 0; i < blocks; ++i) {
      const auto begin = i * block_size, end = std::min(begin + block_size, size);
      if (!stream.take(sizes[static_cast<std::size_t>(i)], block_room, block)) fail("a block is not base64");
      auto written = static_cast<uLongf>(end - begin);
      const int status = ::uncompress(reinterpret_cast<Bytef*>(room.data() + begin), &written,
                                      reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
      if (status != Z_OK || written != static_cast<uLongf>(end - begin))
        fail(text("block ", i, " is not ", end - begin, " bytes compressed by zlib"));
    }
    data = room;
  }

  void read_points(const xml_node& points) {
    const auto array = only_child(points, "DataArray");
    if (const auto components = number(array, "NumberOfComponents", 1); components != 3)
      fail_at(array, text("the points have ", components, " components, expected 3"));
    with_array(array, mesh_.vertex_count, 3, [&](NumberArray& numbers) {
      note_rounded(mesh_, "Points", numbers.coordinates(Offset{mesh_.vertex_count} * 3, mesh_.points));
    });
  }

  xml_node array_named(const xml_node& parent, std::string_view name) {
    xml_node found;
    for (const auto array : parent.children("DataArray")) {
      if (array.attribute("Name").value() != name) continue;
      if (found) fail_at(array, text("a second array ", name));
      found = array;
    }
    if (!found) fail_at(parent, text("the cells have no array ", name));
    return found;
  }

  void read_cells(const xml_node& node, Offset cells) {
    Offset end = 0;
    with_array(array_named(node, "offsets"), cells, 1, [&](NumberArray& numbers) {
      numbers.integers(cells, "an offset", "expected more than the one before", [&](std::int64_t value) {
        if (value <= end || value > std::numeric_limits<std::int64_t>::max() / largest_ratio) return false;
        cells_.end_cell(end = value);
        return true;
      });
    });
    cells_.types.reserve(static_cast<std::size_t>(cells));
    with_array(array_named(node, "types"), cells, 1, [&](NumberArray& numbers) {
      numbers.integers(cells, "a cell type", "expected 0 to 255", [&](std::int64_t type) {
        cells_.types.push_back(static_cast<std::uint8_t>(type));
        return type >= 0 && type <= 255;
      });
    });
    with_array(array_named(node, "connectivity"), end, 1,
               [&](NumberArray& numbers) { numbers.ids(end, mesh_.vertex_count, cells_.ids); });
  }

  void read_fields(const xml_node& data, MeshField::On on, Offset items) {
    for (const auto array : data.children()) {
      const std::string_view name = array.attribute("Name").value();
      if (std::string_view(array.name()) != "DataArray" ||
          std::string_view(array.attribute("type").value()) == "String") {
        mesh_.notes.push_back(text(quoted_token(array.name()), " ", quoted_token(name), " is not kept"));
        continue;
      }
      constexpr std::int64_t most_components = 1 << 20;
      const auto components = number(array, "NumberOfComponents", 1);
      if (components < 1 || components > most_components)
        fail_at(array, text("NumberOfComponents is ", components, ", expected 1 to ", most_components));
      MeshField field{std::string(name), on, static_cast<int>(components), {}};
      with_array(array, items, components, [&](NumberArray& numbers) {
        note_rounded(mesh_, name, numbers.values(items * components, field.values));
      });
      mesh_.fields.push_back(std::move(field));
    }
  }

  Cursor& file_;
  const ReadOptions& options_;
  std::string_view whole_, appended_;
  std::string xml_;  // what the document points into
  pugi::xml_document document_;
  std::map<std::int64_t, std::int64_t> taken_;  // begin and end of the appended arrays read so far
  bool swap_ = false, is_compressed_ = false, appended_is_base64_ = true;
  NumberType header_type_ = NumberType::uint32;
  MeshData mesh_;
  VtkCells cells_;
};

}  // namespace

MeshData read_vtu(Cursor& file, const ReadOptions& options) { return VtuReader(file, options).read(); }

}  // namespace derham
