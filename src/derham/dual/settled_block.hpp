#pragma once

#include "derham/core/types.hpp"
#include "derham/dual/circumcentric.hpp"
#include "derham/geometry/block_metric.hpp"
#include "derham/geometry/pack.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

// Internal to dual and hodge.
namespace derham::detail {

/// What is known of some k-simplices, in increasing order, once all their cofaces have been treated.
struct SettledBlock {
  static constexpr std::size_t capacity = MetricBlock<1>::capacity;
  using Row = MetricBlock<1>::Row;

  std::span<const Index> simplices;
  const double* volume;  ///< units length^k
  const double* dual;    ///< signed volumes of the dual cells, units length^(n-k); NaN where undefined

  /// list[simplex] = row[its place here]; a list that ends just before grows.
  void store(const double* row, std::vector<double>& list) const {
    const auto count = simplices.size(), first = static_cast<std::size_t>(simplices.front());
    if (list.size() == first) {
      list.insert(list.end(), row, row + count);
    } else {
      for (std::size_t i = 0; i < count; ++i) list[static_cast<std::size_t>(simplices[i])] = row[i];
    }
  }

  /// row[place here] = star_entry(dual, volume). The least that is defined, infinite if none is.
  double stars(Row& row) const noexcept {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::size_t count = simplices.size();
    Pack least = infinite;
    std::size_t i = 0;
    for (; i + 1 < count; i += 2) {
      const Pack d = Pack::load(dual + i), star = d / Pack::load(volume + i);
      const Pack entry = select((d == 0) | is_normal(star), star, std::numeric_limits<double>::quiet_NaN());
      entry.store(&row[i]);
      least = select(entry < least, entry, least);
    }
    if (i < count) {
      row[i] = star_entry(dual[i], volume[i]);
      least = select(Pack(row[i]) < least, Pack(row[i]), least);
    }
    return std::min(least[0], least[1]);
  }
};

}  // namespace derham::detail
