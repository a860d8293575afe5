#include "derham/io/vtk_input.hpp"

#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace derham {

std::string lower_case(std::string_view word) {
  std::string out(word);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::optional<NumberType> vtk_number_type(std::string_view name) noexcept {
  struct Named {
    std::string_view name;
    NumberType type;
  };
  constexpr std::array types{
      Named{"double", NumberType::float64},      Named{"float", NumberType::float32},
      Named{"int", NumberType::int32},           Named{"unsigned_int", NumberType::uint32},
      Named{"long", NumberType::int64},          Named{"unsigned_long", NumberType::uint64},
      Named{"long_long", NumberType::int64},     Named{"unsigned_long_long", NumberType::uint64},
      Named{"vtktypeint64", NumberType::int64},  Named{"vtktypeuint64", NumberType::uint64},
      Named{"short", NumberType::int16},         Named{"unsigned_short", NumberType::uint16},
      Named{"char", NumberType::int8},           Named{"signed_char", NumberType::int8},
      Named{"unsigned_char", NumberType::uint8}, Named{"vtkidtype", NumberType::int32},
  };
  const auto* const found = std::ranges::find(types, name, &Named::name);
  return found == types.end() ? std::nullopt : std::optional(found->type);
}

void VtkInput::read_header() {
  read_version();
  begin_bytes();
  file.skip_line();  // the title: anything
  begin_bytes();
  demand_line();
  section_ = file.offset();
  const auto encoding = lower_case(file.word("ASCII or BINARY"));
  if (encoding != "ascii" && encoding != "binary") refuse("expected ASCII or BINARY as the third line");
  is_text_ = encoding == "ascii";
  file.end_line();
  file.name_bytes(!is_text_);
  read_kind();
}

void VtkInput::read_version() {
  for (const auto* expected : {"#", "vtk", "DataFile", "Version"}) {
    if (!file.next_line()) file.fail_token(expected, nullptr);
    const auto start = file.offset();
    if (file.word(expected) == expected) continue;
    file.rewind(start);
    file.fail_token(expected, nullptr);
  }
  const auto start = file.offset();
  const auto version = file.word("the version of the format");
  if (version.size() < 2 || version[0] < '1' || version[0] > '5' || version[1] != '.') {
    file.rewind(start);
    file.fail(text("this is version ", quoted_token(version), " of the VTK format; expected 1.0 to 5.1"));
  }
  has_offsets_ = version[0] == '5';
  file.end_line();
}

void VtkInput::read_kind() {
  demand_line();
  section_ = file.offset();
  if (lower_case(file.word("DATASET")) != "dataset") refuse("expected DATASET after the encoding");
  const auto kind = file.word("the kind of data set");
  is_polydata_ = lower_case(kind) == "polydata";
  if (!is_polydata_ && lower_case(kind) != "unstructured_grid")
    refuse(text("the data set is ", quoted_token(kind),
                "; expected UNSTRUCTURED_GRID or POLYDATA: convert it to an unstructured grid of simplices"));
  file.end_line();
}

std::string VtkInput::next_section() {
  if (!file.next_line()) return {};
  section_ = file.offset();
  return lower_case(file.word("a section"));
}

void VtkInput::refuse(const std::string& message) {
  file.rewind(section_);
  file.fail(message);
}

void VtkInput::demand_line() {
  if (!file.next_line()) file.fail_token("a section", nullptr);
}

void VtkInput::demand_word(const std::string& expected) {
  demand_line();
  const auto start = file.offset();
  if (lower_case(file.word(expected.c_str())) == expected) return;
  file.rewind(start);
  file.fail_token(expected.c_str(), nullptr);
}

NumberType VtkInput::number_type(const char* what) {
  const auto start = file.offset();
  const auto name = file.word(what);
  if (const auto type = vtk_number_type(lower_case(name))) return *type;
  file.rewind(start);
  file.fail(
      text("found ", quoted_token(name), " as ", what, "; expected a type of numbers such as double, float or int"));
}

void VtkInput::require_room(Offset count, Offset per_item, Offset width, const char* what) const {
  if (per_item > 0 && count > (file.remaining() + 1) / (width * per_item))
    file.fail(text(what, " takes ", count, " times ", per_item, " numbers, but the ", file.remaining(),
                   " bytes that are left cannot hold so many"));
}

NumberArray VtkInput::numbers(Offset count, Offset per_item, NumberType type, const char* what) {
  const Offset width = is_text_ ? 2 : byte_width(type);
  require_room(count, per_item, width, what);
  if (is_text_) return NumberArray(file, type);
  begin_bytes();
  const auto offset = file.offset();
  const auto bytes = file.bytes(count * per_item * width, what);
  return NumberArray(file, bytes, type, std::endian::native == std::endian::little, offset);
}

void VtkInput::skip_bits(Offset count) {
  if (!is_text_) {
    begin_bytes();
    (void)file.bytes(count / 8 + (count % 8 > 0 ? 1 : 0), "an array of bits");
    return;
  }
  for (Offset i = 0; i < count; ++i) {
    (void)file.next_line();
    (void)file.integer("a bit", 0, 1);
  }
}

// As text every string is a line. As bytes its length comes first: the two highest bits of the first byte say how many
// bytes the length takes, the others are the length.
void VtkInput::skip_texts(Offset count) {
  if (!is_text_) begin_bytes();
  for (Offset i = 0; i < count; ++i) {
    if (is_text_) {
      begin_bytes();
      file.skip_line();
      continue;
    }
    const auto first = static_cast<unsigned char>(file.bytes(1, "the length of a text")[0]);
    constexpr std::array<int, 4> more_bytes{7, 3, 1, 0};
    std::uint64_t length = first & 63U;
    for (const char c : file.bytes(more_bytes[first >> 6], "the length of a text"))
      length = length << 8 | static_cast<unsigned char>(c);
    (void)file.bytes(static_cast<std::int64_t>(length), "a text");
  }
}

void VtkInput::skip_metadata() {
  file.skip_line();
  while (file.remaining() > 0) {
    begin_bytes();
    if (file.at_line_end()) return;
    file.skip_line();
  }
}

}  // namespace derham
