#pragma once

#include "derham/core/types.hpp"
#include "derham/io/byte_order.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Arrays in numpy's own format. Not installed.
namespace derham {

/// A numpy array whose numbers stay where they are: a header and the bytes behind it.
struct NpyArray {
  char kind = 'f';  ///< as numpy: 'f' real, 'i' and 'u' integers, 'b' truth values, 'S' and 'U' text, 'O' …
  int item_bytes = 8;
  bool swap = false;  ///< the other byte order than this machine's
  bool fortran = false;
  std::vector<std::int64_t> shape;
  std::string_view data;

  [[nodiscard]] std::int64_t count() const noexcept {
    std::int64_t product = 1;  // of extents that fit the bytes, unless one of them is 0
    for (const auto extent : shape)
      if (extent == 0) return 0;
    for (const auto extent : shape) product *= extent;
    return product;
  }
  [[nodiscard]] bool is_integer() const noexcept { return kind == 'i' || kind == 'u'; }
  [[nodiscard]] bool is_real() const noexcept { return kind == 'f' && (item_bytes == 4 || item_bytes == 8); }
  [[nodiscard]] std::string shape_text() const;
};

/// How a complaint is raised.
using NpyFail = std::function<void(const std::string&)>;

/// Parses the bytes of a .npy file, format 1, 2 or 3, strictly. `fail` must throw.
[[nodiscard]] NpyArray parse_npy(std::string_view bytes, const NpyFail& fail);

/// All numbers in C order, whatever order the file has. `npy_reals` takes real numbers and integers that a double holds;
/// `fail` is called for others, with the number or the type in the message. The other two take integers.
[[nodiscard]] std::vector<double> npy_reals(const NpyArray& array, const NpyFail& fail);
[[nodiscard]] std::vector<std::int64_t> npy_integers(const NpyArray& array);
/// As `npy_integers`; `fail` is called if one is not in [0, bound), with it in the message, named `what`.
[[nodiscard]] std::vector<Index> npy_ids(const NpyArray& array, std::int64_t bound, const char* what,
                                         const NpyFail& fail);

/// The header of a .npy file for an array in C order of this machine's numbers of the given kind, e.g. 'f' and 8.
[[nodiscard]] std::string npy_header(char kind, std::size_t item_bytes, std::span<const std::int64_t> shape);

}  // namespace derham
