#include "derham/core/text.hpp"
#include "derham/io/gmsh_reading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();

// The rest of the line, which is a name in double quotes. The name may hold quotes itself: the first and the last of
// the line enclose it.
std::string quoted_name(Cursor& file, const char* what) {
  if (file.at_line_end()) file.fail_token(what, nullptr);
  const auto start = file.offset();
  file.skip_line();
  const auto length = file.offset() - start;
  file.rewind(start);
  auto line = file.bytes(length, what);
  const auto last = line.find_last_of('"');
  const auto refuse = [&](const char* reason) {
    file.rewind(start);
    file.fail(text("found ", quoted_token(line), ", expected ", what, " ", reason));
  };
  if (line[0] != '"' || last == 0 || line.find_first_not_of(" \t\r\f\v", last + 1) != std::string_view::npos)
    refuse("in double quotes, and nothing behind it");
  const auto name = line.substr(1, last - 1);
  if (std::ranges::any_of(name, [](char c) { return (c >= 0 && c < 0x20 && c != '\t') || c == 0x7f; }))
    refuse("without control characters");
  return std::string(name);
}

// The number of items of a list that has one per line.
std::int64_t list_length(Cursor& file, const char* what) {
  if (!file.next_line()) file.fail_token(what, nullptr);
  const auto count = file.count(what, 2);
  file.end_line();
  return count;
}

void next_line(Cursor& file, const char* what) {
  if (!file.next_line()) file.fail_token(what, nullptr);
}

// What stands before the values of a field.
struct FieldHeader {
  std::string name;
  std::int64_t components = 1;
  Index count = 0;
};

FieldHeader read_field_header(GmshInput& input) {
  auto& file = input.file;
  FieldHeader header;
  const auto strings = list_length(file, "the number of string tags");
  for (std::int64_t i = 0; i < strings; ++i) {
    next_line(file, "a string tag");
    auto name = quoted_name(file, "a string tag");
    if (i == 0) header.name = std::move(name);
  }
  const auto reals = list_length(file, "the number of real tags");
  for (std::int64_t i = 0; i < reals; ++i) {
    next_line(file, "a real tag");
    (void)file.real("a real tag");
    file.end_line();
  }
  const auto integers = list_length(file, "the number of integer tags");
  if (integers < 3) file.fail(text("the number of integer tags is ", integers, ", expected at least 3"));
  for (std::int64_t i = 0; i < integers; ++i) {
    next_line(file, "an integer tag");
    if (i == 1) {
      header.components = file.integer("the number of components", 1, 1 << 16);
    } else if (i == 2) {
      header.count = input.is_binary() ? file.checked_count(file.integer("the number of values", 0, any),
                                                            "the number of values", 4 + 8 * header.components)
                                       : file.count("the number of values", 2 + 2 * header.components);
    } else {
      (void)file.integer("an integer tag");
    }
    if (i + 1 < integers) file.end_line();
  }
  input.end_line_before_bytes();
  return header;
}

// Where the values of a file's items go. The items mostly come in our order: then the next one is right at once.
class FieldItems {
 public:
  FieldItems(GmshReading& reading, MeshField::On on) : reading_(reading), on_(on) {
    if (on == MeshField::On::vertices) {
      tags_ = reading.mesh.vertex_tags;
      return;
    }
    auto& simplices = reading.elements.simplices();
    for (int k = 0; k < 4; ++k)
      if (simplices.size(k) > 0) top_ = k;
    for (int k = 0; k <= top_; ++k)
      if (auto& positions = reading.element_positions[static_cast<std::size_t>(k)]; !positions)
        positions.emplace(simplices.tags(k));
    tags_ = simplices.tags(top_);
  }
  [[nodiscard]] Index count() const noexcept { return static_cast<Index>(tags_.size()); }

