#pragma once

#include "derham/complex/simplicial_complex.hpp"

#include <limits>
#include <span>

namespace derham {

template <int n>
class UpperLink;

/// Fills the lists and tables of a complex. Internal to the room: use the constructor of SimplicialComplex.
template <int n>
class ComplexBuilder {
 public:
  /// All rows of dimension n, already known to be in range and without repeated vertices.
  static void build_pure(SimplicialComplex<n>& K, const SimplexList& rows, Index vertex_count);

  /// Rows of several dimensions, the largest n: sort and unique, degree by degree.
  static void build_mixed(SimplicialComplex<n>& K, const SimplexList& rows, Index vertex_count);

  static void orient(SimplicialComplex<n>& K, const SimplexList& rows);

 private:
  static void fill_lists(SimplicialComplex<n>& K, const UpperLink<n>& link, Index v);
  static void fill_top_faces(SimplicialComplex<n>& K, const UpperLink<n>& link, Index v, std::span<const Index> suffix,
                             Index top);
  static void fill_last_faces(SimplicialComplex<n>& K, int k);
};

/// Turns counts into ends: each becomes the sum up to and with it. Returns the last, the size of a list of k-simplices.
/// Throws   LimitError if that exceeds `limit`
Offset accumulate_counts(std::span<Index> counts, int k, Offset limit = std::numeric_limits<Index>::max());

/// Finds the k-simplex with the sorted vertices `tuple` between `begin` and `end` of the lexicographic list `simplices`
/// (k+1 ids a row, all with the right first vertex), through `order` if the list itself is not sorted. -1 if absent.
Index find_in_bucket(std::span<const Index> simplices, std::span<const Index> order, Index begin, Index end,
                     std::span<const Index> tuple) noexcept;

}  // namespace derham
