// This follows Dumas, Heckenbach, Saunders & Welker, "Computing simplicial homology based on efficient Smith normal
// form algorithms", 2003: unit pivots first, then the dense algorithm on what is left.
#include "derham/boundary/smith_form.hpp"

#include "derham/core/cancel.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <span>
#include <utility>

namespace derham {
namespace {

using Column = std::map<Index, mpz_class>;                     // row -> non-zero value
using PivotColumn = std::vector<std::pair<Index, mpz_class>>;  // the same, sorted by row
using DenseMatrix = std::vector<std::vector<mpz_class>>;

/// Removes unit pivots. A stored pivot column is zero in the pivot rows of all earlier ones, so a column is cleared of
/// pivot rows by going through its pivots in the order of their creation.
class UnitElimination {
 public:
  explicit UnitElimination(Index rows) : pivot_of_row_(static_cast<std::size_t>(rows), -1) {}

  /// Clears `column` of all pivot rows; stores it as a pivot if an entry is a unit (true), else leaves it (false).
  bool absorb(Column& column) {
    clear_pivot_rows(column);
    const auto unit = std::ranges::find_if(column, [](const auto& entry) { return abs(entry.second) == 1; });
    if (unit == column.end()) return false;
    store(unit->first, PivotColumn(column.begin(), column.end()));
    return true;
  }

  /// Stores a pivot column with a unit in `row` that is known to be zero in the earlier pivot rows.
  void store(Index row, PivotColumn column) {
    pivot_of_row_[static_cast<std::size_t>(row)] = static_cast<Index>(pivots_.size());
    rows_.push_back(row);
    pivots_.push_back(std::move(column));
  }

  [[nodiscard]] const std::vector<Index>& rows() const noexcept { return rows_; }

 private:
  void clear_pivot_rows(Column& column) const {
    std::priority_queue<Index, std::vector<Index>, std::greater<>> pending;
    const auto note = [&](Index row) {
      if (const Index pivot = pivot_of_row_[static_cast<std::size_t>(row)]; pivot >= 0) pending.push(pivot);
    };
    for (const auto& entry : column) note(entry.first);
    while (!pending.empty()) {
      const auto pivot = static_cast<std::size_t>(pending.top());
      pending.pop();
      const auto here = column.find(rows_[pivot]);
      if (here == column.end()) continue;  // noted twice, or cancelled since
      const PivotColumn& source = pivots_[pivot];
      const auto unit = std::ranges::lower_bound(source, rows_[pivot], {}, &PivotColumn::value_type::first);
      const mpz_class factor = here->second * unit->second;  // 1 / ±1 = ±1
      for (const auto& [row, value] : source) {
        const auto [target, inserted] = column.try_emplace(row);
        target->second -= factor * value;
        if (inserted) note(row);
        if (target->second == 0) column.erase(target);
      }
    }
  }

  std::vector<Index> pivot_of_row_;
  std::vector<Index> rows_;  // [pivot]
  std::vector<PivotColumn> pivots_;
};

/// Peels a matrix: while a row has a single entry left and that is a unit, it is a pivot that costs no fill-in (on a
/// boundary matrix: an elementary collapse). When there is none, one column is set aside.
class Peeling {
 public:
  explicit Peeling(const IntegerMatrix& A)
      : A_(A), active_(static_cast<std::size_t>(A.columns()), 1), rows_(static_cast<std::size_t>(A.rows)) {
    for (Index j = 0; j < A.columns(); ++j)
      for (const auto& entry : column(j)) {
        if (entry.row < 0 || entry.row >= A.rows)
          throw InputError(text("column ", j, " has an entry in row ", entry.row, "; rows are 0 to ", A.rows - 1));
        auto& row = rows_[static_cast<std::size_t>(entry.row)];
        ++row.count;
        row.columns ^= j;
      }
    for (Index i = 0; i < A.rows; ++i)
      if (rows_[static_cast<std::size_t>(i)].count == 1) singles_.push_back(i);
  }

  /// Gives the pivots found to `units` and returns the columns set aside.
  std::vector<Column> run(UnitElimination& units) {
    std::vector<Column> aside;
    store_single_rows(units);
    for (Index j = 0; j < A_.columns(); ++j) {
      if (!active_[static_cast<std::size_t>(j)]) continue;
      poll_cancel();
      aside.emplace_back();
      for (const auto& [row, value] : column(j))
        if (value != 0) aside.back()[row] = mpz_class(static_cast<long>(value));
      deactivate(j);
      store_single_rows(units);
    }
    return aside;
  }

 private:
  struct Row {
    Index count = 0;
    Index columns = 0;  // exclusive-or of the active columns: the column when it is one
  };

  [[nodiscard]] std::span<const IntegerMatrix::Entry> column(Index j) const {
    const auto begin = static_cast<std::size_t>(A_.offsets[static_cast<std::size_t>(j)]);
    return std::span(A_.entries)
        .subspan(begin, static_cast<std::size_t>(A_.offsets[static_cast<std::size_t>(j) + 1]) - begin);
  }

