#include "derham/complex/refinement.hpp"

#include "derham/complex/local_faces.hpp"
#include "derham/complex/simplex_list.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

// This follows Edelsbrunner & Grayson, "Edgewise subdivision of a simplex", 2000, with two parts an edge. A piece of the
// simplex v_0 < … < v_k is a staircase of midpoints (v_a, v_b): it begins with a = 0, b = i, and every step raises a, until
// it is i, or b, until it is k. Its k steps, one bit each, are any of 2^k. Stairs rise in the lexicographic order of (a, b).

namespace derham {
namespace {

/// Throws LimitError unless Index can number `factor` times `count` simplices.
void require_fits(Offset factor, Offset count) {
  if (count > std::numeric_limits<Index>::max() / factor)
    throw LimitError(text("a refinement into ", factor, " times ", count, " simplices is more than Index can number",
                          sizeof(Index) < 8 ? "; build with DERHAM_INDEX64" : ""));
}

}  // namespace

template <int n>
  requires(1 <= n && n <= 4)
auto Refinement<n>::pieces(int k) -> std::vector<Midpoint> {
  std::vector<Midpoint> result;
  for (unsigned steps = 0; steps < 1U << k; ++steps) {
    int low = 0, high = std::popcount(steps);
    std::array<Index, n> axes{};  // with v_j - v_{j-1} as axis j: step s goes along axes[s]
    result.push_back({static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(high)});
    for (int s = 0; s < k; ++s) {
      axes[static_cast<std::size_t>(s)] = (steps >> s & 1U) != 0 ? ++low : ++high;
      result.push_back({static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(high)});
    }
    if (sort_with_sign(std::span<Index>(axes).first(static_cast<std::size_t>(k))) < 0)
      std::swap(result.end()[-1], result.end()[-2]);
  }
  return result;
}

template <int n>
  requires(1 <= n && n <= 4)
void Refinement<n>::number_vertices() {
  const auto& K = *coarse_;
  require_fits(1, Offset{K.size(0)} + K.size(1));
  std::vector<Index> edges(static_cast<std::size_t>(K.size(1)));
  std::iota(edges.begin(), edges.end(), Index{0});
  if constexpr (n == 1)  // top simplices are not in lexicographic order
    std::ranges::sort(edges, std::ranges::lexicographical_compare, [&](Index e) { return K.template simplex<1>(e); });
  auto edge = edges.begin();
  midpoint_.resize(edges.size());
  for (Index v = 0; v < K.size(0); ++v) {
    vertex_.push_back(static_cast<Index>(ends_.size()));
    ends_.push_back({v, v});
    for (; edge != edges.end() && K.template simplex<1>(*edge)[0] == v; ++edge) {
      midpoint_[static_cast<std::size_t>(*edge)] = static_cast<Index>(ends_.size());
      ends_.push_back({v, K.template simplex<1>(*edge)[1]});
    }
  }
}

template <int n>
  requires(1 <= n && n <= 4)
SimplicialComplex<n> Refinement<n>::subdivided() const {
  const auto& K = *coarse_;
  constexpr Offset factor = 1 << n;
  require_fits(factor, K.size(n));
  std::vector<Index> tops(static_cast<std::size_t>(factor * K.size(n) * (n + 1)));
  parallel_blocks(K.size(n), 1 << 12, [&](Offset first, Offset last) {
    for (auto t = static_cast<Index>(first); t < last; ++t) {
      const auto face = face_indices(K, t);
      auto out = tops.begin() + factor * t * (n + 1);
      for (const Midpoint& point : pieces_[n]) {
        const unsigned mask = 1U << point.low | 1U << point.high;
        *out++ = (point.low == point.high ? vertex_ : midpoint_)[static_cast<std::size_t>(face[mask])];
      }
      if (K.sign(n, t) < 0)
        for (auto end = out; end != out - factor * (n + 1); end -= n + 1) std::swap(end[-1], end[-2]);
    }
  });
  SimplexList rows(n, std::move(tops));
  for (const RowTarget& lower : K.maximal_lower()) {
    std::vector<Index> lower_rows;
    append_pieces(K.simplex(lower.degree, lower.index), lower_rows);
    const auto width = static_cast<std::size_t>(lower.degree) + 1;
    for (std::size_t i = 0; i < lower_rows.size(); i += width)
      rows.push_back(std::span<const Index>(lower_rows).subspan(i, width));
  }
  return SimplicialComplex<n>(rows, K.size(0) + K.size(1));
}

template <int n>
  requires(1 <= n && n <= 4)
Refinement<n>::Refinement(const SimplicialComplex<n>& K) : coarse_(&K) {
  for (int k = 0; k <= n; ++k) pieces_[static_cast<std::size_t>(k)] = pieces(k);
  number_vertices();
  fine_ = subdivided();
}

template <int n>
  requires(1 <= n && n <= 4)
RowTarget Refinement<n>::carrier(int k, Index i) const noexcept {
  std::array<Index, 2 * (n + 1)> storage{};
  auto end = storage.begin();
  for (const Index v : fine_.simplex(k, i)) end = std::ranges::copy(ends(v), end).out;
  sort_with_sign(std::span<Index>(storage.begin(), end));
  const std::span<const Index> vertices(storage.begin(), std::unique(storage.begin(), end));
  return {static_cast<int>(vertices.size()) - 1, coarse_->find(vertices).index};
}

template <int n>
  requires(1 <= n && n <= 4)
void Refinement<n>::append_pieces(std::span<const Index> alias, std::vector<Index>& out) const {
  const auto& K = *coarse_;
  if (alias.empty() || alias.size() > n + 1 || !K.find(alias))
    throw InputError(text(tuple_text(alias), " is no simplex of the complex"));
  std::array<Index, n + 1> storage{};
  std::ranges::copy(alias, storage.begin());
  const std::span<Index> tuple = std::span<Index>(storage).first(alias.size());
  const bool odd = sort_with_sign(tuple) < 0;
  const auto& points = pieces_[alias.size() - 1];
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Index low = tuple[points[p].low], high = tuple[points[p].high];
    out.push_back(low == high ? vertex(low) : midpoint_[static_cast<std::size_t>(K.find({low, high}).index)]);
    if (odd && p % alias.size() == alias.size() - 1) std::swap(out.end()[-1], out.end()[-2]);
  }
}

template class Refinement<1>;
template class Refinement<2>;
template class Refinement<3>;
template class Refinement<4>;

}  // namespace derham
