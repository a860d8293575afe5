#include "derham/geometry/pack.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace derham {
namespace {

const std::vector<double>& samples() {
  static const std::vector<double> list{0.0,
                                        -0.0,
                                        1.0,
                                        -1.5,
                                        1e-310,
                                        -3e200,
                                        0.1,
                                        std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::quiet_NaN()};
  return list;
}

void expect_same(double a, double b) {
  EXPECT_TRUE((std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b))
      << a << " is not " << b;
}

// Each lane by itself computes what doubles do.
TEST(Pack, LanesAreDoubles) {
  for (const double a : samples())
    for (const double b : samples()) {
      const Pack x(a, b), y(b, 2);
      const double first[] = {(x + y)[0], (x - y)[0], (x * y)[0], (x / y)[0], (-x)[0], abs(x)[0], max(x, y)[0]};
      const double one[] = {a + b, a - b, a * b, a / b, -a, std::abs(a), a > b ? a : b};
      const double second[] = {(x + y)[1], (x - y)[1], (x * y)[1], (x / y)[1], (-x)[1], abs(x)[1], max(x, y)[1]};
      const double two[] = {b + 2, b - 2, b * 2, b / 2, -b, std::abs(b), b > 2 ? b : 2};
      for (std::size_t i = 0; i < std::size(one); ++i) {
        expect_same(first[i], one[i]);
        expect_same(second[i], two[i]);
      }
      expect_same(sqrt(x)[0], std::sqrt(a));
      expect_same(sqrt(x)[1], std::sqrt(b));
    }
}

TEST(Pack, NormalAsDoublesAre) {
  for (const double a : samples())
    for (const double b : samples()) {
      const auto normal = is_normal(Pack(a, b));
      EXPECT_EQ(normal[0], std::isnormal(a)) << a;
      EXPECT_EQ(normal[1], std::isnormal(b)) << b;
      EXPECT_EQ(normal.all(), std::isnormal(a) && std::isnormal(b));
      EXPECT_EQ((Pack(a, b) == Pack(b, b))[0], a == b);
      EXPECT_EQ(((Pack(a, a) < Pack(b, b)) | (Pack(a, b) == Pack(b, a)))[0], a <= b);
    }
}

TEST(Pack, LoadsWhatItStores) {
  double memory[] = {1, 2, 3, 4};
  const Pack x = Pack::load(memory + 1);
  expect_same(x[0], 2);
  expect_same(x[1], 3);
  x.store(memory);
  EXPECT_EQ(memory[0], 2);
  EXPECT_EQ(memory[1], 3);
  EXPECT_EQ(memory[2], 3);
}

TEST(Pack, ComparisonsSelectLaneByLane) {
  for (const double a : samples())
    for (const double b : samples()) {
      const Pack x(a, b), y(b, a);
      EXPECT_EQ((x < y)[0], a < b);
      EXPECT_EQ((x < y)[1], b < a);
      EXPECT_EQ((x > y)[0], a > b);
      EXPECT_EQ((x <= y)[1], b <= a);
      EXPECT_EQ((x <= y).all(), a <= b && b <= a);
      EXPECT_EQ(((x <= y) & (x < y))[0], a < b);
      const Pack chosen = select(x < y, Pack(1, 2), Pack(3, 4));
      EXPECT_EQ(chosen[0], a < b ? 1 : 3);
      EXPECT_EQ(chosen[1], b < a ? 2 : 4);
    }
  double stored[2];
  Pack(5, 6).store(stored);
  EXPECT_EQ(stored[0], 5);
  EXPECT_EQ(stored[1], 6);
}

}  // namespace
}  // namespace derham