  void deactivate(Index j) {
    active_[static_cast<std::size_t>(j)] = 0;
    for (const auto& entry : column(j)) {
      auto& row = rows_[static_cast<std::size_t>(entry.row)];
      row.columns ^= j;
      if (--row.count == 1) singles_.push_back(entry.row);
    }
  }

  void store_single_rows(UnitElimination& units) {
    while (!singles_.empty()) {
      const Index row = singles_.back();
      singles_.pop_back();
      if (rows_[static_cast<std::size_t>(row)].count != 1) continue;
      const Index j = rows_[static_cast<std::size_t>(row)].columns;
      PivotColumn pivot;
      bool unit = false;
      for (const auto& entry : column(j)) {
        if (entry.value != 0) pivot.emplace_back(entry.row, static_cast<long>(entry.value));
        unit = unit || (entry.row == row && (entry.value == 1 || entry.value == -1));
      }
      if (!unit) continue;
      std::ranges::sort(pivot, {}, &PivotColumn::value_type::first);
      units.store(row, std::move(pivot));
      deactivate(j);
    }
  }

  const IntegerMatrix& A_;
  std::vector<char> active_;
  std::vector<Row> rows_;
  std::vector<Index> singles_;
};

/// Brings the block from (start, start) on to a form whose first row and column hold only the pivot, which divides the
/// rest. Returns false when the block is zero.
bool isolate_pivot(DenseMatrix& A, std::size_t start) {
  const std::size_t rows = A.size(), columns = A[0].size();
  for (;;) {
    poll_cancel();
    std::size_t best_row = rows, best_column = columns;
    for (std::size_t i = start; i < rows; ++i)
      for (std::size_t j = start; j < columns; ++j)
        if (A[i][j] != 0 && (best_row == rows || abs(A[i][j]) < abs(A[best_row][best_column]))) {
          best_row = i;
          best_column = j;
        }
    if (best_row == rows) return false;
    std::swap(A[start], A[best_row]);
    for (auto& row : A) std::swap(row[start], row[best_column]);

    // Every remainder is smaller than the pivot; while one is left it becomes the next pivot, so this ends.
    bool clean = true;
    for (std::size_t i = start + 1; i < rows; ++i) {
      const mpz_class quotient = A[i][start] / A[start][start];
      for (std::size_t j = start; j < columns; ++j) A[i][j] -= quotient * A[start][j];
      clean = clean && A[i][start] == 0;
    }
    for (std::size_t j = start + 1; j < columns; ++j) {
      const mpz_class quotient = A[start][j] / A[start][start];
      for (std::size_t i = start; i < rows; ++i) A[i][j] -= quotient * A[i][start];
      clean = clean && A[start][j] == 0;
    }
    if (!clean) continue;
    for (std::size_t i = start + 1; i < rows && clean; ++i)
      for (std::size_t j = start + 1; j < columns && clean; ++j)
        if (A[i][j] % A[start][start] != 0) {
          for (std::size_t l = start; l < columns; ++l) A[start][l] += A[i][l];
          clean = false;
        }
    if (clean) return true;
  }
}

/// The columns left without unit pivots, on the rows they use.
DenseMatrix dense_core(const std::vector<Column>& columns) {
  std::map<Index, std::size_t> position;
  for (const Column& column : columns)
    for (const auto& entry : column) position.try_emplace(entry.first, position.size());
  DenseMatrix A(position.size(), std::vector<mpz_class>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (const auto& [row, value] : columns[j]) A[position[row]][j] = value;
  return A;
}

std::vector<Column> columns_without_unit_pivot(const IntegerMatrix& A, UnitElimination& units) {
  std::vector<Column> rest = Peeling(A).run(units);
  for (bool again = true; again;) {  // a new pivot may leave units in the columns before it
    std::vector<Column> next;
    for (Column& column : rest)
      if (!units.absorb(column) && !column.empty()) next.push_back(std::move(column));
    again = next.size() != rest.size();
    rest = std::move(next);
  }
  return rest;
}

}  // namespace

SmithForm smith_form(const IntegerMatrix& A) {
  UnitElimination units(A.rows);
  const std::vector<Column> rest = columns_without_unit_pivot(A, units);
  SmithForm result{static_cast<Index>(units.rows().size()), {}, units.rows()};
  if (rest.empty()) return result;
  DenseMatrix core = dense_core(rest);
  for (std::size_t i = 0; i < std::min(core.size(), rest.size()) && isolate_pivot(core, i); ++i) {
    ++result.rank;
    const mpz_class divisor = abs(core[i][i]);
    if (!divisor.fits_slong_p()) throw LimitError("a torsion coefficient exceeds 63 bits: " + divisor.get_str());
    if (divisor > 1) result.divisors.push_back(divisor.get_si());
  }
  return result;
}

}  // namespace derham
