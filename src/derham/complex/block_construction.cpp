// Construction for n = 2 and 3, block of vertices by block: see docs/performance.md. One block after the other learns from
// the one before it where its simplices begin in the lists, so that the links of a vertex are looked at once.
#include "derham/complex/block_links.hpp"
#include "derham/complex/construction.hpp"
#include "derham/complex/find_pair.hpp"
#include "derham/complex/validation.hpp"
#include "derham/core/ordered_blocks.hpp"
#include "derham/core/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

namespace derham {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

/// Writes what `links` found in `block` to its place in the lists and tables of K. If the rows of its top simplices do not
/// stand near each other, they are asked for ahead.
template <int n>
void ComplexBuilder<n>::write_block(SimplicialComplex<n>& K, const BlockLinks<n>& links, Index first_vertex,
                                    const std::array<Index, 3>& first, bool local) {
  const auto [edge, triangle, top] = first;
  const auto write_ends = [&](int k, std::span<const Index> begin, Index base) {
    for (std::size_t v = 1; v < begin.size(); ++v) K.buckets_[at(k)][at(first_vertex) + v] = base + begin[v];
  };
  write_ends(n, links.top_begin(), top);
  write_ends(1, links.edge_begin(), edge);
  Index* edges = K.simplices_[1].data() + at(edge) * 2;
  const auto begin = links.edge_begin();
  for (std::size_t v = 0; v + 1 < begin.size(); ++v)
    for (Index e = begin[v]; e < begin[v + 1]; ++e) {
      *edges++ = first_vertex + static_cast<Index>(v);
      *edges++ = links.neighbours()[e];
    }
  if constexpr (n == 3) {
    write_ends(2, links.triangle_begin(), triangle);
    std::copy_n(links.triangles(), at(links.triangle_count()) * 3, K.simplices_[2].data() + at(triangle) * 3);
    Index* const faces = K.faces_[2].data() + at(triangle) * 3;
    const Index* const found = links.triangle_faces();
    for (std::size_t i = 0, size = at(links.triangle_count()) * 3; i < size; ++i) faces[i] = edge + found[i];
  }
  const Index facet = n == 2 ? edge : triangle;
  const auto begins = links.tops(0), continues = links.tops(1);
  const auto faces_of = [table = K.faces_[n].data()](Index entry) {
    return table + at(TopBlocks<n>::top_of(entry)) * (n + 1);
  };
  const auto for_each = [&](std::span<const Index> tops, auto&& body) {
    constexpr std::size_t ahead = 16;
    const std::size_t prefetched = local || tops.size() < ahead ? 0 : tops.size() - ahead;
    std::size_t i = 0;
    for (; i < prefetched; ++i) {
      __builtin_prefetch(faces_of(tops[i + ahead]), 1);
      body(i, faces_of(tops[i]));
    }
    for (; i < tops.size(); ++i) body(i, faces_of(tops[i]));
  };
  for_each(begins, [&, face = links.top_faces(0)](std::size_t i, Index* faces) {
    for (std::size_t f = 0; f < n; ++f) faces[f] = facet + face[i * n + f];
  });
  for_each(continues, [&, face = links.top_faces(1)](std::size_t i, Index* faces) { faces[n] = facet + face[i]; });
}

/// The face of every triangle that omits its first vertex.
template <int n>
template <bool local>
void ComplexBuilder<n>::find_last_sides(SimplicialComplex<n>& K, Index triangles) {
  constexpr Offset ahead = 32;
  const Index *const edges = K.simplices_[1].data(), *const triangle = K.simplices_[2].data();
  const Index* const bucket = K.buckets_[1].data();
  Index* const faces = K.faces_[2].data();
  parallel_blocks(triangles, 1 << 14, [&](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) {
      if (!local && i + ahead < last) {
        const Index* const next = edges + at(bucket[triangle[3 * (i + ahead) + 1]]) * 2;
        __builtin_prefetch(next);
        __builtin_prefetch(next + 14);
      }
      faces[3 * i + 2] = find_pair(edges, bucket, triangle[3 * i + 1], triangle[3 * i + 2]);
    }
  });
}

