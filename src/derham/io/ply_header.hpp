#pragma once

#include "derham/io/cursor.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// The header of a PLY file. Not installed.
namespace derham::ply {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] constexpr int size_of(Type type) noexcept {
  constexpr int sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}
[[nodiscard]] constexpr bool is_real(Type type) noexcept { return type >= Type::float32; }

struct Property {
  std::string name;
  Type type = Type::float64;
  bool is_list = false;
  Type count_type = Type::uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::int64_t count_offset = 0;  ///< where the header says so
  std::vector<Property> properties;

  [[nodiscard]] bool has_lists() const noexcept;
  /// The position of the property, -1 if there is none.
  [[nodiscard]] int find(std::string_view property) const noexcept;
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
