#include "derham/io/matrix_market.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/io/atomic_file.hpp"
#include "derham/io/text_writer.hpp"

#include <algorithm>
#include <cmath>

namespace derham {

void write_matrix_market(const std::string& path, Index row_count, Index column_count, std::span<const Offset> offsets,
                         std::span<const Index> columns, std::span<const std::int8_t> values) {
  const auto nnz = static_cast<Offset>(columns.size());
  if (row_count < 0 || static_cast<Offset>(offsets.size()) != Offset{row_count} + 1 || offsets.front() != 0 ||
      offsets.back() != nnz || values.size() != columns.size() || !std::ranges::is_sorted(offsets))
    throw InputError(text("compressed rows do not fit together: ", row_count, " rows, ", offsets.size(), " offsets, ",
                          columns.size(), " columns, ", values.size(), " values"));
  for (const Index j : columns)
    if (j < 0 || j >= column_count) throw InputError(text("column ", j, " in a matrix of ", column_count, " columns"));

  AtomicFile file(path);
  TextWriter writer(file);
  writer.put("%%MatrixMarket matrix coordinate integer general\n");
  writer.put(row_count).put(' ').put(column_count).put(' ').put(nnz).put('\n');
  for (std::size_t i = 0; i < static_cast<std::size_t>(row_count); ++i)
    for (auto entry = static_cast<std::size_t>(offsets[i]); entry < static_cast<std::size_t>(offsets[i + 1]); ++entry)
      writer.put(i + 1).put(' ').put(Offset{columns[entry]} + 1).put(' ').put(int{values[entry]}).put('\n');
  writer.flush();
  file.commit();
}

void write_matrix_market(const std::string& path, std::span<const double> values) {
  const auto bad = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
  if (bad != values.end()) {
    const auto row = bad - values.begin();
    throw InputError(text("entry ", row, " is ", *bad, "; a Matrix Market file holds finite numbers"), row);
  }
  AtomicFile file(path);
  TextWriter writer(file);
  writer.put("%%MatrixMarket matrix array real general\n");
  writer.put(values.size()).put(" 1\n");
  for (const double value : values) writer.put(value).put('\n');
  writer.flush();
  file.commit();
}

}  // namespace derham
