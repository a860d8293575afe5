#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <utility>
#include <vector>

/// The chapter's own construction with sets and maps of sorted tuples: slow, obvious, and the specification that the
/// library is held to. Nothing here may call the library's algorithms.
/// Source   Elcott & Schröder, "Building your own DEC at home", §3-§5
namespace derham::reference {

using Tuple = std::vector<Index>;

/// S(P) by counting inversions; 0 if a vertex is repeated.
inline int permutation_sign(const Tuple& t) {
  int sign = 1;
  for (std::size_t i = 0; i < t.size(); ++i)
    for (std::size_t j = i + 1; j < t.size(); ++j) sign *= t[i] < t[j] ? 1 : t[i] > t[j] ? -1 : 0;
  return sign;
}

/// The representative of all aliases of `t`.
inline Tuple sorted(Tuple t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// `t` without its vertex number i. The face has the relative orientation (-1)^i.
inline Tuple without(Tuple t, std::size_t i) {
  t.erase(t.begin() + static_cast<std::ptrdiff_t>(i));
  return t;
}

/// Every nonempty subset of the tuple `t`, itself included: to keep or to leave out each vertex in turn.
inline std::vector<Tuple> subsets(const Tuple& t) {
  std::vector<Tuple> result{{}};
  for (const Index v : t) {
    const std::vector<Tuple> without_v = result;
    for (Tuple s : without_v) {
      s.push_back(v);
      result.push_back(s);
    }
  }
  result.erase(result.begin());
  return result;
}

inline std::vector<Tuple> tuples(const SimplexList& rows) {
  std::vector<Tuple> result;
  for (Offset i = 0; i < rows.size(); ++i) result.emplace_back(rows[i].begin(), rows[i].end());
  return result;
}

struct Complex {
  using Matrix = std::map<std::pair<Index, Index>, int>;  // (row, column) -> entry

  int n = 0;
  std::vector<std::vector<Tuple>> list;          // [k]: the representatives V, E, F, T … in index order
  std::vector<std::map<Tuple, Index>> position;  // [k]: representative -> index
  std::vector<int> top_sign;                     // S(representative) of each top simplex
  bool orientable = true;
  int sheets = 0;  // components of top simplices connected across facets with two cofaces

  /// The closure of sound `rows`, the longest of dimension n; each vertex set given once.
  Complex(int dimension, const std::vector<Tuple>& rows) : n(dimension), list(n + 1), position(n + 1) {
    std::vector<std::set<Tuple>> unique(n + 1);
    for (const Tuple& row : rows)
      for (const Tuple& s : subsets(sorted(row))) unique[s.size() - 1].insert(s);
    for (int k = 0; k <= n; ++k) list[k].assign(unique[k].begin(), unique[k].end());
    if (n > 0) {  // top simplices keep the order of the input, vertices are in the order of their ids
      list[n].clear();
      for (const Tuple& row : rows)
        if (static_cast<int>(row.size()) == n + 1) list[n].push_back(sorted(row));
    }
    for (int k = 0; k <= n; ++k)
      for (std::size_t i = 0; i < list[k].size(); ++i) position[k][list[k][i]] = static_cast<Index>(i);
    orient(rows);
  }

  [[nodiscard]] int sign(int k, Index i) const { return k == n ? top_sign[static_cast<std::size_t>(i)] : 1; }

  /// Index and sign S(t) = S(P) S(P(t)) of any alias; {-1, 0} if it is no simplex.
  [[nodiscard]] std::pair<Index, int> find(const Tuple& alias) const {
    const int k = static_cast<int>(alias.size()) - 1;
    if (k < 0 || k > n) return {-1, 0};
    const auto found = position[k].find(sorted(alias));
    if (found == position[k].end()) return {-1, 0};
    return {found->second, permutation_sign(alias) * sign(k, found->second)};
  }

  /// The matrix |K_{k-1}| x |K_k| of the boundary operator: for each simplex s, for each face f of s, the entry at the
  /// row of f and the column of s is S(s) (-1)^i. (The chapter's "S(f)" is this product: the face inherits the sign of
  /// the representative of s, which is -1 for some top simplices.)
  [[nodiscard]] Matrix boundary(int k) const {
    Matrix result;
    for (std::size_t s = 0; s < list[k].size(); ++s)
      for (std::size_t i = 0; i < list[k][s].size(); ++i) {
        const Index row = position[k - 1].at(without(list[k][s], i));
        result[{row, static_cast<Index>(s)}] = sign(k, static_cast<Index>(s)) * (i % 2 == 0 ? 1 : -1);
      }
    return result;
  }

  /// The m-simplices that contain, or are contained in, k-simplex i.
  [[nodiscard]] std::vector<Index> incident(int k, Index i, int m) const {
    const Tuple& s = list[k][static_cast<std::size_t>(i)];
    std::vector<Index> result;
    for (std::size_t j = 0; j < list[m].size(); ++j) {
      const Tuple &small = k < m ? s : list[m][j], &large = k < m ? list[m][j] : s;
      if (std::includes(large.begin(), large.end(), small.begin(), small.end()))
        result.push_back(static_cast<Index>(j));
    }
    return result;
  }

  /// The top simplices that have the sorted tuple `face` as a face, by index.
  [[nodiscard]] std::map<Tuple, std::vector<Index>> facet_cofaces() const {
    std::map<Tuple, std::vector<Index>> result;
    for (std::size_t t = 0; n > 0 && t < list[n].size(); ++t)
      for (std::size_t i = 0; i < list[n][t].size(); ++i)
        result[without(list[n][t], i)].push_back(static_cast<Index>(t));
    return result;
  }

  /// The sign that u needs next to t across their common facet, when t has `sign_t`: entries in that row are opposite.
  [[nodiscard]] int coherent_sign(Index t, int sign_t, Index u, const Tuple& facet) const {
    return -sign_t * relative_orientation(t, facet) * relative_orientation(u, facet);
  }

  /// Simplices with no coface of any degree above, below the top degree.
  [[nodiscard]] std::set<Tuple> maximal_lower() const {
    std::set<Tuple> result;
    for (int k = 0; k < n; ++k) result.insert(list[k].begin(), list[k].end());
    for (int k = 1; k <= n; ++k)
      for (const Tuple& s : list[k])
        for (std::size_t i = 0; i < s.size(); ++i) result.erase(without(s, i));
    return result;
  }

  /// Number of connected components, by walking along edges.
  [[nodiscard]] int components() const {
    std::map<Index, std::set<Index>> neighbours;
    for (const Tuple& v : list[0]) neighbours[v[0]];
    for (std::size_t e = 0; n > 0 && e < list[1].size(); ++e) {
      neighbours[list[1][e][0]].insert(list[1][e][1]);
      neighbours[list[1][e][1]].insert(list[1][e][0]);
    }
    int count = 0;
    for (; !neighbours.empty(); ++count) {
      std::queue<Index> queue({neighbours.begin()->first});
      for (; !queue.empty(); queue.pop())
        if (const auto node = neighbours.extract(queue.front()))
          for (const Index w : node.mapped()) queue.push(w);
    }
    return count;
  }

 private:
  [[nodiscard]] int relative_orientation(Index t, const Tuple& facet) const {
    const Tuple& s = list[n][static_cast<std::size_t>(t)];
    for (std::size_t i = 0; i < s.size(); ++i)
      if (without(s, i) == facet) return i % 2 == 0 ? 1 : -1;
    return 0;
  }

  /// Coherent signs by breadth-first search across facets with two cofaces; the first input tuple of each component is
  /// positive. All +1 if there are none.
  void orient(const std::vector<Tuple>& rows) {
    std::vector<int> preferred;
    for (const Tuple& row : rows)
      if (static_cast<int>(row.size()) == n + 1) preferred.push_back(n == 0 ? 1 : permutation_sign(row));
    const auto cofaces = facet_cofaces();
    top_sign.assign(list[n].size(), 0);
    for (std::size_t root = 0; root < list[n].size(); ++root) {
      if (top_sign[root] != 0) continue;
      ++sheets;
      top_sign[root] = preferred[root];
      std::queue<Index> queue({static_cast<Index>(root)});
      for (; !queue.empty(); queue.pop()) {
        const Index t = queue.front();
        const Tuple& s = list[n][static_cast<std::size_t>(t)];
        for (std::size_t i = 0; n > 0 && i < s.size(); ++i) {
          const Tuple facet = without(s, i);
          const auto& tops = cofaces.at(facet);
          if (tops.size() != 2) continue;
          const Index u = tops[0] == t ? tops[1] : tops[0];
          const int needed = coherent_sign(t, top_sign[static_cast<std::size_t>(t)], u, facet);
          int& sign_u = top_sign[static_cast<std::size_t>(u)];
          if (sign_u == 0) {
            sign_u = needed;
            queue.push(u);
          }
          orientable = orientable && sign_u == needed;
        }
      }
    }
    if (!orientable) top_sign.assign(list[n].size(), 1);
  }
};

}  // namespace derham::reference
