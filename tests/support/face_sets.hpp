#pragma once

#include "derham/complex/simplex.hpp"
#include "derham/complex/simplex_list.hpp"

#include <map>
#include <vector>

// The obvious way to look at a list of simplices, independent of SimplicialComplex: sets and maps of sorted tuples.

namespace derham::test {

using Face = std::vector<Index>;

/// Every face of every row, by degree, with the number of rows it is in.
inline std::vector<std::map<Face, int>> face_sets(const SimplexList& rows) {
  std::vector<std::map<Face, int>> faces(static_cast<std::size_t>(rows.dimension() + 1));
  for (Offset i = 0; i < rows.size(); ++i) {
    Face sorted(rows[i].begin(), rows[i].end());
    sort_with_sign(sorted);
    for (unsigned set = 1; set < 1u << sorted.size(); ++set) {
      Face face;
      for (std::size_t v = 0; v < sorted.size(); ++v)
        if (set >> v & 1) face.push_back(sorted[v]);
      ++faces[face.size() - 1][face];
    }
  }
  return faces;
}

inline std::vector<Offset> f_vector(const SimplexList& rows) {
  std::vector<Offset> f;
  for (const auto& faces : face_sets(rows)) f.push_back(static_cast<Offset>(faces.size()));
  return f;
}

inline Offset euler_characteristic(const SimplexList& rows) {
  Offset sum = 0, sign = 1;
  for (const Offset count : f_vector(rows)) {
    sum += sign * count;
    sign = -sign;
  }
  return sum;
}

/// The facets of uniform `rows` that are in one row, as they are oriented by it.
inline SimplexList boundary_facets(const SimplexList& rows) {
  const auto faces = face_sets(rows);
  SimplexList boundary;
  for (Offset i = 0; i < rows.size(); ++i)
    for (std::size_t omitted = 0; omitted < rows[i].size(); ++omitted) {
      Face facet(rows[i].begin(), rows[i].end());
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(omitted));
      Face sorted = facet;
      sort_with_sign(sorted);
      if (faces[sorted.size() - 1].at(sorted) != 1) continue;
      if (omitted % 2 == 1 && facet.size() > 1) std::swap(facet.end()[-1], facet.end()[-2]);
      boundary.push_back(facet);
    }
  return boundary;
}

/// Whether every facet is in one or two rows.
inline bool facets_have_at_most_two_rows(const SimplexList& rows) {
  const auto faces = face_sets(rows);
  for (const auto& [facet, count] : faces[faces.size() - 2])
    if (count > 2) return false;
  return true;
}

/// Whether every facet is in exactly two rows.
inline bool is_closed(const SimplexList& rows) {
  const auto faces = face_sets(rows);
  for (const auto& [facet, count] : faces[faces.size() - 2])
    if (count != 2) return false;
  return true;
}

/// Whether the rows, as ordered, give opposite signs to every facet that two of them share.
inline bool is_coherent(const SimplexList& rows) {
  std::map<Face, std::pair<int, int>> sums;  // sum of signs, number of rows
  for (Offset i = 0; i < rows.size(); ++i)
    for (std::size_t omitted = 0; omitted < rows[i].size(); ++omitted) {
      Face facet(rows[i].begin(), rows[i].end());
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(omitted));
      const int sign = sort_with_sign(facet) * face_sign(static_cast<int>(omitted));
      sums[facet].first += sign;
      ++sums[facet].second;
    }
  for (const auto& [facet, sum] : sums)
    if (sum.second == 2 && sum.first != 0) return false;
  return true;
}

}  // namespace derham::test
