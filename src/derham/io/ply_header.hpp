#pragma once

#include "derham/io/cursor.hpp"
#include "derham/io/number_block.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// The header of a PLY file. Not installed.
namespace derham::ply {

struct Property {
  std::string name;
  NumberType type = NumberType::float64;
  bool is_list = false;
  NumberType count_type = NumberType::uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::int64_t count_offset = 0;  ///< where the header says so
  std::vector<Property> properties;

  [[nodiscard]] bool has_lists() const noexcept;
  /// The position of the property, -1 if there is none.
  [[nodiscard]] int find(std::string_view property) const noexcept;
  /// The position of the property if it is one number (a list of integers), else -1.
  [[nodiscard]] int find_scalar(std::string_view property) const noexcept;
  [[nodiscard]] int find_ids(std::string_view property) const noexcept;
  /// How many bytes one record takes at least.
  [[nodiscard]] std::int64_t least_bytes(bool is_text) const noexcept;
};

struct Header {
  bool is_text = false, little_endian = true;
  std::vector<Element> elements;
};

/// Reads up to the first byte behind the header.
[[nodiscard]] Header read_header(Cursor& file);

}  // namespace derham::ply
