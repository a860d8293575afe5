#include "derham/io/gmsh_input.hpp"

#include "derham/core/text.hpp"

#include <cmath>
#include <limits>

namespace derham {
namespace {

constexpr auto any = std::numeric_limits<std::int64_t>::max();

}  // namespace

void GmshInput::read_header() {
  if (!file.next_line()) file.fail_token("the version of the format", nullptr);
  const auto version = file.word("the version of the format");
  is_41_ = version == "4.1";
  if (!is_41_ && version != "2.2")
    file.fail(text("this is Gmsh format ", quoted_token(version),
                   "; expected 2.2 or 4.1: convert it with gmsh -save -save_all -format msh41 -o NEW.msh OLD.msh"));
  is_binary_ = file.integer("the file type", 0, 1) == 1;
  const auto width = file.integer("the data size", 4, 16);
  if ((is_binary_ || is_41_) && width != 8 && !(width == 4 && is_41_))
    file.fail(text("the data size is ", width, ", expected ", is_41_ ? "4 or 8, the bytes of a size_t" : "8"));
  size_width_ = static_cast<int>(width);
  end_line_before_bytes();
  if (!is_binary_) return;

  file.name_bytes(true);
  const auto one = load<std::uint32_t>(file.bytes(4, "the integer 1 that tells the byte order").data(), false);
  swaps_ = one == 0x01000000U;
  if (one == 1 || swaps_) return;
  file.rewind(file.offset() - 4);
  file.fail(text("the number that tells the byte order is ", one, ", expected 1"));
}

void GmshInput::end_line_before_bytes() {
  file.end_line();
  if (is_binary_) (void)file.bytes(1, "the end of the line");
}

std::int64_t GmshInput::integer(const char* what) {
  if (is_binary_) return load<std::int32_t>(file.bytes(4, what).data(), swaps_);
  to_token();
  return file.integer(what, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max());
}

std::int64_t GmshInput::integer(const char* what, std::int64_t lowest, std::int64_t highest) {
  const auto value = integer(what);
  if (value < lowest || value > highest) file.fail(text(what, " is ", value, ", expected ", lowest, " to ", highest));
  return value;
}

std::int64_t GmshInput::size(const char* what) {
  if (!is_binary_) {
    to_token();
    return file.integer(what, 0, any);
  }
  const auto value = load_size(file.bytes(size_width_, what).data());
  if (value < 0) file.fail(text(what, " is ", static_cast<std::uint64_t>(value), ", expected at most ", any));
  return value;
}

double GmshInput::real(const char* what) {
  if (!is_binary_) return file.real(what);
  const auto value = load<double>(file.bytes(8, what).data(), swaps_);
  if (!std::isfinite(value)) file.fail(text(what, " is ", value, ", expected a finite number"));
  return value;
}

void GmshInput::skip_reals(int count, const char* what) {
  if (is_binary_) {
    (void)file.bytes(std::int64_t{8} * count, what);
    return;
  }
  for (int i = 0; i < count; ++i) {
    to_token();
    (void)file.word(what);
  }
}

Index GmshInput::count(const char* what, std::int64_t text_bytes, std::int64_t binary_bytes) {
  if (is_binary_ && is_41_) return file.checked_count(size(what), what, binary_bytes);
  to_token();
  return file.count(what, is_binary_ ? binary_bytes : text_bytes);
}

void GmshInput::fail_short(const char* records, std::int64_t done, std::int64_t count) const {
  file.fail(text("the file ends after ", done, " of ", count, " ", records));
}

}  // namespace derham
