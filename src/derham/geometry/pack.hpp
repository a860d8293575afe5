#pragma once

#include <cmath>
#include <cstring>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace derham {

/// What a comparison of two Packs says, lane by lane.
class PackMask {
 public:
  using Bits [[gnu::vector_size(16)]] = long long;

  explicit PackMask(Bits bits) noexcept : bits_(bits) {}
  [[nodiscard]] Bits bits() const noexcept { return bits_; }
  [[nodiscard]] bool operator[](int lane) const noexcept { return bits_[lane] != 0; }
  [[nodiscard]] bool all() const noexcept {
#ifdef __SSE2__
    return _mm_movemask_pd(reinterpret_cast<__m128d>(bits_)) == 3;
#else
    return (bits_[0] & bits_[1]) != 0;
#endif
  }
  friend PackMask operator&(PackMask a, PackMask b) noexcept { return PackMask(a.bits_ & b.bits_); }
  friend PackMask operator|(PackMask a, PackMask b) noexcept { return PackMask(a.bits_ | b.bits_); }

 private:
  Bits bits_;
};

/// Two doubles that are computed with side by side: every operation is that of doubles in each lane, to the last bit.
class Pack {
 public:
  using Values [[gnu::vector_size(16)]] = double;

  Pack() = default;
  Pack(double x) noexcept : values_{x, x} {}  // NOLINT(google-explicit-constructor): numbers convert
  Pack(double first, double second) noexcept : values_{first, second} {}

  [[nodiscard]] double operator[](int lane) const noexcept { return values_[lane]; }
  /// Two numbers side by side in memory.
  [[nodiscard]] static Pack load(const double* from) noexcept {
    Pack result;
    std::memcpy(&result.values_, from, sizeof(Values));
    return result;
  }
  void store(double* to) const noexcept { std::memcpy(to, &values_, sizeof(Values)); }

  friend Pack operator+(Pack a, Pack b) noexcept { return Pack(a.values_ + b.values_); }
  friend Pack operator-(Pack a, Pack b) noexcept { return Pack(a.values_ - b.values_); }
  friend Pack operator-(Pack a) noexcept { return Pack(-a.values_); }
  friend Pack operator*(Pack a, Pack b) noexcept { return Pack(a.values_ * b.values_); }
  friend Pack operator/(Pack a, Pack b) noexcept { return Pack(a.values_ / b.values_); }
  friend PackMask operator<(Pack a, Pack b) noexcept { return PackMask(a.values_ < b.values_); }
  friend PackMask operator>(Pack a, Pack b) noexcept { return PackMask(a.values_ > b.values_); }
  friend PackMask operator==(Pack a, Pack b) noexcept { return PackMask(a.values_ == b.values_); }
  friend PackMask operator<=(Pack a, Pack b) noexcept { return PackMask(a.values_ <= b.values_); }

  /// a where the mask is set, b elsewhere.
  friend Pack select(PackMask mask, Pack a, Pack b) noexcept { return Pack(mask.bits() ? a.values_ : b.values_); }
  friend Pack max(Pack a, Pack b) noexcept { return select(a > b, a, b); }
  friend Pack abs(Pack a) noexcept {
    return Pack(reinterpret_cast<Values>(reinterpret_cast<PackMask::Bits>(a.values_) & 0x7fffffffffffffff));
  }
  /// As std::isnormal: neither 0 nor subnormal, infinite or NaN.
  friend PackMask is_normal(Pack a) noexcept {
    return (std::numeric_limits<double>::min() <= abs(a)) & (abs(a) <= std::numeric_limits<double>::max());
  }
  friend Pack sqrt(Pack a) noexcept {
#ifdef __SSE2__
    return Pack(_mm_sqrt_pd(a.values_));
#else
    return {std::sqrt(a[0]), std::sqrt(a[1])};
#endif
  }

 private:
  explicit Pack(Values values) noexcept : values_(values) {}

  Values values_{};
};

}  // namespace derham
