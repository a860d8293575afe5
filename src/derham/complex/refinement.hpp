#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace derham {

/// The edgewise subdivision of a complex K: every k-simplex is cut into 2^k by the midpoints of its edges, n = 1 to 4. It
/// needs no coordinates and no manifold; the order of the vertices decides between the diagonals, so that simplices cut a
/// common face alike. In dimension 2 it is the red refinement. In flat simplices all pieces have the same volume, and
/// those of repeated refinements at most n!/2 shapes. K must outlive it. It stays where it is made, neither copied nor moved: the
/// next refinement, forms and operators refer to its fine complex. Orient K before: the pieces do not turn with it later.
///
/// Fine vertices are numbered in the lexicographic order of their two ends, a vertex of K being its own ends: so that the
/// order of the next refinement is that of this one, and what is near has near numbers. The pieces of top simplex t are the
/// fine top simplices 2^n t to 2^n t + 2^n - 1, oriented as t is.
/// Laws     the fine complex has the components, boundary, homology and orientability of K
/// Cost     that of the construction of the fine complex
/// Source   Freudenthal, "Simplizialzerlegungen von beschränkter Flachheit", 1942; Edelsbrunner & Grayson, "Edgewise
///          subdivision of a simplex", 2000
template <int n>
  requires(1 <= n && n <= 4)
class Refinement {
 public:
  /// Throws   LimitError if the fine lists overflow Index
  explicit Refinement(const SimplicialComplex<n>& K);
  explicit Refinement(SimplicialComplex<n>&&) = delete;
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;
  ~Refinement() = default;

  [[nodiscard]] const SimplicialComplex<n>& coarse() const noexcept { return *coarse_; }
  [[nodiscard]] const SimplicialComplex<n>& fine() const& noexcept { return fine_; }
  void fine() const&& = delete;

  /// The fine vertex at a vertex of K.
  [[nodiscard]] Index vertex(Index coarse_vertex) const noexcept {
    return vertex_[static_cast<std::size_t>(coarse_vertex)];
  }

  /// The coarse vertices whose midpoint a fine vertex is, increasing; twice the same one where it is a vertex of K.
  [[nodiscard]] std::array<Index, 2> ends(Index fine_vertex) const noexcept {
    return ends_[static_cast<std::size_t>(fine_vertex)];
  }

  /// The smallest coarse simplex that contains fine k-simplex i: in its interior, that is.
  /// Cost     a search in K
  [[nodiscard]] RowTarget carrier(int k, Index i) const noexcept;

  /// Appends the 2^k pieces of an oriented simplex of K given by any alias: k+1 fine vertices each, oriented as the alias.
  /// Throws   InputError if it is no simplex of K
  void append_pieces(std::span<const Index> alias, std::vector<Index>& out) const;

 private:
  /// The midpoint of the local vertices low <= high of a sorted simplex.
  struct Midpoint {
    std::uint8_t low = 0, high = 0;
  };
  [[nodiscard]] static std::vector<Midpoint> pieces(int k);
  void number_vertices();
  [[nodiscard]] SimplicialComplex<n> subdivided() const;

  const SimplicialComplex<n>* coarse_;
  std::array<std::vector<Midpoint>, n + 1> pieces_;  // [k]: (2^k, k+1)
  std::vector<Index> vertex_, midpoint_;             // (|V|,), (|E|,) fine vertices
  std::vector<std::array<Index, 2>> ends_;           // (|V| + |E|,)
  SimplicialComplex<n> fine_;
};

extern template class Refinement<1>;
extern template class Refinement<2>;
extern template class Refinement<3>;
extern template class Refinement<4>;

}  // namespace derham
