#include "derham/io/number_array.hpp"

#include "derham/core/large_pages.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>

namespace derham {

void NumberArray::fail(Offset i, const std::string& message) {
  if (offset_ >= 0) {
    file_.rewind(offset_ + i * byte_width(type_));
    file_.fail(message);
  }
  if (is_text_) file_.fail(message);
  file_.fail(text("number ", i, " of the array: ", message));
}

void NumberArray::ids(Offset count, Index vertices, std::vector<Index>& out) {
  const auto expected = vertices > 0 ? text("expected 0 to ", vertices - 1) : std::string("but there are no points");
  const auto begin = out.size();
  reserve_large(out, begin + static_cast<std::size_t>(count));
  out.resize(begin + static_cast<std::size_t>(count));
  Index* at = out.data() + begin;
  integers(count, "a point id", expected.c_str(), [&](std::int64_t id) {
    *at++ = static_cast<Index>(id);
    return id >= 0 && id < vertices;
  });
}

std::int64_t NumberArray::next_integer(const char* what) {
  if (byte_width(type_) == 8) return file_.integer(what);
  return with_number_type(type_, [&]<class Number>(Number) -> std::int64_t {
    using Limits = std::numeric_limits<Number>;
    if constexpr (Limits::is_integer && sizeof(Number) < 8) return file_.integer(what, Limits::min(), Limits::max());
    return 0;
  });
}

std::uint64_t NumberArray::next_unsigned(const char* what) {
  (void)file_.at_line_end();
  const auto start = file_.offset();
  const auto digits = file_.word(what);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    file_.rewind(start);
    file_.fail_token("an integer from 0 to 18446744073709551615", what);
  }
  return value;
}

Offset NumberArray::reals(Offset count, const char* what, bool is_finite, std::vector<double>& out) {
  const auto begin = out.size();
  reserve_large(out, begin + static_cast<std::size_t>(count));
  out.resize(begin + static_cast<std::size_t>(count));
  double* const to = out.data() + begin;
  Offset rounded = 0;
  const auto put_integer = [&](Offset i, auto integer) {
    to[i] = static_cast<double>(integer);
    rounded += !is_exact_double(integer);
  };
  if (is_text_) {
    for (Offset i = 0; i < count; ++i) {
      (void)file_.next_line();
      if (is_real(type_))
        to[i] = is_finite ? file_.real(what) : file_.real_or_nan(what);
      else if (type_ == NumberType::uint64)
        put_integer(i, next_unsigned(what));
      else
        put_integer(i, next_integer(what));
    }
    return rounded;
  }
  pieces(count, [&](Offset first, Offset size, auto numbers) {
    using Number = decltype(numbers[0]);
    for (Offset i = 0; i < size; ++i) {
      const Number number = numbers[static_cast<std::size_t>(i)];
      if constexpr (std::is_integral_v<Number> && sizeof(Number) == 8)
        put_integer(first + i, number);
      else
        to[first + i] = static_cast<double>(number);
    }
  });
  for (Offset i = 0; is_finite && i < count; ++i)
    if (!std::isfinite(to[i])) fail(i, text(what, " is ", to[i], ", expected a finite number"));
  return rounded;
}

void note_rounded(MeshData& mesh, std::string_view array, Offset count) {
  if (count > 0)
    mesh.notes.push_back(text("array ", quoted_token(array), ": rounded ", count,
                              count == 1 ? " integer that no double holds" : " integers that no double holds"));
}

}  // namespace derham
