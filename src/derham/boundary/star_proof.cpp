#include "derham/boundary/star_proof.hpp"

#include "derham/core/disjoint_sets.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

namespace derham::detail {
namespace {

constexpr Index prefetch_distance = 8;  // top simplices

/// At most 15 trees, the sets of trees that are one, and the number of trees: sixteen digits of four bits. Digit i < 15 is
/// the set of tree i, the last digit how many there are.
class Trees {
 public:
  static constexpr unsigned most = 15;

  [[nodiscard]] unsigned count() const noexcept { return static_cast<unsigned>(digits_ >> 60); }

  /// A new tree; there must be fewer than `most`.
  unsigned plant() noexcept {
    const unsigned tree = count();
    digits_ += std::uint64_t{1} << 60;
    return tree;
  }

  /// Every digit that is the set of b becomes the set of a.
  void unite(unsigned a, unsigned b) noexcept {
    const std::uint64_t set_a = digit(a), set_b = digit(b);
    if (set_a == set_b) return;
    const std::uint64_t zero_where_b = digits_ ^ (set_b * ones);
    const std::uint64_t top_bits = ~(((zero_where_b & (7 * all_ones)) + 7 * all_ones) | zero_where_b) & (8 * ones);
    const std::uint64_t mask = (top_bits >> 3) * 15;
    digits_ = (digits_ & ~mask) | (set_a * ones & mask);
  }

  [[nodiscard]] bool all_one() const noexcept {
    const std::uint64_t used = (std::uint64_t{1} << (4 * count())) - 1;
    return ((digits_ ^ (digit(0) * ones)) & used) == 0;
  }

 private:
  static constexpr std::uint64_t all_ones = 0x1111'1111'1111'1111, ones = all_ones >> 4;
  [[nodiscard]] std::uint64_t digit(unsigned i) const noexcept { return digits_ >> (4 * i) & 15; }

  std::uint64_t digits_ = 0x0EDC'BA98'7654'3210;
};

/// What is known of the star of a vertex.
struct Star {
  Trees trees;
  std::make_unsigned_t<Index> twice_euler = 0;  // of the link: 2 edges - boundary facets - tets; wraps around
  bool has_boundary = false;
  bool too_many_trees = false;
};

/// 0 if no coface has come yet; closed if two have; else the trees of the first coface at the facet's vertices, a digit each.
using FacetState = std::uint16_t;
constexpr FacetState closed = 0xFFFF, one_coface = 0x8000;

template <int n>
class StarCheck {
 public:
  explicit StarCheck(const SimplicialComplex<n>& K)
      : K_(K), stars_(index(K.size(0))), facets_(index(K.size(n - 1)), FacetState{0}) {}

  StarProof run() {
    if (!visit_tops()) return {};
    const bool is_closed = count_boundary();
    for (const Index v : K_.simplices(1)) stars_[index(v)].twice_euler += 2;
    const bool sound = std::ranges::all_of(stars_, [](const Star& star) {
      return (star.too_many_trees || star.trees.all_one()) &&
             (n == 2 || star.twice_euler == (star.has_boundary ? 2 : 4));
    });
    if (!sound || !large_stars_are_connected()) return {};
    return {true, is_closed};
  }

 private:
  static std::size_t index(Index i) { return static_cast<std::size_t>(i); }

  /// The place of vertex i of a top simplex in its facet j (which omits vertex n-j).
  static constexpr int place(int i, int j) { return i < n - j ? i : i - 1; }

  void prefetch(Index t) const {
    for (const Index v : K_.template simplex<n>(t)) __builtin_prefetch(&stars_[index(v)], 1);
    for (const Index f : K_.template faces<n>(t)) __builtin_prefetch(&facets_[index(f)], 1);
  }

