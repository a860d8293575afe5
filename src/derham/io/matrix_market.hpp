#pragma once

#include "derham/core/types.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace derham {

/// Writes a sparse integer matrix as Matrix Market "coordinate integer general" (1-based), rows in order.
///
/// Compressed rows: `offsets` (rows+1,), and for row i the entries offsets[i] to offsets[i+1] of `columns` and `values`
/// (both (nnz,)). The file appears complete or not at all; "-" is standard output.
/// Throws   InputError if the arrays do not fit together or a column is outside [0, column_count); FileError if the
///          file cannot be written
void write_matrix_market(const std::string& path, Index row_count, Index column_count, std::span<const Offset> offsets,
                         std::span<const Index> columns, std::span<const std::int8_t> values);

/// Writes a vector (e.g. a diagonal) as Matrix Market "array real general" with one column; every double reads back to
/// the same bits.
/// Throws   InputError if a value is not finite (the format has no word for it); FileError if the file cannot be
///          written
void write_matrix_market(const std::string& path, std::span<const double> values);

}  // namespace derham
