#pragma once

#include "derham/complex/simplex_list.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace derham::bench {

/// The oriented complex made with ordered maps of sorted tuples, without anything that would slow it down needlessly:
/// tuples are arrays, and there is one map per degree. (tests/reference keeps sets beside the maps and tuples of any
/// length, and takes four to six times as long.)
/// Source   Elcott & Schröder, "Building your own DEC at home", §3
template <int n>
class SetAndMap {
 public:
  explicit SetAndMap(const SimplexList& rows) : tops_(static_cast<std::size_t>(rows.size())) {
    for (std::size_t t = 0; t < tops_.size(); ++t) {
      std::ranges::copy(rows[static_cast<Offset>(t)], tops_[t].begin());
      std::ranges::sort(tops_[t]);
    }
    number_faces<n>(tops_);
    orient();
  }

  /// |K_k|, k < n.
  template <int k>
  [[nodiscard]] Offset size() const {
    return static_cast<Offset>(std::get<k>(positions_).size());
  }
  /// [t][i]: the index of the face of t that omits its vertex i.
  [[nodiscard]] const std::vector<std::array<Index, n + 1>>& top_faces() const { return std::get<n>(faces_); }
  [[nodiscard]] const std::vector<Sign>& signs() const { return signs_; }

 private:
  template <int k>
  using Tuple = std::array<Index, k + 1>;

  template <int k>
  static Tuple<k - 1> without(const Tuple<k>& t, std::size_t omitted) {
    Tuple<k - 1> face{};
    for (std::size_t i = 0, j = 0; i <= k; ++i)
      if (i != omitted) face[j++] = t[i];
    return face;
  }

  /// Collects, numbers and looks up the faces of `simplices`, degree by degree downwards.
  template <int k, class Simplices>
  void number_faces(const Simplices& simplices) {
    auto& position = std::get<k - 1>(positions_);
    for (const auto& s : simplices)
      for (std::size_t i = 0; i <= k; ++i) position.try_emplace(without<k>(s, i), 0);
    std::vector<Tuple<k - 1>> list;
    for (auto& [tuple, index] : position) {
      index = static_cast<Index>(list.size());
      list.push_back(tuple);
    }
    for (const auto& s : simplices) {
      auto& row = std::get<k>(faces_).emplace_back();
      for (std::size_t i = 0; i <= k; ++i) row[i] = position.at(without<k>(s, i));
    }
    if constexpr (k > 1) number_faces<k - 1>(list);
    std::get<k - 1>(lists_) = std::move(list);
  }

  /// Coherent signs by breadth-first search across facets with two cofaces; the first simplex of a component is positive.
  void orient() {
    constexpr Index none = -1;
    std::vector<std::array<Index, 2>> cofaces(static_cast<std::size_t>(size<n - 1>()), {none, none});
    for (std::size_t t = 0; t < tops_.size(); ++t)
      for (const Index f : top_faces()[t]) {
        auto& pair = cofaces[static_cast<std::size_t>(f)];
        pair[pair[0] == none ? 0 : 1] = static_cast<Index>(t);
      }
    signs_.assign(tops_.size(), 0);
    std::queue<Index> queue;
    for (std::size_t root = 0; root < tops_.size(); ++root) {
      if (signs_[root] != 0) continue;
      signs_[root] = 1;
      for (queue.push(static_cast<Index>(root)); !queue.empty(); queue.pop()) {
        const auto t = static_cast<std::size_t>(queue.front());
        for (std::size_t i = 0; i <= n; ++i) {
          const Index f = top_faces()[t][i];
          const auto& pair = cofaces[static_cast<std::size_t>(f)];
          const Index other = pair[pair[0] == static_cast<Index>(t) ? 1 : 0];
          if (other == none || signs_[static_cast<std::size_t>(other)] != 0) continue;
          const auto& row = top_faces()[static_cast<std::size_t>(other)];
          const auto j = static_cast<std::size_t>(std::ranges::find(row, f) - row.begin());
          signs_[static_cast<std::size_t>(other)] = static_cast<Sign>((i + j) % 2 == 0 ? -signs_[t] : signs_[t]);
          queue.push(other);
        }
      }
    }
  }

  template <class Indices>
  struct ByDegree;
  template <std::size_t... k>
  struct ByDegree<std::index_sequence<k...>> {
    using Positions = std::tuple<std::map<std::array<Index, k + 1>, Index>...>;  // [k]: representative -> index
    using Lists = std::tuple<std::vector<std::array<Index, k + 1>>...>;
  };

  std::vector<Tuple<n>> tops_;
  typename ByDegree<std::make_index_sequence<n>>::Positions positions_;
  typename ByDegree<std::make_index_sequence<n>>::Lists lists_;      // [k]: the representatives, k < n
  typename ByDegree<std::make_index_sequence<n + 1>>::Lists faces_;  // [k]: k+1 faces of every k-simplex, k >= 1
  std::vector<Sign> signs_;
};

}  // namespace derham::bench
