#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

/// Random input for complexes, always sound: no vertex twice in a row, no vertex set twice, no unused id. Every
/// function depends on its seed alone; print the seed when a test fails.
namespace derham::support {

using Rows = std::vector<std::vector<Index>>;
using Random = std::mt19937_64;

inline int uniform(Random& random, int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }

inline SimplexList simplex_list(const Rows& rows) {
  SimplexList list;
  for (const auto& row : rows) list.push_back(row);
  return list;
}

/// The same simplices: each tuple and the list of rows shuffled.
inline Rows reordered(Rows rows, Random& random) {
  for (auto& row : rows) std::ranges::shuffle(row, random);
  std::ranges::shuffle(rows, random);
  return rows;
}

/// The rows with equal vertex sets removed, the ids that are used renumbered 0, 1, … at random, and all reordered.
inline Rows shuffled(Rows rows, Random& random) {
  std::set<std::vector<Index>> unique;
  std::map<Index, Index> renumbered;
  for (auto& row : rows) {
    std::ranges::sort(row);
    unique.insert(row);
    for (const Index v : row) renumbered[v] = 0;
  }
  std::vector<Index> ids(renumbered.size());
  std::iota(ids.begin(), ids.end(), Index{0});
  std::ranges::shuffle(ids, random);
  for (std::size_t i = 0; auto& [old_id, new_id] : renumbered) new_id = ids[i++];
  rows.assign(unique.begin(), unique.end());
  for (auto& row : rows)
    for (Index& v : row) v = renumbered.at(v);
  return reordered(rows, random);
}

/// `size` distinct ids of [low, high).
inline std::vector<Index> subset(int size, int low, int high, Random& random) {
  std::set<Index> chosen;
  while (static_cast<int>(chosen.size()) < size) chosen.insert(uniform(random, low, high - 1));
  return {chosen.begin(), chosen.end()};
}

/// A few n-simplices on a few vertices: mostly non-manifold, sometimes in several components.
inline Rows random_pure(int n, Random& random) {
  const int vertices = n + 1 + uniform(random, 0, 6), count = uniform(random, 1, 4 * (n + 1));
  Rows rows;
  for (int i = 0; i < count; ++i) rows.push_back(subset(n + 1, 0, vertices, random));
  return shuffled(rows, random);
}

/// Simplices of every dimension up to n >= 1, at least one of dimension n; some are faces of others.
inline Rows random_mixed(int n, Random& random) {
  const int vertices = n + 2 + uniform(random, 0, 6), count = uniform(random, 1, 12);
  Rows rows{subset(n + 1, 0, vertices, random), subset(uniform(random, 1, n), 0, vertices, random)};
  for (int i = 0; i < count; ++i) rows.push_back(subset(uniform(random, 1, n + 1), 0, vertices, random));
  return shuffled(rows, random);
}

/// All cliques of at most n+1 vertices, maximal ones only, of a random graph: a Rips complex.
inline Rows random_rips(int n, Random& random) {
  const int vertices = uniform(random, n + 2, n + 8);
  std::set<std::set<Index>> cliques;
  std::map<Index, std::set<Index>> later;  // neighbours with a larger id
  for (Index a = 0; a < vertices; ++a)
    for (Index b = a + 1; b < vertices; ++b)
      if (b <= n || uniform(random, 0, 2) > 0) later[a].insert(b);  // the first n+1 vertices make one n-simplex
  for (Index v = 0; v < vertices; ++v) cliques.insert({v});
  for (int size = 2; size <= n + 1; ++size)
    for (const auto& clique : std::set(cliques))
      for (Index v = *clique.rbegin() + 1; v < vertices; ++v)
        if (std::ranges::all_of(clique, [&](Index u) { return later[u].contains(v); })) {
          auto larger = clique;
          larger.insert(v);
          cliques.insert(larger);
        }
  for (const auto& clique : std::set(cliques))
    for (const Index v : clique) {
      auto face = clique;
      face.erase(v);
      cliques.erase(face);
    }
  Rows rows;
  for (const auto& clique : cliques) rows.emplace_back(clique.begin(), clique.end());
  return shuffled(rows, random);
}

/// Pure rows side by side, without a common vertex.
inline Rows random_components(int n, int components, Random& random) {
  Rows rows;
  Index offset = 0;
  for (int i = 0; i < components; ++i) {
    Index bound = 0;
    for (auto row : random_pure(n, random)) {
      for (Index& v : row) bound = std::max(bound, v += offset);
      rows.push_back(row);
    }
    offset = bound + 1;
  }
  return shuffled(rows, random);
}

/// A vertex with exactly `upper` neighbours of larger and three of smaller id, and as many n-simplices (n >= 2) without
/// it. Ids are not renumbered: the hub is vertex 3.
inline Rows hub(int n, int upper, Random& random) {
  const int centre = 3, bound = centre + 1 + upper;
  std::set<std::set<Index>> unique;
  const auto add = [&](std::set<Index> row, Index forbidden) {
    while (static_cast<int>(row.size()) < n + 1)
      if (const Index v = uniform(random, 0, bound - 1); v != forbidden) row.insert(v);
    unique.insert(row);
  };
  for (Index v = 0; v < bound; ++v) {
    if (v == centre) continue;
    add({centre, v}, -1);
    add({v}, centre);
  }
  Rows rows;
  for (const auto& row : unique) rows.emplace_back(row.begin(), row.end());
  return reordered(rows, random);
}

}  // namespace derham::support
