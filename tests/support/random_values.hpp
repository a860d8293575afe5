#pragma once

#include "derham/core/types.hpp"

#include <cstdint>
#include <random>
#include <vector>

/// Vectors for operators; each depends on its seed alone.
namespace derham::support {

/// Normally distributed: every sum is rounded, so its bits tell the order of the additions.
inline std::vector<double> random_values(Offset size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(static_cast<std::size_t>(size));
  for (double& value : values) value = normal(random);
  return values;
}

/// Small integers: every sum is exact.
inline std::vector<double> random_integers(Offset size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> integers(-1000, 1000);
  std::vector<double> values(static_cast<std::size_t>(size));
  for (double& value : values) value = integers(random);
  return values;
}

}  // namespace derham::support
