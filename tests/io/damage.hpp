#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace derham::io_test {

/// Ruins files in all the ways files get ruined; the same seed ruins them the same way.
class Damager {
 public:
  explicit Damager(unsigned seed) : random_(seed) {}

  /// A copy of `bytes` with one to four changes.
  std::string operator()(std::string_view bytes) {
    std::string damaged(bytes);
    for (std::size_t change = 0, changes = 1 + below(4); change < changes && !damaged.empty(); ++change)
      change_one(damaged);
    return damaged;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  void change_one(std::string& bytes) {
    const auto at = below(bytes.size());
    const auto length = std::min(1 + below(below(4) == 0 ? 64 : 8), bytes.size() - at);
    switch (below(10)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random_() & 255);
        break;
      case 2:
      case 3:
        replace_number(bytes, at);
        break;
      case 4:
        replace_bytes_of_number(bytes, at);
        break;
      case 5:
        bytes.erase(at, length);
        break;
      case 6:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 7:
        swap_pieces(bytes, at, length);
        break;
      case 8:
        bytes.insert(at, words[below(words.size())]);
        break;
      default:
        bytes.resize(at);
        break;
    }
  }

  // The number in text at or behind `at`; if there is none, the piece there.
  void replace_number(std::string& bytes, std::size_t at) {
    const auto in_number = [&](std::size_t i) {
      const char c = bytes[i];
      return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
    };
    std::size_t first = at;
    while (first < bytes.size() && !in_number(first)) ++first;
    if (first == bytes.size()) first = at;
    while (first > 0 && in_number(first) && in_number(first - 1)) --first;
    std::size_t last = first;
    while (last < bytes.size() && in_number(last)) ++last;
    bytes.replace(first, last - first, numbers[below(numbers.size())]);
  }

  // A number in binary: of 4 or 8 bytes, in either order.
  void replace_bytes_of_number(std::string& bytes, std::size_t at) {
    constexpr std::array<std::int64_t, 9> values{-1,
                                                 0,
                                                 std::int64_t{1} << 31,
                                                 std::int64_t{1} << 32,
                                                 1'000'000'000,
                                                 std::int64_t{1} << 62,
                                                 0x7ff8000000000000,   // nan
                                                 0x7ff0000000000000,   // infinity
                                                 0x7fc000007f800000};  // nan and infinity in 32 bits
    std::array<char, 8> number{};
    const auto value = values[below(values.size())];
    std::memcpy(number.data(), &value, sizeof value);
    if (below(2) == 0) std::ranges::reverse(number);
    const auto width = std::min({below(2) == 0 ? std::size_t{4} : std::size_t{8}, bytes.size() - at});
    std::copy_n(number.begin(), width, bytes.begin() + static_cast<std::ptrdiff_t>(at));
  }

  void swap_pieces(std::string& bytes, std::size_t at, std::size_t length) {
    const std::size_t rest = bytes.size() - at - length;
    if (rest == 0) return;
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto middle = begin + static_cast<std::ptrdiff_t>(length);
    std::rotate(begin, middle, middle + static_cast<std::ptrdiff_t>(std::min(rest, 1 + below(64))));
  }

  inline static const std::vector<std::string> numbers{"-1",
                                                       "0",
                                                       "2147483647",
                                                       "2147483648",
                                                       "4294967296",
                                                       "1000000000",
                                                       "9223372036854775807",
                                                       "99999999999999999999",
                                                       "nan",
                                                       "inf",
                                                       "1e400",
                                                       "1e-320",
                                                       std::string(300, '7')};
  inline static const std::vector<std::string> words{
      "$EndNodes", "$Elements", "OFF", "f",  "v", "#",   "\n",  "\r",      "\t",
      "/",         "//",        " ",   "\"", "<", "-1 ", " 0 ", " 1e400 ", std::string(1, '\0')};

  std::mt19937 random_;
};

}  // namespace derham::io_test
