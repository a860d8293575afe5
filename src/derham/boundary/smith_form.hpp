#pragma once

#include "derham/core/types.hpp"

#include <cstdint>
#include <vector>

namespace derham {

/// A sparse integer matrix by columns: column j holds `entries[offsets[j]]` to `entries[offsets[j+1]-1]`.
struct IntegerMatrix {
  struct Entry {
    Index row = 0;
    std::int64_t value = 0;
  };
  Index rows = 0;
  std::vector<Offset> offsets{0};  ///< (columns+1,)
  std::vector<Entry> entries;      ///< distinct rows within a column, in any order

  [[nodiscard]] Index columns() const noexcept { return static_cast<Index>(offsets.size() - 1); }
};

/// What the Smith normal form diag(d_1, …, d_r, 0, …), d_i | d_{i+1}, says about a matrix.
struct SmithForm {
  Index rank = 0;                      ///< r
  std::vector<std::int64_t> divisors;  ///< the d_i > 1, increasing: the torsion of the cokernel is the sum of Z_{d_i}
  std::vector<Index> unit_rows;        ///< rows that were eliminated by pivots +1 or -1, in the order of elimination
};

/// The Smith normal form of an integer matrix, exact whatever the size of the intermediate integers.
///
/// Columns are first eliminated by pivots +1 and -1, which on boundary matrices leaves a core of a few columns; the
/// core is made diagonal densely.
/// Cost     near linear when unit pivots abound with little fill-in; cubic in the core, for small matrices only
/// Throws   InputError if a row index is outside [0, rows); LimitError if a divisor exceeds 63 bits
/// Source   Munkres, "Elements of Algebraic Topology", 1984, §11; Dumas, Heckenbach, Saunders & Welker, "Computing
///          simplicial homology based on efficient Smith normal form algorithms", 2003
[[nodiscard]] SmithForm smith_form(const IntegerMatrix& A);

}  // namespace derham
