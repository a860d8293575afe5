#pragma once

#include "derham/io/cursor.hpp"

#include <pugixml.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// The XML of a .vtu file. Not installed.
namespace derham {

/// The elements of a .vtu file. Its arrays, texts or appended bytes, stay where they are in the file.
class VtuDocument {
 public:
  /// Parses the file, which must outlive the document. Throws FileError.
  explicit VtuDocument(Cursor& file);

  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
  [[nodiscard]] Cursor& file() const noexcept { return file_; }
  /// All bytes of the file; the appended ones, behind the underscore.
  [[nodiscard]] std::string_view whole() const noexcept { return whole_; }
  [[nodiscard]] std::string_view appended() const noexcept { return appended_; }

  /// The text of an element, where it stands in the file; other elements may stand before and behind it.
  [[nodiscard]] std::string_view text_of(const pugi::xml_node& node) const;
  /// The value of an attribute that counts something; `usual` if it is not there and `usual` is not negative.
  [[nodiscard]] std::int64_t number(const pugi::xml_node& node, const char* name, std::int64_t usual) const;
  /// The child that must be there once.
  [[nodiscard]] pugi::xml_node only_child(const pugi::xml_node& parent, const char* name) const;

  /// Moves the cursor of the file to an element.
  void stand_at(const pugi::xml_node& node) const;
  /// FileError at an element or at a byte of the file.
  [[noreturn]] void fail_at(const pugi::xml_node& node, const std::string& message) const;
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

 private:
  // A piece of the file that stands in `xml_`.
  struct Piece {
    std::size_t in_xml, in_file;
  };
  std::string_view cut_appended();
  void copy_markup(std::string_view xml);
  [[nodiscard]] std::size_t file_offset(std::ptrdiff_t xml_offset) const noexcept;

  Cursor& file_;
  std::string_view whole_, appended_;
  std::string xml_;  // what the document points into: the markup, and for every text that is not blank one character
  std::vector<Piece> pieces_;
  pugi::xml_document document_;
};

}  // namespace derham