template <int n>
RowSigns ComplexBuilder<n>::build_blocks(SimplicialComplex<n>& K, const SimplexList& rows, Index vertices,
                                         Index vertex_count)
  requires(n == 2 || n == 3)
{
  const auto refuse = [&] { require_valid_input(check_input(rows, vertex_count), rows, vertex_count); };
  TopBlocks<n> tops(rows.vertices(), vertices);
  if (!tops.is_sound()) refuse();
  // No more simplices than faces of top simplices. What is not needed is given back.
  const auto count = tops.signs.size();
  for (int k = 1; k <= n; ++k) {
    K.buckets_[at(k)].assign(at(vertices) + 1, 0);
    const auto most = count * at(static_cast<Index>(binomial(n + 1, k + 1)));
    if (k < n) K.simplices_[at(k)] = BulkArray<Index>(most * at(k + 1) + (k == 1 ? 2 * find_pair_margin : 0));
    if (k == n || k == 2) K.faces_[at(k)] = BulkArray<Index>(most * at(k + 1));
  }
  K.top_order_ = BulkArray<Index>(count);
  std::vector<char> in_order(at(tops.block_count()), 1);  // whether the top simplices of a block stand in order

  std::array<Offset, 3> total{};  // edges, triangles, tops so far
  std::atomic<bool> defect{false}, coherent{true};
  struct Work {
    BlockLinks<n> links;
    std::array<Index, 3> first{};
  };
  ordered_blocks(
      tops.block_count(), [&] { return Work{BlockLinks<n>(tops, vertices)}; },
      [&](Work& work, Offset block) { work.links.find(static_cast<Index>(block)); },
      [&](Work& work, Offset) {
        const std::array<Index, 3> counts{work.links.edge_count(), work.links.triangle_count(),
                                          static_cast<Index>(work.links.order().size())};
        for (std::size_t i = 0; i < 3; ++i) {
          work.first[i] = static_cast<Index>(total[i]);
          total[i] = add_count(total[i], counts[i], static_cast<int>(i) + 1);
        }
      },
      [&](Work& work, Offset block) {
        write_block(K, work.links, tops.first_vertex(static_cast<Index>(block)), work.first, tops.is_local());
        if (work.links.has_defect()) defect = true;
        if (!work.links.is_coherent()) coherent = false;
        const auto order = work.links.order();
        for (std::size_t i = 0; i < order.size(); ++i)
          if (order[i] != work.first[2] + static_cast<Index>(i)) in_order[static_cast<std::size_t>(block)] = 0;
        if (!in_order[static_cast<std::size_t>(block)]) std::ranges::copy(order, K.top_order_.begin() + work.first[2]);
      });
  if (defect) refuse();
  if (std::ranges::find(in_order, char{0}) == in_order.end()) K.top_order_.shrink(0);
  for (Index block = 0; block < tops.block_count() && !K.top_order_.empty(); ++block)
    if (in_order[at(block)])
      std::iota(K.top_order_.begin() + tops.before(block), K.top_order_.begin() + tops.before(block + 1),
                tops.before(block));

  const auto [edges, triangles, found] = total;
  if constexpr (n == 3) {
    std::fill_n(K.simplices_[1].begin() + edges * 2, 2 * find_pair_margin, Index{-1});
    if (tops.is_local())
      find_last_sides<true>(K, static_cast<Index>(triangles));
    else
      find_last_sides<false>(K, static_cast<Index>(triangles));
    K.simplices_[2].shrink(at(static_cast<Index>(triangles)) * 3);
    K.faces_[2].shrink(K.simplices_[2].size());
  }
  K.simplices_[1].shrink(at(static_cast<Index>(edges)) * 2);
  K.simplices_[n] = std::move(tops.tuples);
  return {std::move(tops.signs), coherent};
}
template RowSigns ComplexBuilder<2>::build_blocks(SimplicialComplex<2>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<3>::build_blocks(SimplicialComplex<3>&, const SimplexList&, Index, Index);

}  // namespace derham
