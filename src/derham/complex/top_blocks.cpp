#include "derham/complex/top_blocks.hpp"

#include "derham/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

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

// Four tuples of tetrahedra at once, beside each other; `odd` is -1 where an odd permutation sorted them, else 0.
struct FourTuples {
  using Four [[gnu::vector_size(4 * sizeof(Index))]] = Index;
  Four a{}, b{}, c{}, d{}, odd{};

  explicit FourTuples(const Index* rows) {
    std::memcpy(&a, rows, sizeof a), std::memcpy(&b, rows + 4, sizeof b);
    std::memcpy(&c, rows + 8, sizeof c), std::memcpy(&d, rows + 12, sizeof d);
    transpose();
    order(a, b), order(c, d), order(a, c), order(b, d), order(b, c);
  }
  // Whether all ids are at least 0, less than `bound`, and distinct within their tuple.
  [[nodiscard]] bool are_sound(Index bound) const {
    const Four flaw = (a < 0) | (d >= bound) | (a == b) | (b == c) | (c == d);
    return (flaw[0] | flaw[1] | flaw[2] | flaw[3]) == 0;
  }
  void store(Index* tuples, Sign* signs) {
    transpose();
    std::memcpy(tuples, &a, sizeof a), std::memcpy(tuples + 4, &b, sizeof b);
    std::memcpy(tuples + 8, &c, sizeof c), std::memcpy(tuples + 12, &d, sizeof d);
    for (int i = 0; i < 4; ++i) signs[i] = static_cast<Sign>(1 + 2 * odd[i]);
  }

 private:
  void order(Four& x, Four& y) {
    const Four swap = y < x, change = (x ^ y) & swap;
    x ^= change, y ^= change, odd ^= swap;
  }
  void transpose() {
    const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), ba = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four cd = __builtin_shufflevector(c, d, 0, 4, 1, 5), dc = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), b = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    c = __builtin_shufflevector(ba, dc, 0, 1, 4, 5), d = __builtin_shufflevector(ba, dc, 2, 3, 6, 7);
  }
};

}  // namespace

// A run of top simplices that one thread treats. `count[p * blocks + b]` is how many of them have their vertex number p in
// block b, later where the next of them goes in the list of p.
template <int n>
struct TopBlocks<n>::Piece {
  std::size_t begin, end, blocks;
  Index* count;
};

template <int n>
TopBlocks<n>::TopBlocks(std::span<const Index> rows, Index vertex_count)
    : tuples(rows.size()), signs(rows.size() / (n + 1)), vertices_(vertex_count),
      blocks_((vertex_count + block_size - 1) >> block_bits), last_(static_cast<std::size_t>(vertex_count), 0) {
  // The pieces do not depend on the number of threads, and are few, so that their counts are.
  const std::size_t size = signs.size(), longest = std::max(size / 64 + 1, std::size_t{1} << 12);
  const auto blocks = static_cast<std::size_t>(blocks_);
  std::vector<Index> counts((size / longest + 1) * n * blocks, 0);
  std::vector<Piece> pieces;
  for (std::size_t begin = 0; begin < size; begin += longest)
    pieces.push_back({begin, std::min(size, begin + longest), blocks, counts.data() + pieces.size() * n * blocks});
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

  std::size_t runs = 0;  // of the pieces, how many blocks each has simplices of
  for (std::size_t p = 0; p < n; ++p) {
    Index sum = 0;
    end_[p].push_back(0);
    for (std::size_t b = 0; b < blocks; ++b) {
      for (const Piece& piece : pieces) {
        const Index count = piece.count[p * blocks + b];
        runs += p == 0 && count != 0;
        piece.count[p * blocks + b] = sum;
        sum += count;
      }
      end_[p].push_back(sum);
    }
  }
  local_ = runs <= 4 * (pieces.size() + blocks);
  for (int p = 0; p < n; ++p) lists_[static_cast<std::size_t>(p)] = BulkArray<Index>(size * (local_ ? 1 : width(p)));
  for_pieces([&](const Piece& piece) {
    for (std::size_t t = piece.begin; t < piece.end; ++t) {
      list<0>(piece, t);
      list<1>(piece, t);
      if constexpr (n == 3) list<2>(piece, t);
    }
  });
}

// Sorts the tuples of a piece and counts them by block; whether they are sound.
template <int n>
bool TopBlocks<n>::sort(std::span<const Index> rows, const Piece& piece) {
  std::size_t t = piece.begin;
  if constexpr (n == 3) {
    for (; t + 4 <= piece.end; t += 4) {
      FourTuples four(rows.data() + t * 4);
      if (!four.are_sound(vertices_)) return false;
      four.store(tuples.data() + t * 4, signs.data() + t);
      for (std::size_t i = t; i < t + 4; ++i) count(piece, tuples.data() + i * 4);
    }
  }
  for (; t < piece.end; ++t) {
    Index v[n + 1];
    std::copy_n(rows.data() + t * (n + 1), n + 1, v);
    signs[t] = sort_tuple<n>(v);
    bool sound = v[0] >= 0 && v[n] < vertices_;
    for (int i = 0; i < n; ++i) sound &= v[i] < v[i + 1];
    if (!sound) return false;
    std::copy_n(v, n + 1, tuples.data() + t * (n + 1));
    count(piece, v);
  }
  return true;
}

template <int n>
void TopBlocks<n>::count(const Piece& piece, const Index* v) {
  for (std::size_t p = 0; p < n; ++p) ++piece.count[p * piece.blocks + static_cast<std::size_t>(v[p] >> block_bits)];
  // Several threads may write the same, so the access must be atomic; usually the mark is there already.
  const std::atomic_ref<char> mark(last_[static_cast<std::size_t>(v[n])]);
  if (mark.load(std::memory_order_relaxed) == 0) mark.store(1, std::memory_order_relaxed);
}

template <int n>
template <int p>
void TopBlocks<n>::list(const Piece& piece, std::size_t t) {
  const Index* const v = tuples.data() + t * (n + 1);
  const auto top = static_cast<Index>(t);
  const auto next =
      static_cast<std::size_t>(piece.count[p * piece.blocks + static_cast<std::size_t>(v[p] >> block_bits)]++);
  if (local_) {
    lists_[p][next] = top;
  } else {
    Index* const copy = lists_[p].data() + next * width(p);
    __builtin_prefetch(copy + 16, 1);  // the next to come here must not wait for memory
    std::copy(v + p, v + n + 1, copy);
    if (p < 2) copy[width(p) - 1] = signs[t] < 0 ? ~top : top;
  }
}

template class TopBlocks<2>;
template class TopBlocks<3>;

}  // namespace derham