  // The position of an item; -1 for an element of lower dimension; refuses, at the cursor, what the file has not.
  [[nodiscard]] Index position(std::int64_t tag, Index guess) const {
    if (guess < count() && tags_[static_cast<std::size_t>(guess)] == tag) return guess;
    if (on_ == MeshField::On::vertices) return reading_.node(tag);
    for (int k = top_; k >= 0; --k)
      if (const Index found = (*reading_.element_positions[static_cast<std::size_t>(k)])[tag]; found >= 0)
        return k == top_ ? found : -1;
    reading_.input.file.fail(text("element number ", tag, " is not among the elements of this file"));
  }

 private:
  GmshReading& reading_;
  MeshField::On on_;
  int top_ = 0;
  std::span<const std::int64_t> tags_;
};

}  // namespace

void read_gmsh_names(GmshReading& reading) {
  auto& file = reading.input.file;
  const auto count = list_length(file, "the number of physical names");
  std::set<std::pair<int, std::int64_t>> named;
  for (std::int64_t i = 0; i < count; ++i) {
    if (!file.next_line()) reading.input.fail_short("physical names", i, count);
    const auto degree = static_cast<int>(file.integer("the dimension of a physical group", 0, 3));
    const auto number = file.integer("the number of a physical group", 1, std::numeric_limits<std::int32_t>::max());
    if (!named.insert({degree, number}).second)
      file.fail(text("physical group ", number, " of dimension ", degree, " is named twice"));
    reading.elements.simplices().name_part(degree, number, quoted_name(file, "a name"));
  }
}

void read_gmsh_field(GmshReading& reading, MeshField::On on) {
  auto& input = reading.input;
  auto& file = input.file;
  const bool swap = input.swaps();
  const auto header = read_field_header(input);
  const FieldItems items(reading, on);
  const char* const what = on == MeshField::On::vertices ? "nodes" : "simplices of the highest dimension";

  MeshField field{header.name, on, static_cast<int>(header.components), {}};
  const auto width = static_cast<std::size_t>(header.components);
  const bool may_be_complete = header.count >= items.count();
  if (may_be_complete) field.values.resize(static_cast<std::size_t>(items.count()) * width);
  std::vector<bool> is_given(may_be_complete ? static_cast<std::size_t>(items.count()) : 0);
  std::vector<double> values(width);
  Index found = 0, lower = 0;
  for (Index i = 0; i < header.count; ++i) {
    input.next_record("values", i, header.count);
    const auto at = file.offset();
    const char* const number = "the number of a node or an element";
    const auto tag = input.is_binary() ? input.integer(number) : file.integer(number);
    const Index position = items.position(tag, found);
    if (input.is_binary()) {
      const char* bytes = file.bytes(std::int64_t{8} * header.components, "the values").data();
      for (std::size_t c = 0; c < width; ++c) values[c] = load<double>(bytes + 8 * c, swap);
      if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
        file.rewind(at);
        file.fail(text("a value of field ", quoted_token(header.name), " is not a finite number"));
      }
    } else {
      for (double& value : values) value = file.real("a value");
      file.end_line();
    }
    if (position < 0) {
      ++lower;
      continue;
    }
    ++found;
    if (!may_be_complete) continue;
    if (is_given[static_cast<std::size_t>(position)]) {
      file.rewind(at);
      file.fail(text("number ", tag, " has two values in field ", quoted_token(header.name), "; expected one"));
    }
    is_given[static_cast<std::size_t>(position)] = true;
    std::ranges::copy(values, field.values.begin() + static_cast<std::ptrdiff_t>(position) * header.components);
  }
  if (lower > 0)
    reading.mesh.notes.push_back(
        text("field ", quoted_token(header.name), ": dropped ", lower, " values on simplices of lower dimension"));
  if (found < items.count()) {
    if (found > 0 || lower == 0)
      reading.mesh.notes.push_back(text("field ", quoted_token(header.name), " has values for ", found, " of ",
                                        items.count(), ' ', what, ": not kept"));
    return;
  }

  auto& fields = reading.mesh.fields;
  const auto [entry, is_new] = reading.fields.try_emplace({on, header.name}, fields.size(), 0);
  ++entry->second.second;
  if (is_new)
    fields.push_back(std::move(field));
  else
    fields[entry->second.first] = std::move(field);
}

}  // namespace derham
