#pragma once

#include "derham/complex/orientation.hpp"
#include "derham/complex/simplex.hpp"
#include "derham/complex/simplex_list.hpp"
#include "derham/core/bulk_array.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <initializer_list>
#include <span>
#include <vector>

namespace derham {

/// Where a row of the input ended up.
struct RowTarget {
  int degree = 0;
  Index index = 0;
};

/// An oriented abstract simplicial complex of dimension n (0 <= n <= 6), closed under faces, immutable but for the free
/// sign of each component. It knows no coordinates.
///
/// K_k, the list of k-simplices, holds one sorted representative each, without duplicates: vertices by id, top
/// simplices in the order of the input, every degree between in lexicographic order. The position in the list is the
/// index of the simplex in every form and matrix. Representatives of degree < n are positive; those of degree n carry
/// `sign(t)`.
///
/// Faces of a sorted simplex are stored in increasing index order, which for sorted tuples is: first the face that
/// omits the last vertex, last the face that omits the first. Position j of the table omits vertex k-j and has the
/// relative orientation (-1)^(k-j); no signs are stored.
///
/// Source   Elcott & Schröder, "Building your own DEC at home", §2, §3, §5
template <int n>
class SimplicialComplex {
  static_assert(0 <= n && n <= max_dimension);

 public:
  static constexpr int dimension = n;

  /// The empty complex.
  SimplicialComplex();

  /// The closure of `rows` (any vertex order; rows of lower dimension are allowed and make the complex non-pure; a row
  /// that is a face of another is absorbed).
  /// `vertex_count` is the number of vertices that must all be used; -1 takes 1 + the largest id.
  /// Cost     linear in rows for pure input; O(N log N) when dimensions are mixed
  /// Throws   InputError naming the first offending row: repeated vertex, the same vertex set twice, id outside
  ///          [0, vertex_count), a vertex in no row; a row of dimension > n, or none of dimension n.
  ///          LimitError when a list would overflow Index.
  explicit SimplicialComplex(const SimplexList& rows, Index vertex_count = -1);

  /// |K_k|; 0 for k outside 0..n.
  // Inlined always: GCC before 14 outlines half of it, merges the halves of different n and then believes the range of k
  // of the smallest n (GCC bug 113907), which makes loops over k endless.
  [[nodiscard, gnu::always_inline]] Index size(int k) const noexcept {
    return k < 0 || k > n
               ? 0
               : static_cast<Index>(simplices_[static_cast<std::size_t>(k)].size() / (static_cast<std::size_t>(k) + 1));
  }

  /// The sorted representative of k-simplex i: k+1 vertex ids.
  [[nodiscard]] std::span<const Index> simplex(int k, Index i) const noexcept {
    return simplices(k).subspan(static_cast<std::size_t>(i) * (static_cast<std::size_t>(k) + 1),
                                static_cast<std::size_t>(k) + 1);
  }
  template <int k>
  [[nodiscard]] std::span<const Index, k + 1> simplex(Index i) const noexcept {
    return std::span<const Index, k + 1>(simplices_[k].data() + static_cast<std::size_t>(i) * (k + 1), k + 1);
  }

  /// All representatives of degree k, shape (|K_k|, k+1) row-major.
  [[nodiscard]] std::span<const Index> simplices(int k) const noexcept {
    return simplices_[static_cast<std::size_t>(k)];
  }

  /// Indices of the k+1 faces of k-simplex i (k >= 1) in K_{k-1}; position j omits vertex k-j.
  [[nodiscard]] std::span<const Index> faces(int k, Index i) const noexcept {
    return face_table(k).subspan(static_cast<std::size_t>(i) * (static_cast<std::size_t>(k) + 1),
                                 static_cast<std::size_t>(k) + 1);
  }
  template <int k>
  [[nodiscard]] std::span<const Index, k + 1> faces(Index i) const noexcept {
    static_assert(k >= 1 && k <= n);
    return std::span<const Index, k + 1>(face_table(k).data() + static_cast<std::size_t>(i) * (k + 1), k + 1);
  }

