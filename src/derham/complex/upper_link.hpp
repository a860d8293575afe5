#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <utility>
#include <vector>

namespace derham {

/// The upper link of one vertex v in an n-complex: all tuples s of vertices larger than v such that v*s is a simplex of
/// degree 1..n-1. Vertices are replaced by their rank among the upper neighbours of v; the 2-tuples are kept in a bit
/// matrix, so that their lexicographic order and position come from counting bits, longer ones (n >= 4) as sorted
/// lists. One object serves many vertices in turn: `clear` it before each, which costs only what the last one used (and
/// mends what an exception left behind).
template <int n>
class UpperLink {
 public:
  using Ranks = std::array<Index, static_cast<std::size_t>(n < 1 ? 1 : n)>;  // tuple of ranks, padded with zeros

  explicit UpperLink(Index vertex_count) : rank_(static_cast<std::size_t>(vertex_count), -1) {}

  /// The smallest tuples first: call for every suffix (the vertices after v of each top simplex), then
  /// `close_vertices`.
  void add_vertices(std::span<const Index> suffix) {
    for (const Index w : suffix) {
      if (rank_[static_cast<std::size_t>(w)] < 0) {
        neighbours_.push_back(w);
        rank_[static_cast<std::size_t>(w)] = 0;
      }
    }
  }

  void close_vertices() {
    std::ranges::sort(neighbours_);
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      rank_[static_cast<std::size_t>(neighbours_[i])] = static_cast<Index>(i);
    if constexpr (n >= 3) {
      const std::size_t m = neighbours_.size();
      words_ = m <= max_matrix_side ? (m + 63) / 64 : 0;
      bits_.assign(m * words_, 0);
    }
  }

  /// Then all tuples of 2..n-1 elements of every suffix, then `close_tuples`.
  void add_tuples(std::span<const Index> suffix) {
    const auto length = static_cast<int>(suffix.size());
    Ranks r{};
    for (int i = 0; i < length; ++i) r[static_cast<std::size_t>(i)] = rank(suffix[static_cast<std::size_t>(i)]);
    if (words_ != 0) {
      for (int i = 0; i < length; ++i)
        for (int j = i + 1; j < length; ++j)
          bits_[static_cast<std::size_t>(r[i]) * words_ + static_cast<std::size_t>(r[j]) / 64] |=
              std::uint64_t{1} << (static_cast<std::size_t>(r[j]) % 64);
    }
    for (unsigned mask = 1; n >= 3 && mask < (1u << length); ++mask) {
      const int size = std::popcount(mask);
      if (size < (words_ != 0 ? 3 : 2) || size > n - 1) continue;
      Ranks tuple{};
      for (int i = 0, j = 0; i < length; ++i)
        if (mask >> i & 1u) tuple[static_cast<std::size_t>(j++)] = r[static_cast<std::size_t>(i)];
      tuples_[static_cast<std::size_t>(size)].push_back(tuple);
    }
  }

  void close_tuples() {
    if (words_ != 0) {
      row_begin_.resize(neighbours_.size() + 1);
      row_begin_[0] = 0;
      for (std::size_t i = 0; i < neighbours_.size(); ++i) {
        Index count = 0;
        for (std::size_t w = 0; w < words_; ++w) count += std::popcount(bits_[i * words_ + w]);
        row_begin_[i + 1] = row_begin_[i] + count;
      }
    }
    for (auto& list : tuples_) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  void clear() {
    for (const Index w : neighbours_) rank_[static_cast<std::size_t>(w)] = -1;
    neighbours_.clear();
    words_ = 0;
    for (auto& list : tuples_) list.clear();
  }

  [[nodiscard]] Index rank(Index vertex) const { return rank_[static_cast<std::size_t>(vertex)]; }
  [[nodiscard]] Index vertex(Index rank) const { return neighbours_[static_cast<std::size_t>(rank)]; }

  /// Number of tuples of `size` ranks: of simplices of that degree whose first vertex is v.
  [[nodiscard]] Index count(int size) const {
    if (size == 1) return static_cast<Index>(neighbours_.size());
    if (size == 2 && words_ != 0) return row_begin_.back();
    return static_cast<Index>(tuples_[static_cast<std::size_t>(size)].size());
  }

  /// Lexicographic position of a tuple of ranks among those of its size.
  [[nodiscard]] Index position(int size, const Ranks& r) const {
    if (size == 1) return r[0];
    if constexpr (n >= 3) {
      if (size == 2 && words_ != 0) {
        const std::uint64_t* row = bits_.data() + static_cast<std::size_t>(r[0]) * words_;
        const auto word = static_cast<std::size_t>(r[1]) / 64, bit = static_cast<std::size_t>(r[1]) % 64;
        Index position = row_begin_[static_cast<std::size_t>(r[0])];
        for (std::size_t w = 0; w < word; ++w) position += std::popcount(row[w]);
        return position + std::popcount(row[word] & ((std::uint64_t{1} << bit) - 1));
      }
    }
    const auto& list = tuples_[static_cast<std::size_t>(size)];
    return static_cast<Index>(std::ranges::lower_bound(list, r) - list.begin());
  }

  /// Calls f(tuple of ranks) for all tuples of `size` ranks in lexicographic order.
  template <class F>
  void for_each(int size, F&& f) const {
    Ranks r{};
    if (size == 1) {
      for (Index i = 0; i < count(1); ++i) {
        r[0] = i;
        f(std::as_const(r));
      }
    } else if (n >= 3 && size == 2 && words_ != 0) {
      for (std::size_t i = 0; i < neighbours_.size(); ++i) {
        for (std::size_t w = 0; w < words_; ++w) {
          for (std::uint64_t row = bits_[i * words_ + w]; row != 0; row &= row - 1) {
            r[0] = static_cast<Index>(i);
            r[n >= 2 ? 1 : 0] = static_cast<Index>(w * 64 + static_cast<std::size_t>(std::countr_zero(row)));
            f(std::as_const(r));
          }
        }
      }
    } else {
      for (const auto& tuple : tuples_[static_cast<std::size_t>(size)]) f(tuple);
    }
  }

 private:
  static constexpr std::size_t max_matrix_side = 512;  // beyond, a matrix would be larger than the sorted pairs

  std::vector<Index> rank_;  // (|V|,) rank of each upper neighbour, -1 elsewhere
  std::vector<Index> neighbours_;
  std::size_t words_ = 0;  // 64-bit words per row of the matrix; 0: pairs are in tuples_[2]
  std::vector<std::uint64_t> bits_;
  std::vector<Index> row_begin_;
  std::array<std::vector<Ranks>, static_cast<std::size_t>(n < 3 ? 3 : n)> tuples_;  // [size]
};

}  // namespace derham
