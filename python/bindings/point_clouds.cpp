#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/core/cancel.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

// Vietoris–Rips complexes: near pairs of points, and cliques.
namespace derham::python {
namespace {

using Pairs = Input<Index, nb::ndim<2>>;

/// The pairs of points at most `radius` apart, of all pairs in lexicographic order or of `candidates`.
auto near_pairs(const Input<double, nb::ndim<2>>& points, double radius, const std::optional<Pairs>& candidates) {
  const std::size_t m = points.shape(1);
  std::vector<Index> near;
  const auto add_if_near = [&](std::size_t i, std::size_t j) {
    double square = 0;
    for (std::size_t c = 0; c < m; ++c) {
      const double difference = points.data()[i * m + c] - points.data()[j * m + c];
      square += difference * difference;
    }
    if (std::sqrt(square) <= radius) near.insert(near.end(), {static_cast<Index>(i), static_cast<Index>(j)});
  };
  without_gil([&] {
    if (candidates) {
      for (std::size_t i = 0; i < candidates->shape(0); ++i)
        add_if_near(static_cast<std::size_t>(candidates->data()[2 * i]),
                    static_cast<std::size_t>(candidates->data()[2 * i + 1]));
    } else {
      for (std::size_t i = 0; i < points.shape(0); ++i)
        for (std::size_t j = i + 1; j < points.shape(0); ++j) add_if_near(i, j);
    }
  });
  const std::size_t count = near.size() / 2;
  return owned(std::move(near), {count, 2});
}

/// Simplices of one degree in lexicographic order, each with the vertices behind its last one that neighbour all of its own.
struct Cliques {
  std::vector<Index> vertices, common;
  std::vector<std::size_t> ends;  ///< of the common neighbours of every simplex
};

/// The number and the vertices of the simplices of degree 2, 3, …, up to the first degree of which there are more than
/// `limit`; of that there are no vertices, and the number is one that is too high.
auto cliques(const Pairs& edges, std::size_t vertex_count, int dimension, Offset limit) {
  std::vector<std::pair<Offset, std::vector<Index>>> lists;
  without_gil([&] {
    const auto pairs = span_of(edges);
    std::vector<std::size_t> begin(vertex_count + 1, 0);
    std::vector<Index> neighbours;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
      ++begin[static_cast<std::size_t>(pairs[i]) + 1];
      neighbours.push_back(pairs[i + 1]);
    }
    for (std::size_t v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
    const auto behind = [&](Index v) {
      const auto i = static_cast<std::size_t>(v);
      return std::span<const Index>(neighbours).subspan(begin[i], begin[i + 1] - begin[i]);
    };
    const auto add_common = [&](Cliques& level, std::span<const Index> candidates, Index v) {
      std::ranges::set_intersection(candidates, behind(v), std::back_inserter(level.common));
      level.ends.push_back(level.common.size());
    };

    Cliques level;
    level.vertices.assign(pairs.begin(), pairs.end());
    for (std::size_t i = 0; i < pairs.size(); i += 2) add_common(level, behind(pairs[i]), pairs[i + 1]);
    for (int k = 2; k <= dimension; ++k) {
      const auto count = static_cast<Offset>(level.common.size());
      if (count > limit) {
        lists.emplace_back(count, std::vector<Index>());
        return;
      }
      Cliques next;
      const auto width = static_cast<std::size_t>(k);
      next.vertices.reserve(level.common.size() * (width + 1));
      for (std::size_t s = 0, from = 0; s < level.ends.size(); from = level.ends[s++]) {
        if (s % 1024 == 0) poll_cancel();
        const auto common = std::span<const Index>(level.common).subspan(from, level.ends[s] - from);
        const auto simplex = std::span<const Index>(level.vertices).subspan(s * width, width);
        for (std::size_t i = 0; i < common.size(); ++i) {
          next.vertices.insert(next.vertices.end(), simplex.begin(), simplex.end());
          next.vertices.push_back(common[i]);
          if (k < dimension) add_common(next, common.subspan(i + 1), common[i]);
        }
        if (static_cast<Offset>(next.common.size()) > limit && k < dimension) break;  // too many of degree k + 1
      }
      lists.emplace_back(count, next.vertices);
      level = std::move(next);
    }
  });
  std::vector<std::pair<Offset, Array<Index>>> result;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const std::size_t width = i + 3, rows = lists[i].second.size() / width;
    result.emplace_back(lists[i].first, owned(std::move(lists[i].second), {rows, width}));
  }
  return result;
}

}  // namespace

void bind_point_clouds(nb::module_& module) {
  using nb::arg;
  module.def("near_pairs", &near_pairs, arg("points"), arg("radius"), arg("candidates").none());
  module.def("cliques", &cliques, arg("edges"), arg("vertex_count"), arg("dimension"), arg("limit"));
}

}  // namespace derham::python
