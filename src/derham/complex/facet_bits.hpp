#pragma once

#include "derham/core/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace derham {

/// The facets met at a vertex, each a bit of `words` words: apart for the entries +1 and -1 of its cofaces in the boundary
/// matrix. Internal to the room.
template <std::size_t words>
class FacetBits {
 public:
  /// One more coface of the facet x, with the entry +1. If `odd` has all bits set, and not none, with -1.
  void add(Index x, std::uint64_t odd) { add_bits(word(x), bit(x), 0, odd); }
  /// One more coface of x with +1 and of y with -1, or the other way round.
  void add(Index x, Index y, std::uint64_t odd) {
    if constexpr (words == 1)
      add_bits(0, bit(x), bit(y), odd);
    else
      add(x, odd), add(y, ~odd);
  }
  /// One more coface of x, y, z with -1, +1, -1, or the other way round.
  void add(Index x, Index y, Index z, std::uint64_t odd) {
    if constexpr (words == 1)
      add_bits(0, bit(y), bit(x) | bit(z), odd);
    else
      add(x, ~odd), add(y, odd), add(z, ~odd);
  }

  /// Whether no facet was met twice with the same entry.
  [[nodiscard]] bool are_coherent() const noexcept { return repeated_ == 0; }
  /// The facets of a word that were met.
  [[nodiscard]] std::uint64_t met(std::size_t word) const noexcept { return plus_[word] | minus_[word]; }

 private:
  static std::size_t word(Index facet) noexcept { return words == 1 ? 0 : static_cast<std::size_t>(facet) / 64; }
  // Read from a table: without the instructions of newer processors a shift by a variable takes three.
  static std::uint64_t bit(Index facet) noexcept { return bits[static_cast<std::size_t>(facet) % 64]; }
  static constexpr std::array<std::uint64_t, 64> bits = [] {
    std::array<std::uint64_t, 64> values{};
    for (std::size_t i = 0; i < 64; ++i) values[i] = std::uint64_t{1} << i;
    return values;
  }();

  void add_bits(std::size_t word, std::uint64_t plus, std::uint64_t minus, std::uint64_t odd) {
    const std::uint64_t exchanged = (plus ^ minus) & odd;
    plus ^= exchanged;
    minus ^= exchanged;
    repeated_ |= (plus_[word] & plus) | (minus_[word] & minus);
    plus_[word] |= plus;
    minus_[word] |= minus;
  }

  std::array<std::uint64_t, words> plus_{}, minus_{};
  std::uint64_t repeated_ = 0;
};

}  // namespace derham