  /// Index of the face of k-simplex i that omits its vertex number `vertex` (0..k).
  [[nodiscard]] Index face_opposite(int k, Index i, int vertex) const noexcept {
    return faces(k, i)[static_cast<std::size_t>(k - vertex)];
  }

  /// All face indices of degree k >= 1, shape (|K_k|, k+1) row-major. For k = 1 the faces (v0, v1) of an edge are its
  /// tuple.
  [[nodiscard]] std::span<const Index> face_table(int k) const noexcept {
    return k == 1 ? std::span<const Index>(simplices_[1 % (n + 1)])
                  : std::span<const Index>(faces_[static_cast<std::size_t>(k)]);
  }

  /// Index and sign of any alias: S(t) = S(P) S(P(t)). {-1, 0} if the tuple is not a simplex of K.
  /// Cost     a search among the simplices of that degree with the same first vertex
  /// Source   Elcott & Schröder, §3.2
  [[nodiscard]] SignedIndex find(std::span<const Index> alias) const noexcept;
  [[nodiscard]] SignedIndex find(std::initializer_list<Index> alias) const noexcept {
    return find(std::span<const Index>(alias.begin(), alias.size()));
  }

  /// As `find`, but throws InputError naming the tuple when it is not a simplex of K.
  [[nodiscard]] SignedIndex at(std::span<const Index> alias) const;
  [[nodiscard]] SignedIndex at(std::initializer_list<Index> alias) const {
    return at(std::span<const Index>(alias.begin(), alias.size()));
  }

  /// S(representative) of simplex i of degree k: sign(t) for k = n, else +1.
  [[nodiscard]] Sign sign(int k, Index i) const noexcept {
    return k == n ? orientation_.sign[static_cast<std::size_t>(i)] : Sign{1};
  }
  [[nodiscard]] const Orientation& orientation() const noexcept { return orientation_; }
  [[nodiscard]] bool is_orientable() const noexcept { return orientation_.orientable; }

  /// Fixes the free sign of each component: where the sum over the component of sign(t)*weight[t] is negative the
  /// component is reversed. `weight` (|K_n|,) is the signed volume of the representatives when n = m; a component whose
  /// sum is zero (to 1e-10 of the sum of absolute values) keeps its sign. Does nothing when K is not orientable.
  /// Throws   InputError if weight has another size
  void orient_by(std::span<const double> weight);

  /// Whether every maximal simplex has dimension n.
  [[nodiscard]] bool is_pure() const noexcept { return maximal_lower_.empty(); }

  /// The maximal simplices of degree < n (each a degree and an index), empty iff pure.
  [[nodiscard]] std::span<const RowTarget> maximal_lower() const noexcept { return maximal_lower_; }

  /// Where row i of the input ended up. For pure input that is {n, i}.
  [[nodiscard]] RowTarget row_target(Offset row) const noexcept {
    return rows_.empty() ? RowTarget{n, static_cast<Index>(row)} : rows_[static_cast<std::size_t>(row)];
  }

  /// Number of connected components of the whole complex (rank of H_0).
  [[nodiscard]] Index component_count() const;

  /// Sum over k of (-1)^k |K_k|.
  [[nodiscard]] Offset euler_characteristic() const noexcept;

 private:
  template <int>
  friend class ComplexBuilder;

  std::array<BulkArray<Index>, n + 1> simplices_;  // [k]: (|K_k|, k+1)
  std::array<BulkArray<Index>, n + 1> faces_;      // [k]: (|K_k|, k+1) for k >= 2
  std::array<std::vector<Index>, n + 1> buckets_;  // [k]: (|V|+1,) k-simplices by first vertex, k >= 1
  BulkArray<Index> top_order_;                     // degree n in lexicographic order; empty if already sorted
  std::vector<RowTarget> rows_;                    // only when the input mixes dimensions
  std::vector<RowTarget> maximal_lower_;
  Orientation orientation_;
};

extern template class SimplicialComplex<0>;
extern template class SimplicialComplex<1>;
extern template class SimplicialComplex<2>;
extern template class SimplicialComplex<3>;
extern template class SimplicialComplex<4>;
extern template class SimplicialComplex<5>;
extern template class SimplicialComplex<6>;

}  // namespace derham
