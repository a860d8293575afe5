#pragma once

#include "derham/core/bulk_array.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace derham {

/// The top simplices of a pure n-complex as sorted tuples, and which of them have a vertex of each block. Internal to the
/// room.
///
/// Blocks are runs of `block_size` consecutive vertices: what belongs to one fits the second-level cache. Where the top
/// simplices of a block stand near each other, they are read where they are. Else the lists hold copies of them, so that
/// whoever reads a block reads one run of memory.
template <int n>
class TopBlocks {
 public:
  static constexpr int block_bits = 9;
  static constexpr Index block_size = Index{1} << block_bits;

  /// `rows` (|K_n|, n+1) in any vertex order.
  TopBlocks(std::span<const Index> rows, Index vertex_count);

  /// Whether all ids lie in [0, vertex_count) and are distinct within their row. If not, there are no lists.
  [[nodiscard]] bool is_sound() const noexcept { return sound_; }

  /// Whether some top simplex ends with this vertex (those that do not are in no list for it).
  [[nodiscard]] bool is_last(Index vertex) const noexcept { return last_[static_cast<std::size_t>(vertex)] != 0; }

  /// Whether the top simplices of a block stand near each other.
  [[nodiscard]] bool is_local() const noexcept { return local_; }

  [[nodiscard]] Index block_count() const noexcept { return blocks_; }
  [[nodiscard]] Index first_vertex(Index block) const noexcept { return block << block_bits; }
  /// Behind the last vertex of the block.
  [[nodiscard]] Index last_vertex(Index block) const noexcept {
    return block + 1 < blocks_ ? (block + 1) << block_bits : vertices_;
  }

  /// How many top simplices have their vertex number p < n in a block.
  [[nodiscard]] Index count(int p, Index block) const noexcept { return end(p, block) - end(p, block - 1); }
  /// body(vertices, entry) for each of them, in increasing order: its vertices from number p on, and for p = 0 and 1 its own
  /// number t if an even permutation sorted its row, the complement ~t if an odd one did.
  template <int p, class Body>
  void for_each(Index block, Body&& body) const {
    const Index* const list = lists_[p].data();
    const auto first = static_cast<std::size_t>(end(p, block - 1)), last = static_cast<std::size_t>(end(p, block));
    for (std::size_t i = first; i < last; ++i) {
      if (local_) {
        const auto t = static_cast<std::size_t>(list[i]);
        body(tuples.data() + t * (n + 1) + p, signs[t] < 0 ? ~list[i] : list[i]);
      } else {
        body(list + i * width(p), p < 2 ? list[(i + 1) * width(p) - 1] : Index{0});
      }
    }
  }
  /// The top simplex of an entry.
  [[nodiscard]] static Index top_of(Index entry) noexcept { return entry < 0 ? ~entry : entry; }

  /// How many top simplices begin in the blocks before this one.
  [[nodiscard]] Index before(Index block) const noexcept { return end(0, block - 1); }

  /// The sorted tuples, (|K_n|, n+1), and the signs of the permutations that sorted them, (|K_n|,).
  BulkArray<Index> tuples;
  std::vector<Sign> signs;

 private:
  struct Piece;
  /// Of a copy: the vertices number p to n, and the entry for p = 0 and 1.
  static constexpr std::size_t width(int p) noexcept { return static_cast<std::size_t>(n + 1 - p + (p < 2)); }
  bool sort(std::span<const Index> rows, const Piece& piece);
  void count(const Piece& piece, const Index* v);
  template <int p>
  void list(const Piece& piece, std::size_t t);
  [[nodiscard]] Index end(int p, Index block) const noexcept {
    return end_[static_cast<std::size_t>(p)][static_cast<std::size_t>(block + 1)];
  }

  Index vertices_, blocks_;
  bool sound_ = false, local_ = false;
  std::vector<char> last_;                 // (|V|,)
  std::array<std::vector<Index>, n> end_;  // [p]: 0, then (blocks,) where the list of each block ends
  std::array<BulkArray<Index>, n> lists_;  // [p]: (|K_n|,) top simplices, or (|K_n|, width(p)) copies
};

}  // namespace derham
