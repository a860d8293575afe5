#pragma once

#include "derham/core/bulk_array.hpp"
#include "derham/core/types.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace derham {

/// The top simplices of a pure n-complex as sorted tuples, and which of them have a vertex of each block: `in(p, block)`
/// lists those whose vertex number p lies in the block, in increasing order. Internal to the room.
///
/// Blocks are runs of `block_size` consecutive vertices: what belongs to one fits the second-level cache.
template <int n>
class TopBlocks {
 public:
  static constexpr int block_bits = 11;
  static constexpr Index block_size = Index{1} << block_bits;
  /// So many entries behind the end of a list may be read (and mean nothing): for those who look ahead.
  static constexpr std::size_t look_ahead = 48;

  /// `rows` (|K_n|, n+1) in any vertex order.
  TopBlocks(std::span<const Index> rows, Index vertex_count);

  /// Whether all ids lie in [0, vertex_count) and are distinct within their row. If not, there are no lists.
  [[nodiscard]] bool is_sound() const noexcept { return sound_; }

  /// Whether some top simplex ends with this vertex (those that do not are in no list for it).
  [[nodiscard]] bool is_last(Index vertex) const noexcept { return last_[static_cast<std::size_t>(vertex)] != 0; }

  [[nodiscard]] Index block_count() const noexcept { return blocks_; }
  [[nodiscard]] Index first_vertex(Index block) const noexcept { return block << block_bits; }
  /// Behind the last vertex of the block.
  [[nodiscard]] Index last_vertex(Index block) const noexcept {
    return block + 1 < blocks_ ? (block + 1) << block_bits : vertices_;
  }

  /// The top simplices t whose vertex number p = 0 or 1 lies in `block`, in increasing order: t if an even permutation
  /// sorted its row, the complement ~t if an odd one did. So whoever visits them need not look for their signs.
  [[nodiscard]] std::span<const Index> in(int p, Index block) const noexcept {
    const auto& begin = begin_[static_cast<std::size_t>(p)];
    const auto first = static_cast<std::size_t>(begin[static_cast<std::size_t>(block)]);
    return {lists_[static_cast<std::size_t>(p)].data() + first,
            static_cast<std::size_t>(begin[static_cast<std::size_t>(block) + 1]) - first};
  }
  /// The last two vertices of those whose vertex number 2 lies in `block`, for n = 3.
  [[nodiscard]] std::span<const std::array<Index, 2>> last_edges(Index block) const noexcept
    requires(n == 3)
  {
    const auto& begin = begin_[2];
    const auto first = static_cast<std::size_t>(begin[static_cast<std::size_t>(block)]);
    return {last_edges_.data() + first, static_cast<std::size_t>(begin[static_cast<std::size_t>(block) + 1]) - first};
  }
  /// How many top simplices begin in the blocks before this one.
  [[nodiscard]] Index before(Index block) const noexcept { return begin_[0][static_cast<std::size_t>(block)]; }

  /// The sorted tuples, (|K_n|, n+1), and the signs of the permutations that sorted them, (|K_n|,).
  BulkArray<Index> tuples;
  std::vector<Sign> signs;

 private:
  struct Piece;
  bool sort(std::span<const Index> rows, const Piece& piece);
  void list(const Piece& piece);

  Index vertices_, blocks_;
  bool sound_ = false;
  std::vector<char> last_;                      // (|V|,)
  std::array<std::vector<Index>, n> begin_;     // [p]: (blocks + 1,)
  std::array<BulkArray<Index>, 2> lists_;       // [p]: (|K_n|,)
  BulkArray<std::array<Index, 2>> last_edges_;  // (|K_n|,) for n = 3
};

}  // namespace derham