  /// False if a facet has more than two cofaces.
  bool visit_tops() {
    const Index tops = K_.size(n);
    bool crowded = false;
    for (Index t = 0; t < tops; ++t) {
      prefetch(t + std::min(prefetch_distance, tops - 1 - t));
      const auto faces = K_.template faces<n>(t);
      std::array<FacetState, n + 1> state{};
      for (std::size_t j = 0; j <= n; ++j) {
        state[j] = facets_[index(faces[j])];
        crowded = crowded || state[j] == closed;
      }
      const auto corners = trees_of_corners(t, state);
      for (int j = 0; j <= n; ++j) {
        unsigned first = one_coface;
        for (int i = 0; i <= n; ++i)
          if (i != n - j) first |= corners[static_cast<std::size_t>(i)] << (4 * place(i, j));
        const bool is_first = state[static_cast<std::size_t>(j)] == 0;
        facets_[index(faces[static_cast<std::size_t>(j)])] = is_first ? static_cast<FacetState>(first) : closed;
      }
    }
    return !crowded;
  }

  /// The tree of each corner of top simplex t.
  std::array<unsigned, n + 1> trees_of_corners(Index t, const std::array<FacetState, n + 1>& state) {
    constexpr unsigned none = 16;
    const auto vertices = K_.template simplex<n>(t);
    std::array<unsigned, n + 1> corners{};
    for (int i = 0; i <= n; ++i) {
      Star& star = stars_[index(vertices[static_cast<std::size_t>(i)])];
      --star.twice_euler;
      unsigned tree = none;
      for (int j = 0; j <= n; ++j) {
        const unsigned seen = state[static_cast<std::size_t>(j)];
        if (j == n - i || seen == 0) continue;
        const unsigned across = seen >> (4 * place(i, j)) & 15;
        if (tree == none)
          tree = across;
        else if (tree != across)
          star.trees.unite(tree, across);
      }
      if (tree == none) {
        star.too_many_trees = star.too_many_trees || star.trees.count() == Trees::most;
        tree = star.too_many_trees ? 0 : star.trees.plant();
      }
      corners[static_cast<std::size_t>(i)] = tree;
    }
    return corners;
  }

  /// Whether there is no boundary.
  bool count_boundary() {
    bool is_closed = true;
    for (Index f = 0; f < K_.size(n - 1); ++f) {
      if (facets_[index(f)] == closed) continue;
      is_closed = false;
      for (const Index v : K_.template simplex<n - 1>(f)) {
        --stars_[index(v)].twice_euler;
        stars_[index(v)].has_boundary = true;
      }
    }
    return is_closed;
  }

  /// Whether L~ is connected where there were too many trees: disjoint sets of corners, joined where they share a facet.
  bool large_stars_are_connected() const {
    std::vector<std::tuple<Index, Index, Index>> met;  // facet, vertex of it, corner
    Index corners = 0;
    for (Index t = 0; t < K_.size(n); ++t) {
      const auto vertices = K_.template simplex<n>(t);
      for (int i = 0; i <= n; ++i) {
        const Index v = vertices[static_cast<std::size_t>(i)];
        if (!stars_[index(v)].too_many_trees) continue;
        for (int j = 0; j <= n; ++j)
          if (j != n - i) met.emplace_back(K_.faces(n, t)[static_cast<std::size_t>(j)], v, corners);
        ++corners;
      }
    }
    std::ranges::sort(met);
    DisjointSets joined(corners);
    for (std::size_t m = 1; m < met.size(); ++m) {
      const auto& [facet, v, corner] = met[m];
      const auto& [other_facet, other_v, other_corner] = met[m - 1];
      if (facet == other_facet && v == other_v) joined.unite(corner, other_corner);
    }
    return joined.count() == std::ranges::count(stars_, true, &Star::too_many_trees);
  }

  const SimplicialComplex<n>& K_;
  std::vector<Star> stars_;
  std::vector<FacetState> facets_;
};

}  // namespace

template <int n>
  requires(n == 2 || n == 3)
StarProof prove_by_stars(const SimplicialComplex<n>& K) {
  return K.is_pure() ? StarCheck<n>(K).run() : StarProof{};
}

template StarProof prove_by_stars(const SimplicialComplex<2>&);
template StarProof prove_by_stars(const SimplicialComplex<3>&);

}  // namespace derham::detail
