#include "derham/geometry/predicates.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace derham {

namespace {

// Laplace expansion along the rows: the same code for doubles, for their absolute values and for integers.
// `alternate` = false leaves out the signs, which gives the permanent.
template <class T, int n>
T expansion(const std::array<std::array<T, n>, n>& a, bool alternate) {
  if constexpr (n == 1) {
    return a[0][0];
  } else {
    T sum = 0;
    for (int column = 0; column < n; ++column) {
      std::array<std::array<T, n - 1>, n - 1> minor{};
      for (int i = 1; i < n; ++i)
        for (int j = 0, to = 0; j < n; ++j)
          if (j != column) minor[i - 1][to++] = a[i][j];
      const T term = a[0][column] * expansion<T, n - 1>(minor, alternate);
      if (alternate && column % 2 == 1) {
        sum -= term;
      } else {
        sum += term;
      }
    }
    return sum;
  }
}

// A double is an integer times a power of two; a common power of two does not change the sign of a determinant.
template <int n>
Sign exact_sign(const std::array<const double*, n + 1>& points) {
  constexpr int mantissa_bits = std::numeric_limits<double>::digits;
  int lowest = std::numeric_limits<int>::max();
  for (const double* p : points)
    for (int j = 0; j < n; ++j)
      if (p[j] != 0) lowest = std::min(lowest, std::ilogb(p[j]));
  const auto integer = [&](double x) {
    if (x == 0) return mpz_class(0);
    int exponent = 0;
    const double mantissa = std::ldexp(std::frexp(x, &exponent), mantissa_bits);
    mpz_class value(mantissa);
    value <<= static_cast<mp_bitcnt_t>(exponent - 1 - lowest);
    return value;
  };
  std::array<mpz_class, n> origin;
  for (int j = 0; j < n; ++j) origin[j] = integer(points[0][j]);
  std::array<std::array<mpz_class, n>, n> a;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a[i][j] = integer(points[i + 1][j]) - origin[j];
  const mpz_class determinant = expansion<mpz_class, n>(a, true);
  return static_cast<Sign>(sgn(determinant));
}

}  // namespace

template <int n>
Sign orientation_sign(const std::array<const double*, n + 1>& points) {
  if constexpr (n == 0) {
    return 1;
  } else {
    std::array<std::array<double, n>, n> a{}, magnitude{};
    double largest = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        a[i][j] = points[i + 1][j] - points[0][j];
        magnitude[i][j] = std::abs(a[i][j]);
        largest = std::max(largest, magnitude[i][j]);
      }
    // No overflow below this; the exact branch takes the rest.
    constexpr double safe = 0x1p100;
    if (largest <= safe) {
      const double determinant = expansion<double, n>(a, true);
      // Every term of the expansion meets at most n (differences) + sum_{s=2..n} s (a product and s-1 sums per level)
      // roundings; so does the permanent. Twice the first-order bound covers the higher orders and the rounding here.
      constexpr int roundings = n + n * (n + 1) / 2 - 1;
      constexpr double relative = 2 * roundings * std::numeric_limits<double>::epsilon();
      // Fewer than 2^12 operations, each losing at most 2^-1074 to underflow, later multiplied by at most
      // largest^(n-1).
      double underflow = 0x1p-1040;
      for (int s = 1; s < n; ++s) underflow *= std::max(1.0, largest);
      const double bound = relative * expansion<double, n>(magnitude, false) + underflow;
      if (determinant > bound) return 1;
      if (determinant < -bound) return -1;
    }
    return exact_sign<n>(points);
  }
}

template Sign orientation_sign<0>(const std::array<const double*, 1>&);
template Sign orientation_sign<1>(const std::array<const double*, 2>&);
template Sign orientation_sign<2>(const std::array<const double*, 3>&);
template Sign orientation_sign<3>(const std::array<const double*, 4>&);
template Sign orientation_sign<4>(const std::array<const double*, 5>&);

}  // namespace derham
