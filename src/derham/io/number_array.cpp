#include "derham/io/number_array.hpp"

#include <cmath>
#include <string>

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
  out.resize(begin + static_cast<std::size_t>(count));
  Index* at = out.data() + begin;
  integers(count, "a point id", expected.c_str(), [&](std::int64_t id) {
    *at++ = static_cast<Index>(id);
    return id >= 0 && id < vertices;
  });
}

void NumberArray::coordinates(Offset count, std::vector<double>& out) {
  const auto begin = out.size();
  out.resize(begin + static_cast<std::size_t>(count));
  double* const to = out.data() + begin;
  if (is_text_) {
    for (Offset i = 0; i < count; ++i) {
      (void)file_.next_line();
      to[i] = file_.real("a coordinate");
    }
    return;
  }
  with_numbers(bytes_, type_, swap_, [&](auto numbers) {
    for (Offset i = 0; i < count; ++i) to[i] = static_cast<double>(numbers[static_cast<std::size_t>(i)]);
  });
  for (Offset i = 0; i < count; ++i)
    if (!std::isfinite(to[i])) fail(i, text("a coordinate is ", to[i], ", expected a finite number"));
}

bool NumberArray::values(Offset count, std::vector<double>& out) {
  const auto begin = out.size();
  out.resize(begin + static_cast<std::size_t>(count));
  double* const to = out.data() + begin;
  if (is_text_) {
    for (Offset i = 0; i < count; ++i) {
      (void)file_.next_line();
      to[i] = file_.real_or_nan("a value");
    }
    return false;
  }
  bool is_rounded = false;
  with_numbers(bytes_, type_, swap_, [&](auto numbers) {
    using Number = decltype(numbers[0]);
    for (Offset i = 0; i < count; ++i) {
      const auto number = numbers[static_cast<std::size_t>(i)];
      to[i] = static_cast<double>(number);
      if constexpr (std::is_integral_v<Number> && sizeof(Number) == 8) {
        constexpr auto largest = Number{1} << 53;
        is_rounded |= number > largest;
        if constexpr (std::is_signed_v<Number>) is_rounded |= number < -largest;
      }
    }
  });
  return is_rounded;
}

}  // namespace derham
