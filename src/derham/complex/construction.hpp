#pragma once

#include "derham/complex/simplicial_complex.hpp"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace derham {

template <int n>
class UpperLink;
template <int n>
class BlockLinks;

/// What the rows of the input say of the signs of the top simplices.
struct RowSigns {
  std::vector<Sign> sign;  ///< (|K_n|,) of the permutation that sorts the row
  /// No facet has more than two cofaces, and with these signs the two entries of its row are opposite: they are the
  /// orientation. False may mean that nobody looked.
  bool coherent = false;
};

/// Fills the lists and tables of a complex. Internal to the room: use the constructor of SimplicialComplex.
template <int n>
class ComplexBuilder {
 public:
  /// Fills K from rows whose largest dimension is n and that hold at least `vertices` ids; `vertex_count` is what was asked
  /// for, -1 if nothing was. Returns, for every top simplex, the sign of the permutation that sorts its row.
  /// Throws   InputError for rows that are not sound, LimitError
  static RowSigns build(SimplicialComplex<n>& K, const SimplexList& rows, Index vertices, Index vertex_count);

 private:
  /// All rows of dimension n = 2 or 3: blocks of vertices, each looked at once.
  static RowSigns build_blocks(SimplicialComplex<n>& K, const SimplexList& rows, Index vertices, Index vertex_count)
    requires(n == 2 || n == 3);
  static void write_block(SimplicialComplex<n>& K, const BlockLinks<n>& links, Index first_vertex,
                          const std::array<Index, 3>& first, bool local);
  template <bool local>
  static void find_last_sides(SimplicialComplex<n>& K, Index triangles);

  /// All rows of dimension n, whatever it is.
  static RowSigns build_pure(SimplicialComplex<n>& K, const SimplexList& rows, Index vertex_count);

  /// Rows of several dimensions, the largest n: sort and unique, degree by degree.
  static RowSigns build_mixed(SimplicialComplex<n>& K, const SimplexList& rows, Index vertex_count);

  static void fill_lists(SimplicialComplex<n>& K, const UpperLink<n>& link, Index v);
  static void fill_top_faces(SimplicialComplex<n>& K, const UpperLink<n>& link, Index v, std::span<const Index> suffix,
                             Index top);
  static void fill_last_faces(SimplicialComplex<n>& K, int k);
};

/// total + count. Throws LimitError if that is more than `limit` simplices of degree k.
Offset add_count(Offset total, Index count, int k, Offset limit = std::numeric_limits<Index>::max());

/// Turns counts into ends: each becomes the sum up to and with it. Returns the last, the size of a list of k-simplices.
/// Throws   LimitError if that exceeds `limit`
Offset accumulate_counts(std::span<Index> counts, int k, Offset limit = std::numeric_limits<Index>::max());

/// Finds the k-simplex with the sorted vertices `tuple` between `begin` and `end` of the lexicographic list `simplices`
/// (k+1 ids a row, all with the right first vertex), through `order` if the list itself is not sorted. -1 if absent.
Index find_in_bucket(std::span<const Index> simplices, std::span<const Index> order, Index begin, Index end,
                     std::span<const Index> tuple) noexcept;

}  // namespace derham
