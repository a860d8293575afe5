#pragma once

#include "derham/core/large_pages.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace derham {

/// A large array of numbers whose length is fixed when it is made, or an upper bound of it that `shrink` mends: nothing is
/// written to new elements, so that memory that nobody writes to is never taken from the system.
template <class T>
class BulkArray {
  static_assert(std::is_trivial_v<T>);

 public:
  BulkArray() = default;

  /// `size` elements that hold no value yet. Throws std::bad_alloc.
  explicit BulkArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    if (size > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
    data_.reset(static_cast<T*>(std::malloc(size * sizeof(T))));
    if (!data_) throw std::bad_alloc();
    prefer_large_pages(data_.get(), size * sizeof(T));
  }
  explicit BulkArray(std::span<const T> values) : BulkArray(values.size()) { std::ranges::copy(values, begin()); }

  BulkArray(const BulkArray& other) : BulkArray(std::span<const T>(other.begin(), other.size())) {}
  BulkArray(BulkArray&& other) noexcept : data_(std::move(other.data_)), size_(std::exchange(other.size_, 0)) {}
  BulkArray& operator=(BulkArray other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~BulkArray() = default;

  /// Keeps the first `size` elements and gives the memory behind them back.
  void shrink(std::size_t size) {
    if (size == 0) *this = BulkArray();
    if (size >= size_) return;
    T* const old = data_.release();
    T* const smaller = static_cast<T*>(std::realloc(static_cast<void*>(old), size * sizeof(T)));
    data_.reset(smaller != nullptr ? smaller : old);
    size_ = size;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] T* data() noexcept { return data_.get(); }
  [[nodiscard]] const T* data() const noexcept { return data_.get(); }
  [[nodiscard]] T* begin() noexcept { return data(); }
  [[nodiscard]] const T* begin() const noexcept { return data(); }
  [[nodiscard]] T* end() noexcept { return data() + size_; }
  [[nodiscard]] const T* end() const noexcept { return data() + size_; }
  [[nodiscard]] T& operator[](std::size_t i) noexcept { return data()[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept { return data()[i]; }

 private:
  struct Free {
    void operator()(T* memory) const noexcept { std::free(static_cast<void*>(memory)); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace derham
