#include "derham/io/npy.hpp"

#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"
#include "derham/io/number_block.hpp"

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace derham {
namespace {

// Calls action(T()) with the type of the numbers; they are real or integers.
template <class Action>
void with_type(const NpyArray& array, Action action) {
  const bool is_signed = array.kind == 'i';
  if (array.kind == 'f') return array.item_bytes == 4 ? action(float()) : action(double());
  switch (array.item_bytes) {
    case 1:
      return is_signed ? action(std::int8_t()) : action(std::uint8_t());
    case 2:
      return is_signed ? action(std::int16_t()) : action(std::uint16_t());
    case 4:
      return is_signed ? action(std::int32_t()) : action(std::uint32_t());
    default:
      return is_signed ? action(std::int64_t()) : action(std::uint64_t());
  }
}

// Calls put(i, position) for every number i in C order, with its position in the file.
template <class Put>
void each_in_fortran_order(const NpyArray& array, Put put) {
  const auto rank = array.shape.size();
  std::vector<std::int64_t> index(rank, 0), stride(rank, 1);
  for (std::size_t axis = 1; axis < rank; ++axis) stride[axis] = stride[axis - 1] * array.shape[axis - 1];
  std::int64_t position = 0;
  for (std::int64_t i = 0, count = array.count(); i < count; ++i) {
    put(static_cast<std::size_t>(i), static_cast<std::size_t>(position));
    for (std::size_t axis = rank; axis-- > 0;) {
      position += stride[axis];
      if (++index[axis] < array.shape[axis]) break;
      position -= stride[axis] * array.shape[axis];
      index[axis] = 0;
    }
  }
}

// Walks over the numbers of a block, each turned into `Out`: a vector is made from it without being zeroed first.
template <class T, class Out>
class Numbers {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = Out;
  using difference_type = std::ptrdiff_t;
  using pointer = const Out*;  // NOLINT(readability-identifier-naming): the names that iterators have
  using reference = Out;       // NOLINT(readability-identifier-naming)

  Numbers() = default;
  Numbers(const char* at, bool swap) : at_(at), swap_(swap) {}
  Out operator*() const { return static_cast<Out>(load_number<T>(at_, swap_)); }
  Numbers& operator++() {
    at_ += sizeof(T);
    return *this;
  }
  Numbers operator++(int) {
    auto old = *this;
    ++*this;
    return old;
  }
  Numbers& operator--() {
    at_ -= sizeof(T);
    return *this;
  }
  Numbers& operator+=(difference_type count) {
    at_ += count * static_cast<difference_type>(sizeof(T));
    return *this;
  }
  Numbers operator+(difference_type count) const { return Numbers(*this) += count; }
  friend difference_type operator-(const Numbers& a, const Numbers& b) {
    return (a.at_ - b.at_) / static_cast<difference_type>(sizeof(T));
  }
  friend bool operator==(const Numbers& a, const Numbers& b) { return a.at_ == b.at_; }

 private:
  const char* at_ = nullptr;
  bool swap_ = false;
};

template <class Out>
std::vector<Out> converted(const NpyArray& array) {
  std::vector<Out> out;
  with_type(array, [&]<class T>(T) {
    const char* const data = array.data.data();
    const auto count = static_cast<std::ptrdiff_t>(array.count());
    reserve_large(out, static_cast<std::size_t>(count));
    if (array.fortran && array.shape.size() > 1) {
      out.resize(static_cast<std::size_t>(count));
      each_in_fortran_order(array, [&](std::size_t i, std::size_t position) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): 8-bit integers are numbers here
        out[i] = static_cast<Out>(load_number<T>(data + position * sizeof(T), array.swap));
      });
    } else if (array.swap) {
      const Numbers<T, Out> first(data, true);
      out.assign(first, first + count);
    } else {
      const Numbers<T, Out> first(data, false);
      out.assign(first, first + count);
    }
  });
  return out;
}

}  // namespace

std::vector<double> npy_reals(const NpyArray& array, const NpyFail& fail) {
  if (!array.is_real() && !array.is_integer())
    fail(text("the array has the type ", array.kind, array.item_bytes,
              "; expected float64, float32 or integers: save it with astype(float)"));
  if (array.is_integer() && array.item_bytes == 8)
    with_type(array, [&]<class T>(T) {
      if constexpr (std::is_integral_v<T>)
        for (std::size_t i = 0; i < array.data.size(); i += sizeof(T))
          if (const T value = load_number<T>(array.data.data() + i, array.swap); !is_exact_double(value))
            fail(text("the array has the integer ", value,
                      ", which no double holds; expected integers up to 2^53, or real numbers: save it with "
                      "astype(float) if they may be rounded"));
    });
  return converted<double>(array);
}
std::vector<std::int64_t> npy_integers(const NpyArray& array) { return converted<std::int64_t>(array); }

std::vector<Index> npy_ids(const NpyArray& array, std::int64_t bound, const char* what, const NpyFail& fail) {
  bool in_range = true;
  std::string found;
  with_type(array, [&]<class T>(T) {
    if constexpr (std::is_integral_v<T>) {
      const auto check = [&, bound](auto numbers) {
        const auto is_good = [bound](T value) {
          return std::cmp_greater_equal(value, 0) && std::cmp_less(value, bound);
        };
        const auto count = array.data.size() / sizeof(T);
        bool all = true;  // without a branch, so that many are compared at once
        for (std::size_t i = 0; i < count; ++i) all &= is_good(numbers[i]);
        in_range = all;
        for (std::size_t i = 0; !all && found.empty(); ++i)
          if (!is_good(numbers[i])) found = std::to_string(numbers[i]);
      };
      if (array.swap)
        check(NumberBlock<T, true>(array.data.data()));
      else
        check(NumberBlock<T, false>(array.data.data()));
    }
  });
  if (!in_range)
    fail(bound > 0 ? text(what, " is ", found, ", expected 0 to ", bound - 1)
                   : text(what, " is ", found, ", but there are none"));
  return converted<Index>(array);
}

}  // namespace derham
