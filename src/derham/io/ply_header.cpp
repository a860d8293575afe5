#include "derham/io/ply_header.hpp"

#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace derham::ply {
namespace {

using namespace std::string_view_literals;

constexpr std::array<std::pair<std::string_view, NumberType>, 16> type_names{{{"char", NumberType::int8},
                                                                              {"uchar", NumberType::uint8},
                                                                              {"short", NumberType::int16},
                                                                              {"ushort", NumberType::uint16},
                                                                              {"int", NumberType::int32},
                                                                              {"uint", NumberType::uint32},
                                                                              {"float", NumberType::float32},
                                                                              {"double", NumberType::float64},
                                                                              {"int8", NumberType::int8},
                                                                              {"uint8", NumberType::uint8},
                                                                              {"int16", NumberType::int16},
                                                                              {"uint16", NumberType::uint16},
                                                                              {"int32", NumberType::int32},
                                                                              {"uint32", NumberType::uint32},
                                                                              {"float32", NumberType::float32},
                                                                              {"float64", NumberType::float64}}};

// The next word, which must be one of a few; `expected` lists them.
template <class Accept>
void take(Cursor& file, const char* expected, Accept accept) {
  (void)file.at_line_end();
  const auto here = file.offset();
  if (accept(file.word(expected))) return;
  file.rewind(here);
  file.fail_token(expected, nullptr);
}

// Some programs write integers that PLY does not have.
void refuse_64_bits(const Cursor& file, std::string_view word) {
  constexpr std::array names{"int64"sv, "uint64"sv, "long"sv, "ulong"sv, "longlong"sv, "ulonglong"sv, "long64"sv};
  if (std::ranges::find(names, word) != names.end())
    file.fail(text("the type ", quoted_token(word),
                   " is none of PLY, whose integers have at most 32 bits; expected int, or double for larger numbers"));
}

NumberType take_type(Cursor& file, bool of_count) {
  auto type = NumberType::int8;
  take(file, of_count ? "an integer type such as uchar" : "a type such as float, double, int or uchar",
       [&](std::string_view word) {
         const auto* const found = std::ranges::find(type_names, word, [](const auto& entry) { return entry.first; });
         refuse_64_bits(file, word);
         if (found == type_names.end() || (of_count && is_real(found->second))) return false;
         type = found->second;
         return true;
       });
  return type;
}

Property read_property(Cursor& file, const Element& element) {
  Property property;
  (void)file.at_line_end();
  const auto here = file.offset();
  if (file.word("a type") == "list") {
    property.is_list = true;
    property.count_type = take_type(file, true);
  } else {
    file.rewind(here);
  }
  property.type = take_type(file, false);
  property.name = file.word("the name of the property");
  file.end_line();
  if (element.find(property.name) >= 0)
    file.fail(
        text("the element ", quoted_token(element.name), " has the property ", quoted_token(property.name), " twice"));
  return property;
}

void read_format(Cursor& file, Header& header) {
  take(file, "the format: ascii, binary_little_endian or binary_big_endian", [&](std::string_view word) {
    header.is_text = word == "ascii";
    header.little_endian = word == "binary_little_endian";
    return header.is_text || header.little_endian || word == "binary_big_endian";
  });
  take(file, "the version 1.0", [](std::string_view word) { return word == "1.0"; });
  file.end_line();
}

void read_element(Cursor& file, Header& header) {
  Element element;
  element.name = file.word("the name of the element");
  (void)file.at_line_end();
  element.count_offset = file.offset();
  element.count = file.integer("the number of records", 0, std::numeric_limits<std::int64_t>::max());
  file.end_line();
  if (std::ranges::find(header.elements, element.name, &Element::name) != header.elements.end())
    file.fail(text("the element ", quoted_token(element.name), " is there twice"));
  header.elements.push_back(std::move(element));
}

// Elements without properties or larger than the file.
void require_room(Cursor& file, const Header& header) {
  const auto end = file.offset();
  for (const auto& element : header.elements) {
    file.rewind(element.count_offset);
    if (element.properties.empty()) file.fail(text("the element ", quoted_token(element.name), " has no properties"));
    (void)file.count(("the number of records of " + quoted_token(element.name)).c_str(),
                     element.least_bytes(header.is_text));
  }
  file.rewind(end);
}

}  // namespace

bool Element::has_lists() const noexcept { return std::ranges::any_of(properties, &Property::is_list); }

int Element::find(std::string_view property) const noexcept {
  const auto found = std::ranges::find(properties, property, &Property::name);
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

int Element::find_scalar(std::string_view property) const noexcept {
  const int at = find(property);
  return at >= 0 && !properties[static_cast<std::size_t>(at)].is_list ? at : -1;
}

int Element::find_ids(std::string_view property) const noexcept {
  const int at = find(property);
  if (at < 0) return -1;
  const auto& found = properties[static_cast<std::size_t>(at)];
  return found.is_list && !is_real(found.type) ? at : -1;
}

std::int64_t Element::least_bytes(bool is_text) const noexcept {
  std::int64_t bytes = 0;
  for (const auto& property : properties)
    bytes += is_text ? 2 : byte_width(property.is_list ? property.count_type : property.type);
  return bytes;
}

Header read_header(Cursor& file) {
  (void)file.next_line();
  take(file, "the first line 'ply'", [](std::string_view word) { return word == "ply"; });
  file.end_line();
  Header header;
  bool has_format = false;
  while (true) {
    if (!file.next_line()) file.fail_token("end_header", nullptr);
    const auto start = file.offset();
    const auto keyword = file.word("a keyword");
    if (keyword == "comment" || keyword == "obj_info") {
      file.skip_line();
    } else if (keyword == "format" && !has_format) {
      read_format(file, header);
      has_format = true;
    } else if (keyword == "element" && has_format) {
      read_element(file, header);
    } else if (keyword == "property" && !header.elements.empty()) {
      auto& element = header.elements.back();
      element.properties.push_back(read_property(file, element));
    } else if (keyword == "end_header" && has_format) {
      file.end_line();
      if (file.remaining() > 0) (void)file.bytes(1, "the end of the line");
      require_room(file, header);
      return header;
    } else {
      file.rewind(start);
      file.fail_token(!has_format               ? "the line 'format …'"
                      : header.elements.empty() ? "element, comment or end_header"
                                                : "element, property, comment or end_header",
                      nullptr);
    }
  }
}

}  // namespace derham::ply
