#include "derham/complex/top_blocks.hpp"

#include "derham/core/parallel.hpp"

#include <algorithm>
#include <atomic>

namespace derham {
namespace {

// Sorts a tuple by a network without branches; returns the sign of the permutation.
template <int n>
Sign sort_tuple(Index* v) {
  unsigned odd = 0;
  const auto order = [&](int i, int j) {
    const Index a = v[i], b = v[j];
    const bool swap = b < a;
    odd ^= static_cast<unsigned>(swap);
    v[i] = swap ? b : a;
    v[j] = swap ? a : b;
  };
  if constexpr (n == 2) {
    order(0, 1), order(1, 2), order(0, 1);
  } else {
    order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  }
  return odd != 0 ? Sign{-1} : Sign{1};
}

}  // namespace

// A run of top simplices that one thread treats. `count[p * blocks + b]` is how many of them have their vertex number p in
// block b, later where the next of them goes in the list of p.
template <int n>
struct TopBlocks<n>::Piece {
  std::size_t begin, end;
  Index* count;
};

template <int n>
TopBlocks<n>::TopBlocks(std::span<const Index> rows, Index vertex_count)
    : tuples(rows.size()), signs(rows.size() / (n + 1)), vertices_(vertex_count),
      blocks_((vertex_count + block_size - 1) >> block_bits), last_(static_cast<std::size_t>(vertex_count), 0) {
  // The pieces do not depend on the number of threads, and are few, so that their counts are.
  const std::size_t size = signs.size(), longest = std::max(size / 64 + 1, std::size_t{1} << 14);
  const auto blocks = static_cast<std::size_t>(blocks_);
  std::vector<Index> counts((size / longest + 1) * n * blocks, 0);
  std::vector<Piece> pieces;
  for (std::size_t begin = 0; begin < size; begin += longest)
    pieces.push_back({begin, std::min(size, begin + longest), counts.data() + pieces.size() * n * blocks});
  const auto for_pieces = [&](auto&& body) {
    parallel_blocks(static_cast<Offset>(pieces.size()), 1,
                    [&](Offset i, Offset) { body(pieces[static_cast<std::size_t>(i)]); });
  };

  std::atomic<bool> sound{true};
  for_pieces([&](const Piece& piece) {
    if (!sort(rows, piece)) sound = false;
  });
  sound_ = sound;
  if (!sound_) return;

  for (std::size_t p = 0; p < n; ++p) {
    Index sum = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      begin_[p].push_back(sum);
      for (const Piece& piece : pieces) {
        const Index count = piece.count[p * blocks + b];
        piece.count[p * blocks + b] = sum;
        sum += count;
      }
    }
    begin_[p].push_back(sum);
    if (p == 2) {
      last_edges_ = BulkArray<std::array<Index, 2>>(size);
    } else {
      lists_[p] = BulkArray<Index>(size + look_ahead);
      std::fill(lists_[p].end() - look_ahead, lists_[p].end(), Index{0});
    }
  }
  for_pieces([&](const Piece& piece) { list(piece); });
}

// Sorts the tuples of a piece and counts them by block; whether they are sound.
template <int n>
bool TopBlocks<n>::sort(std::span<const Index> rows, const Piece& piece) {
  const auto blocks = static_cast<std::size_t>(blocks_);
  for (std::size_t t = piece.begin; t < piece.end; ++t) {
    Index v[n + 1];
    std::copy_n(rows.data() + t * (n + 1), n + 1, v);
    signs[t] = sort_tuple<n>(v);
    bool sound = v[0] >= 0 && v[n] < vertices_;
    for (int i = 0; i < n; ++i) sound &= v[i] < v[i + 1];
    if (!sound) return false;
    for (std::size_t p = 0; p < n; ++p) ++piece.count[p * blocks + static_cast<std::size_t>(v[p] >> block_bits)];
    // Several threads may write the same, so the access must be atomic; usually the mark is there already.
    const std::atomic_ref<char> mark(last_[static_cast<std::size_t>(v[n])]);
    if (mark.load(std::memory_order_relaxed) == 0) mark.store(1, std::memory_order_relaxed);
    std::copy_n(v, n + 1, tuples.data() + t * (n + 1));
  }
  return true;
}

template <int n>
void TopBlocks<n>::list(const Piece& piece) {
  const auto blocks = static_cast<std::size_t>(blocks_);
  for (std::size_t t = piece.begin; t < piece.end; ++t) {
    const Index* v = tuples.data() + t * (n + 1);
    const Index entry = signs[t] < 0 ? ~static_cast<Index>(t) : static_cast<Index>(t);
    const auto next = [&](std::size_t p) {
      return static_cast<std::size_t>(piece.count[p * blocks + static_cast<std::size_t>(v[p] >> block_bits)]++);
    };
    lists_[0][next(0)] = entry;
    lists_[1][next(1)] = entry;
    if constexpr (n == 3) last_edges_[next(2)] = {v[2], v[3]};
  }
}

template class TopBlocks<2>;
template class TopBlocks<3>;

}  // namespace derham
