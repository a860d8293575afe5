#pragma once

#include "derham/core/types.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/number_array.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// What the sections of a legacy VTK file have in common. Not installed.
namespace derham {

/// A legacy VTK file: words, and arrays of numbers as text or as bytes, the highest first.
class VtkInput {
 public:
  explicit VtkInput(Cursor& cursor) : file(cursor) {}

  Cursor& file;

  /// Reads everything before the first section.
  void read_header();

  [[nodiscard]] bool is_text() const noexcept { return is_text_; }
  [[nodiscard]] bool is_polydata() const noexcept { return is_polydata_; }
  /// Whether cells are given by offsets and connectivity, as from version 5 on.
  [[nodiscard]] bool has_offsets() const noexcept { return has_offsets_; }

  /// Moves to the next section and returns its keyword in lower case; empty at the end of the file.
  [[nodiscard]] std::string next_section();
  /// Where the section begins.
  [[nodiscard]] std::int64_t section() const noexcept { return section_; }
  /// FileError at the beginning of the section.
  [[noreturn]] void refuse(const std::string& message);

  /// Moves to the next line, which must be there; it must begin with that word, if one is given (in lower case).
  void demand_line();
  void demand_word(const std::string& expected);

  /// The next word as a type of numbers.
  [[nodiscard]] NumberType number_type(const char* what);

  /// The `count` times `per_item` numbers that follow this line. Refused if the file cannot hold them.
  [[nodiscard]] NumberArray numbers(Offset count, Offset per_item, NumberType type, const char* what);

  /// Moves behind arrays that are no numbers: `count` bits, or `count` texts.
  void skip_bits(Offset count);
  void skip_texts(Offset count);
  /// Moves behind METADATA, which end with an empty line.
  void skip_metadata();

 private:
  void read_version();
  void read_kind();
  void begin_bytes() { (void)file.bytes(1, "the end of the line"); }
  void require_room(Offset count, Offset per_item, Offset width, const char* what) const;

  std::int64_t section_ = 0;
  bool is_text_ = true, is_polydata_ = false, has_offsets_ = false;
};

[[nodiscard]] std::string lower_case(std::string_view word);

/// The type of numbers that VTK calls so, in lower case; none if it is no such type.
[[nodiscard]] std::optional<NumberType> vtk_number_type(std::string_view name) noexcept;

}  // namespace derham
