#include "derham/complex/orientation.hpp"

#include "derham/complex/one_sided_walk.hpp"
#include "derham/complex/signed_trees.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/bulk_array.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace derham {
namespace {

constexpr Index prefetch_distance = 16;  // top simplices

/// What is known of a facet: untouched; closed, when no more is to be learnt from it; or else 2 more than the word of its
/// first coface, the bit being that coface's entry in the facet's row of the boundary matrix.
using Word = SignedTrees::Word;
constexpr Word untouched = 0, closed = 1, first_word = 2;

/// Every top simplex as the word of a tree: `tree[t]` is odd if its sign is not the preferred one.
struct Growth {
  BulkArray<Word> tree;
  SignedTrees trees;
  bool reversing = false;  // some word is odd
  bool crowded = false;    // some facet had been closed already when a coface came
};

/// Visits the top simplices in order. One joins the tree of its first neighbour that was visited before, with the sign
/// that is coherent with it; trees that it touches besides are the same set. So a facet is looked up twice and a
/// neighbour never, and in an order in which neighbours follow each other few trees arise.
template <int n>
Growth grow(const SimplicialComplex<n>& K, std::span<const Sign> preferred, BulkArray<Word> facet_state) {
  const Index tops = K.size(n);
  Growth result;
  result.tree = BulkArray<Word>(preferred.size());
  for (Index t = 0; t < tops; ++t) {
    for (const Index f : K.template faces<n>(t + std::min(prefetch_distance, tops - 1 - t)))
      __builtin_prefetch(&facet_state[static_cast<std::size_t>(f)], 1);
    const auto row = K.template faces<n>(t);
    const std::size_t negative = preferred[static_cast<std::size_t>(t)] < 0 ? 1 : 0;
    const auto entry = [negative](std::size_t j) { return static_cast<Word>((j ^ negative) & 1); };
    std::array<Word, n + 1> state{};
    bool planted = false;
    Word mine = 0;
    for (std::size_t j = 0; j <= n; ++j) {
      state[j] = facet_state[static_cast<std::size_t>(row[j])];
      if (state[j] == closed) result.crowded = true;
      if (state[j] < first_word) continue;
      const Word coherent = (state[j] - first_word) ^ entry(j) ^ 1;
      if (!planted)
        mine = coherent;
      else if (coherent != mine)
        result.trees.unite(mine, coherent);
      planted = true;
    }
    if (!planted) mine = result.trees.plant();
    result.tree[static_cast<std::size_t>(t)] = mine;
    result.reversing = result.reversing || (mine & 1) != 0;
    for (std::size_t j = 0; j <= n; ++j)
      facet_state[static_cast<std::size_t>(row[j])] = state[j] == untouched ? first_word + (mine ^ entry(j)) : closed;
  }
  result.trees.settle();
  return result;
}

template <int n>
BulkArray<Word> untouched_facets(const SimplicialComplex<n>& K) {
  BulkArray<Word> state(static_cast<std::size_t>(K.size(n - 1)));
  std::ranges::fill(state, untouched);
  return state;
}

/// Closed where a facet has more than two cofaces, else untouched.
template <int n>
BulkArray<Word> crowded_facets(const SimplicialComplex<n>& K) {
  auto state = untouched_facets(K);
  std::vector<std::uint8_t> cofaces(state.size(), 0);
  for (const Index f : K.face_table(n))
    if (auto& count = cofaces[static_cast<std::size_t>(f)]; count < 3 && ++count == 3)
      state[static_cast<std::size_t>(f)] = closed;
  return state;
}

/// The number of every top simplex' component.
std::vector<Index> numbered_components(Growth& growth) {
  std::vector<Index> of_tree(static_cast<std::size_t>(growth.trees.size())), component(growth.tree.size());
  Index components = 0;
  for (Index tree = 0; tree < growth.trees.size(); ++tree) {
    const auto root = static_cast<Index>(growth.trees.root(2 * static_cast<Word>(tree)) / 2);
    of_tree[static_cast<std::size_t>(tree)] = root == tree ? components++ : of_tree[static_cast<std::size_t>(root)];
  }
  for (std::size_t t = 0; t < component.size(); ++t)
    component[t] = of_tree[static_cast<std::size_t>(growth.tree[t] / 2)];
  return component;
}

/// The tops as trees; without facets each is its own.
template <int n>
Growth growth(const SimplicialComplex<n>& K, std::span<const Sign> preferred) {
  if constexpr (n == 0) {
    Growth result;
    result.tree = BulkArray<Word>(preferred.size());
    for (Word& tree : result.tree) tree = result.trees.plant();
    return result;
  } else {
    Growth result = grow(K, preferred, untouched_facets(K));
    return result.crowded ? grow(K, preferred, crowded_facets(K)) : std::move(result);
  }
}

}  // namespace

template <int n>
Orientation coherent_orientation(const SimplicialComplex<n>& K, std::span<const Sign> preferred) {
  if (preferred.size() != static_cast<std::size_t>(K.size(n)))
    throw InputError(text("there are ", preferred.size(), " preferred signs for ", K.size(n), " top simplices"));
  for (const Sign sign : preferred)
    if (sign != 1 && sign != -1) throw InputError(text("preferred sign is ", int{sign}, "; it must be +1 or -1"));

  Growth grown = growth(K, preferred);
  Orientation result;
  result.orientable = !grown.trees.contradictory();
  if (result.orientable) {
    result.sign.assign(preferred.begin(), preferred.end());
    const bool as_preferred = !grown.reversing && !grown.trees.reversing();
    for (std::size_t t = 0; t < result.sign.size() && !as_preferred; ++t)
      if (grown.trees.root(grown.tree[t]) & 1) result.sign[t] = static_cast<Sign>(-result.sign[t]);
  } else {
    result.sign.assign(preferred.size(), Sign{1});
    if constexpr (n > 0) result.one_sided = one_sided_walk(K);
  }
  return result;
}

template <int n>
FacetComponents facet_components(const SimplicialComplex<n>& K) {
  Growth grown = growth(K, K.orientation().sign);
  FacetComponents result;
  result.count = grown.trees.sets();
  if (result.count > 1) result.of_top = numbered_components(grown);
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                    \
  template Orientation coherent_orientation(const SimplicialComplex<n>&, std::span<const Sign>); \
  template FacetComponents facet_components(const SimplicialComplex<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
