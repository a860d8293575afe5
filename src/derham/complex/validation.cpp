#include "derham/complex/validation.hpp"

#include "derham/complex/simplex.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace derham {
namespace {

/// Rows with the same vertex set, found by sorting the sorted tuples.
std::vector<InputReport::Duplicate> duplicates_of(const SimplexList& rows, const std::vector<Offset>& candidates) {
  std::vector<Index> sorted;
  std::vector<std::size_t> begin{0};
  for (const Offset row : candidates) {
    const auto tuple = rows[row];
    sorted.insert(sorted.end(), tuple.begin(), tuple.end());
    std::sort(sorted.end() - static_cast<std::ptrdiff_t>(tuple.size()), sorted.end());
    begin.push_back(sorted.size());
  }
  const auto key = [&](std::size_t i) { return std::span(sorted).subspan(begin[i], begin[i + 1] - begin[i]); };
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const auto ka = key(a), kb = key(b);
    const auto by_tuple = std::lexicographical_compare_three_way(ka.begin(), ka.end(), kb.begin(), kb.end());
    return by_tuple != 0 ? by_tuple < 0 : a < b;
  });
  std::vector<InputReport::Duplicate> found;
  for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
    if (std::ranges::equal(key(order[first]), key(order[i])))
      found.push_back({candidates[order[i]], candidates[order[first]]});
    else
      first = i;
  }
  std::ranges::sort(found, {}, &InputReport::Duplicate::row);
  return found;
}

/// Counts the vertices of [0, vertex_count) that no row uses, with memory bounded by the rows, not by the largest id.
void find_unused(InputReport& report, const SimplexList& rows, Index vertex_count) {
  std::vector<Index> ids(rows.vertices().begin(), rows.vertices().end());
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  Index next = 0;
  Offset used = 0;
  for (const Index v : ids) {
    if (v < 0 || v >= vertex_count) continue;
    if (v != next && report.first_unused < 0) report.first_unused = next;
    next = v + 1;
    ++used;
  }
  report.unused = std::max<Offset>(0, vertex_count - used);  // all ids may be negative, and vertex_count with them
  if (report.unused > 0 && report.first_unused < 0) report.first_unused = next;
}

}  // namespace

InputReport check_input(const SimplexList& rows, Index vertex_count) {
  if (vertex_count < 0) vertex_count = rows.vertex_bound();
  InputReport report;
  std::vector<Offset> sound;
  std::vector<Index> tuple;
  for (Offset row = 0; row < rows.size(); ++row) {
    bool in_range = true;
    for (const Index v : rows[row]) {
      if (v >= 0 && v < vertex_count) continue;
      if (in_range) report.out_of_range.push_back({row, v});
      in_range = false;
    }
    tuple.assign(rows[row].begin(), rows[row].end());
    std::ranges::sort(tuple);
    const auto twice = std::ranges::adjacent_find(tuple);
    if (twice != tuple.end())
      report.repeats.push_back({row, *twice});
    else if (in_range)
      sound.push_back(row);
  }
  find_unused(report, rows, vertex_count);
  report.duplicates = duplicates_of(rows, sound);
  return report;
}

void require_valid_input(const InputReport& report, const SimplexList& rows, Index vertex_count) {
  // The first row that is wrong in itself or repeats an earlier one; of a row that is both, what it is in itself.
  constexpr Offset none = std::numeric_limits<Offset>::max();
  const auto first_row = [](const auto& list) { return list.empty() ? none : list.front().row; };
  const Offset first =
      std::min({first_row(report.out_of_range), first_row(report.repeats), first_row(report.duplicates)});
  if (first != none && first == first_row(report.out_of_range)) {
    const auto [row, vertex] = report.out_of_range.front();
    const Index bound = vertex_count < 0 ? std::numeric_limits<Index>::max() : vertex_count;
    throw InputError(text("row ", row, " ", tuple_text(rows[row]), " has vertex ", vertex,
                          "; ids are 0-based positions, at least 0 and less than ", bound),
                     row);
  }
  if (first != none && first == first_row(report.repeats)) {
    const auto [row, vertex] = report.repeats.front();
    throw InputError(text("row ", row, " ", tuple_text(rows[row]), " repeats vertex ", vertex,
                          "; the vertices of a simplex are distinct. Remove the row or give the corner its own vertex"),
                     row);
  }
  if (first != none) {
    const auto [row, earlier] = report.duplicates.front();
    throw InputError(text("row ", row, " ", tuple_text(rows[row]), " has the same vertices as row ", earlier, " ",
                          tuple_text(rows[earlier]),
                          "; each simplex is given once. Remove one, or, in a mesh glued from identified vertices, "
                          "subdivide until every simplex has its own vertex set"),
                     row);
  }
  if (report.unused > 0) {
    // When the ids themselves say how many vertices there are, the row to look at is the first that jumps the gap.
    Offset row = vertex_count < 0 ? 0 : -1;
    while (row >= 0 && std::ranges::max(rows[row]) < report.first_unused) ++row;
    const auto where = row < 0 ? std::string() : text(", but row ", row, " is ", tuple_text(rows[row]));
    throw InputError(text("vertex ", report.first_unused, " is in no simplex", where, "; every id up to the largest ",
                          "must be used, and ", report.unused, " are not. Drop unused vertices and renumber, or list ",
                          "the vertex as a 0-simplex of its own"),
                     row);
  }
}

}  // namespace derham
