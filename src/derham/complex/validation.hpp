#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <string>
#include <vector>

namespace derham {

/// Everything that keeps a list of rows from being the facets of a simplicial complex, by row.
struct InputReport {
  struct Repeat {
    Offset row;
    Index vertex;
  };
  struct Duplicate {
    Offset row, first_row;  ///< `row` has the vertex set of the earlier `first_row`
  };
  struct OutOfRange {
    Offset row;
    Index vertex;
  };
  std::vector<Repeat> repeats;           ///< rows with a vertex more than once, by row
  std::vector<Duplicate> duplicates;     ///< rows whose vertex set was given before, in any order, by row
  std::vector<OutOfRange> out_of_range;  ///< ids outside [0, vertex_count), by row
  Index first_unused = -1;               ///< the smallest vertex in no row; -1: all are used
  Offset unused = 0;                     ///< how many vertices are in no row

  [[nodiscard]] bool ok() const noexcept {
    return repeats.empty() && duplicates.empty() && out_of_range.empty() && unused == 0;
  }
};

/// Reads all rows and lists every defect of the input; a question, so it never throws for bad rows.
/// `vertex_count` is the number of vertices that must all be used; -1 takes 1 + the largest id.
/// Cost     O(N log N) in the number of ids
/// Source   Elcott & Schröder, "Building your own DEC at home", §2 (regularity), §5; a set container would hide
/// duplicates
[[nodiscard]] InputReport check_input(const SimplexList& rows, Index vertex_count = -1);

/// Throws the InputError of the first offending row of `report`, in the order range, repeat, unused, duplicate.
/// Does nothing if the report is ok. `vertex_count` as given to check_input.
void require_valid_input(const InputReport& report, const SimplexList& rows, Index vertex_count);

}  // namespace derham
