#pragma once

#include "derham/core/bulk_array.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

// Internal to this room.
namespace derham::detail {

/// Transposes a table of `width` indices a row by a counting sort: the entries made from the places (row, position) where
/// index t stands become entries[offsets[t]] to entries[offsets[t+1]-1], in the order of the rows.
///
/// The rows are cut into one part per thread. Each part counts every index on its own; the sums over indices and, within
/// an index, over parts say where each part writes. So the result does not depend on the number of parts.
/// Shape    table (rows, width) row-major with values in [0, targets), offsets (targets+1,), entries (rows*width,)
/// Cost     two passes over the table; targets * parts counters beside the result
template <class Place, class Entry>
void transpose_table(std::span<const Index> table, std::size_t width, std::span<Place> offsets,
                     std::span<Index> entries, Entry&& entry) {
  constexpr int most_parts = 8;
  const std::size_t targets = offsets.size() - 1;
  const auto rows = static_cast<Offset>(table.size() / width);
  const Offset parts = rows < (1 << 14) ? 1 : std::min(thread_count(), most_parts);
  const auto first_row = [&](Offset part) { return rows * part / parts; };
  std::vector<BulkArray<Place>> places(static_cast<std::size_t>(parts));

  parallel_blocks(parts, 1, [&](Offset part, Offset) {
    BulkArray<Place> counts(targets);
    std::ranges::fill(counts, Place{0});
    const Offset last = first_row(part + 1) * static_cast<Offset>(width);
    for (Offset p = first_row(part) * static_cast<Offset>(width); p < last; ++p)
      ++counts[static_cast<std::size_t>(table[static_cast<std::size_t>(p)])];
    places[static_cast<std::size_t>(part)] = std::move(counts);
  });

  Place total = 0;
  for (std::size_t t = 0; t < targets; ++t) {
    offsets[t] = total;
    for (auto& part : places) {
      const Place count = part[t];
      part[t] = total;
      total += count;
    }
  }
  offsets[targets] = total;

  parallel_blocks(parts, 1, [&](Offset part, Offset) {
    Place* const next = places[static_cast<std::size_t>(part)].data();
    const Index* target = table.data() + first_row(part) * static_cast<Offset>(width);
    for (Offset row = first_row(part); row < first_row(part + 1); ++row)
      for (std::size_t j = 0; j < width; ++j)
        entries[static_cast<std::size_t>(next[*target++]++)] = entry(static_cast<Index>(row), j);
  });
}

}  // namespace derham::detail
