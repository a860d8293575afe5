#pragma once

#include "derham/complex/top_blocks.hpp"
#include "derham/complex/upper_link.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace derham {

/// The upper links of one block of vertices after the other, for n = 2 and 3: the edges and triangles that begin at the
/// vertices of the block, in lexicographic order, and which of them are faces of which top simplex. All numbers count from
/// the first edge (triangle) of the block. Internal to the room.
///
/// The few upper neighbours of a vertex are numbered as they are met, then ranked by counting which are smaller; a triangle
/// is a pair of ranks, a bit of a small matrix, so that reading the bits in order lists the triangles in order. Up to 16
/// neighbours nothing but the number of simplices decides where a branch goes. Vertices with very many neighbours go
/// through UpperLink, which has no limits. Each step is done for all vertices of the block before the next one begins.
template <int n>
class BlockLinks {
  static_assert(n == 2 || n == 3);

 public:
  BlockLinks(const TopBlocks<n>& tops, Index vertex_count);

  /// Throws   LimitError if the triangles of the block could be too many for an Index
  void find(Index block);

  /// Local vertices v of the block: their edges are [edge_begin()[v], edge_begin()[v + 1]), and so on.
  [[nodiscard]] std::span<const Index> edge_begin() const noexcept { return edge_begin_; }
  [[nodiscard]] std::span<const Index> triangle_begin() const noexcept { return triangle_begin_; }
  [[nodiscard]] std::span<const Index> top_begin() const noexcept { return groups_[0].begin; }
  [[nodiscard]] Index edge_count() const noexcept { return edge_begin_.back(); }
  [[nodiscard]] Index triangle_count() const noexcept { return triangle_begin_.back(); }

  /// The second vertex of every edge.
  [[nodiscard]] const Index* neighbours() const noexcept { return neighbours_.data(); }
  /// The triangles as tuples, and their faces as in the face table, of which the last means nothing yet.
  [[nodiscard]] const Index* triangles() const noexcept { return triangles_.data(); }
  [[nodiscard]] const Index* triangle_faces() const noexcept { return triangle_faces_.data(); }

  /// The top simplices whose vertex number p = 0, 1 lies in the block, in some order, as entries of TopBlocks; and their
  /// faces that begin with that vertex: n of each for p = 0, as in the face table; the last of the face table for p = 1.
  [[nodiscard]] std::span<const Index> tops(std::size_t p) const noexcept { return groups_[p].top; }
  [[nodiscard]] const Index* top_faces(std::size_t p) const noexcept { return groups_[p].faces.data(); }

  /// The top simplices that begin in the block, in lexicographic order.
  [[nodiscard]] std::span<const Index> order() const noexcept { return order_; }

  /// Whether some vertex of the block belongs to no top simplex, or two top simplices are the same.
  [[nodiscard]] bool has_defect() const noexcept { return defect_; }

  /// Whether all facets of the blocks so far have one coface, or two that induce opposite orientations when top simplices
  /// have the signs of their rows.
  [[nodiscard]] bool is_coherent() const noexcept { return coherent_; }

 private:
  /// The top simplices whose vertex number p lies in the block, grouped by that vertex.
  struct Group {
    std::vector<Index> begin;          // (vertices + 1,)
    std::vector<Index> rest;           // (count, n - p): the vertices behind
    std::vector<std::uint8_t> number;  // (count, n - p): 1 + the numbers of those, for p = 0 and 1
    std::vector<Index> top;            // (count,) entries, for p = 0 and 1
    std::vector<Index> faces;          // see top_faces
  };
  /// The part of a group that belongs to one vertex.
  struct Star {
    Index begin, count;
  };
  using Stars = std::array<Star, n>;

  template <int p>
  void group(Index block);
  void make_room(Index vertices);
  [[nodiscard]] Stars stars(Index v) const;

  template <bool many>
  void number_neighbours(const Stars& stars);
  template <int side>
  void rank_neighbours();
  template <int side>
  void small_link(Index vertex, const Stars& stars);
  template <int side>
  void add_triangles(Index vertex, const std::array<std::uint64_t, std::size_t{side} * side / 64>& pairs);
  void order_tops(Star star);

  void large_link(Index vertex, const Stars& stars);
  void add_triangle(Index vertex, Index i, Index j);
  void sort_tops(Star star);
  void judge_facets(const Stars& stars, Index first, Index count);

  const TopBlocks<n>& all_;
  Index vertex_count_;
  std::array<Group, n> groups_;
  std::vector<Index> edge_begin_, triangle_begin_, neighbours_, triangles_, triangle_faces_, order_;
  std::vector<std::uint8_t> rank_;  // of each neighbour, in the order in which they were met
  std::vector<std::int32_t> key_;   // of each top simplex that begins in the block: the ranks of its vertices
  bool defect_ = false, coherent_ = true;

  // Of the vertex at hand.
  Index edges_ = 0, triangles_found_ = 0;   // before it
  Index degree_ = 0;                        // number of its upper neighbours
  std::vector<std::uint8_t> number_;        // (|V|,) 1 + the number of a neighbour, 0 elsewhere
  std::vector<Index> next_;                 // where the next of each vertex goes
  std::vector<Index> position_;             // the numbers of its triangles, by pair of ranks
  std::vector<std::uint8_t> facet_states_;  // see judge_facets
  std::unique_ptr<UpperLink<n>> large_;     // only when needed
};

}  // namespace derham
