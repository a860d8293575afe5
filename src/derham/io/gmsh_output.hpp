#pragma once

#include "derham/io/text_writer.hpp"

#include <cstdint>
#include <string_view>
#include <utility>

namespace derham {

/// The numbers of a .msh file in text, one record per line, or in bytes.
class GmshOutput {
 public:
  GmshOutput(TextWriter& writer, bool binary) : file(writer), is_binary_(binary) {}

  [[nodiscard]] bool is_binary() const noexcept { return is_binary_; }

  /// A number of the format's types int, size_t and double.
  GmshOutput& integer(std::int64_t value) {
    return is_binary_ ? number(static_cast<std::int32_t>(value)) : number(value);
  }
  GmshOutput& size(std::int64_t value) { return number(value); }
  GmshOutput& real(double value) { return number(value); }

  /// Ends a record.
  void end() {
    if (is_binary_) return;
    file.put('\n');
    at_start_ = true;
  }

  /// The line that opens a section, the one that closes it.
  void open(std::string_view section) { file.put('$').put(section).put('\n'); }
  void close(std::string_view section) { file.put(is_binary_ ? "\n$End" : "$End").put(section).put('\n'); }

  /// For lines of text, which binary files have, too.
  TextWriter& file;

 private:
  template <class Number>
  GmshOutput& number(Number value) {
    if (is_binary_) {
      file.put_bytes(value);
      return *this;
    }
    if (!std::exchange(at_start_, false)) file.put(' ');
    file.put(value);
    return *this;
  }

  bool is_binary_;
  bool at_start_ = true;
};

}  // namespace derham
