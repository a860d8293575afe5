#pragma once

#include "derham/core/text.hpp"
#include "derham/core/types.hpp"
#include "derham/io/byte_order.hpp"
#include "derham/io/cursor.hpp"
#include "derham/io/listed_simplices.hpp"
#include "derham/io/ply_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

// The records of a PLY file. Not installed.
namespace derham::ply {

/// The numbers of the records, from text or from bytes.
class Numbers {
 public:
  Numbers(Cursor& file, const Header& header)
      : file_(file), is_text_(header.is_text), swap_(!header.is_text && is_foreign_order(header.little_endian)) {
    file.name_bytes(!is_text_);
  }

  [[nodiscard]] bool is_text() const noexcept { return is_text_; }

  void begin_record(const Element& element, std::int64_t i) {
    if (is_text_ && !file_.next_line())
      file_.fail(text("the file ends after ", i, " of ", element.count, " records of ", quoted_token(element.name)));
  }
  void end_record() {
    if (is_text_) file_.end_line();
  }

  /// A position, which is finite, or a value of a field, which need not be.
  double real(NumberType type, const char* what, bool is_finite) {
    if (is_text_ && !is_real(type)) return static_cast<double>(integer(type, what));
    if (is_text_) return is_finite ? file_.real(what) : file_.real_or_nan(what);
    const char* const at = file_.bytes(byte_width(type), what).data();
    const double value =
        with_number_type(type, [&]<class T>(T) { return static_cast<double>(load_number<T>(at, swap_)); });
    if (is_finite && !std::isfinite(value)) {
      file_.rewind(file_.offset() - byte_width(type));
      file_.fail(text("found ", value, ", expected a finite number as ", what));
    }
    return value;
  }

  std::int64_t integer(NumberType type, const char* what) {
    if (!is_text_) {
      const char* const at = file_.bytes(byte_width(type), what).data();
      // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
      return with_number_type(type, [&]<class T>(T) { return static_cast<std::int64_t>(load_number<T>(at, swap_)); });
    }
    return with_number_type(type, [&]<class T>(T) {
      return file_.integer(what, static_cast<std::int64_t>(std::numeric_limits<T>::lowest()),
                           static_cast<std::int64_t>(std::numeric_limits<T>::max()));
    });
  }

  /// The number of entries of a list, all of which the file can hold.
  std::int64_t list_size(const Property& list) {
    const auto here = file_.offset();
    const auto size = integer(list.count_type, "the length of a list");
    const std::int64_t entry_bytes = is_text_ ? 2 : byte_width(list.type);
    if (size < 0 || size > (file_.remaining() + 1) / entry_bytes) {
      file_.rewind(here);
      file_.fail(text("the length of the list ", quoted_token(list.name), " is ", size, ", but ", file_.remaining(),
                      " bytes are left"));
    }
    return size;
  }

  [[nodiscard]] std::int64_t room_for_triangles(const Property& list) const {
    return file_.remaining() / (is_text_ ? 7 : byte_width(list.count_type) + 3 * byte_width(list.type));
  }

  void skip(const Property& property) {
    const auto count = property.is_list ? list_size(property) : 1;
    if (!is_text_)
      (void)file_.bytes(count * byte_width(property.type), "a property");
    else
      for (std::int64_t i = 0; i < count; ++i)
        is_real(property.type) ? (void)file_.real_or_nan("a property") : (void)integer(property.type, "a property");
  }

  /// One property of all records, a table of records of `stride` bytes at `table`.
  void column(const char* table, std::int64_t count, std::int64_t stride, NumberType type, double* out,
              std::int64_t out_stride) {
    with_number_type(type, [&]<class T>(T) {
      for (std::int64_t i = 0; i < count; ++i)
        out[i * out_stride] = static_cast<double>(load_number<T>(table + i * stride, swap_));
    });
  }

  /// Ids of vertices.
  void vertices(NumberType type, Index vertex_count, std::span<Index> out) {
    if (is_text_) {
      for (Index& v : out) v = checked(integer(type, "a vertex id"), vertex_count);
      return;
    }
    const auto start = file_.offset();
    const auto size = byte_width(type);
    const char* const at =
        file_.bytes(static_cast<std::int64_t>(out.size()) * size, "the vertices of a simplex").data();
    with_number_type(type, [&]<class T>(T) {
      for (std::size_t i = 0; i < out.size(); ++i) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
        const auto id = static_cast<std::int64_t>(load_number<T>(at + i * sizeof(T), swap_));
        if (id < 0 || id >= vertex_count) file_.rewind(start + static_cast<std::int64_t>(i * sizeof(T)));
        out[i] = checked(id, vertex_count);
      }
    });
  }

  /// The usual file fast: of records that are nothing but a list, takes the next ones that are sound triangles, at most
  /// `most`, and returns how many they were.
  std::int64_t triangles(const Property& list, std::int64_t most, Index vertex_count, ListedSimplices& rows) {
    if (is_text_ || byte_width(list.count_type) != 1) return 0;
    const std::int64_t record = 1 + 3 * byte_width(list.type);
    most = std::min(most, file_.remaining() / record);
    const auto start = file_.offset();
    const char* at = file_.bytes(most * record, "the faces").data();
    std::int64_t taken = 0;
    with_number_type(list.type, [&]<class T>(T) {
      for (; taken < most && *at == 3; ++taken, at += record) {
        std::array<Index, 3> row{};
        bool sound = true;
        for (std::size_t i = 0; i < 3; ++i) {
          // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
          const auto id = static_cast<std::int64_t>(load_number<T>(at + 1 + i * sizeof(T), swap_));
          sound &= id >= 0 && id < vertex_count;
          row[i] = static_cast<Index>(id);
        }
        if (!sound) break;
        rows.add(row);
      }
    });
    file_.rewind(start + taken * record);
    return taken;
  }

  [[nodiscard]] Cursor& file() const noexcept { return file_; }

 private:
  Index checked(std::int64_t id, Index vertex_count) {
    if (id < 0 || id >= vertex_count) file_.fail(text("a vertex id is ", id, ", expected 0 to ", vertex_count - 1));
    return static_cast<Index>(id);
  }

  Cursor& file_;
  bool is_text_, swap_;
};

}  // namespace derham::ply
