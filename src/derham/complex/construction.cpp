// The "upper links" construction: every simplex belongs to its smallest vertex, and the simplices of one vertex are
// found in its upper link, a small local problem without hashing or sorting of the whole mesh. Three passes, parallel
// over blocks of vertices, each block writing only its own range: count, fill, and look up the faces that omit the
// first vertex.
#include "derham/complex/construction.hpp"

#include "derham/complex/upper_link.hpp"
#include "derham/complex/validation.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/scratch_pool.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace derham {
namespace {

constexpr Offset block_size = 2048;  // vertices per block: their records fit a second-level cache

/// The quick look at every row: whether all ids are in range, distinct within their row, and used.
bool looks_sound(const SimplexList& rows, Index vertex_count) {
  std::vector<char> used(static_cast<std::size_t>(vertex_count), 0);
  for (Offset row = 0; row < rows.size(); ++row) {
    const auto tuple = rows[row];
    for (std::size_t i = 0; i < tuple.size(); ++i) {
      if (tuple[i] < 0 || tuple[i] >= vertex_count) return false;
      used[static_cast<std::size_t>(tuple[i])] = 1;
      for (std::size_t j = 0; j < i; ++j)
        if (tuple[i] == tuple[j]) return false;
    }
  }
  return std::ranges::find(used, char{0}) == used.end();
}

/// The top simplices grouped by their vertex number p: for each, the vertices after it and the top simplex.
struct Records {
  std::size_t width = 0;     // suffix length + 1
  std::vector<Index> begin;  // (|V|+1,)
  std::vector<Index> data;   // (|K_n|, width): suffix…, top simplex

  Records() = default;
  Records(std::span<const Index> tops, int n, int p, Index vertex_count)
      : width(static_cast<std::size_t>(n - p) + 1), begin(static_cast<std::size_t>(vertex_count) + 1, 0) {
    const auto stride = static_cast<std::size_t>(n) + 1, count = tops.size() / stride;
    for (std::size_t t = 0; t < count; ++t)
      ++begin[static_cast<std::size_t>(tops[t * stride + static_cast<std::size_t>(p)]) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    data.resize(count * width);
    for (std::size_t t = 0; t < count; ++t) {
      const Index* tuple = tops.data() + t * stride + p;
      Index* record = data.data() + static_cast<std::size_t>(begin[static_cast<std::size_t>(*tuple)]++) * width;
      std::copy_n(tuple + 1, width - 1, record);
      record[width - 1] = static_cast<Index>(t);
    }
    // each begin[v] has moved to begin[v+1]: move them back
    for (std::size_t v = begin.size() - 1; v > 0; --v) begin[v] = begin[v - 1];
    begin[0] = 0;
  }

  [[nodiscard]] Index count(Index v) const {
    return begin[static_cast<std::size_t>(v) + 1] - begin[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] const Index* record(Index v, Index i) const {
    return data.data() + static_cast<std::size_t>(begin[static_cast<std::size_t>(v)] + i) * width;
  }
  [[nodiscard]] std::span<const Index> suffix(Index v, Index i) const { return {record(v, i), width - 1}; }
  [[nodiscard]] Index top(Index v, Index i) const { return record(v, i)[width - 1]; }
};

template <int n>
using RecordSet = std::array<Records, static_cast<std::size_t>(n)>;

template <int n>
void load(UpperLink<n>& link, const RecordSet<n>& records, Index v) {
  link.clear();
  for (const Records& r : records)
    for (Index i = 0; i < r.count(v); ++i) link.add_vertices(r.suffix(v, i));
  link.close_vertices();
  if constexpr (n >= 3) {
    for (const Records& r : records)
      for (Index i = 0; i < r.count(v); ++i) link.add_tuples(r.suffix(v, i));
    link.close_tuples();
  }
}

}  // namespace

Offset add_count(Offset total, Index count, int k, Offset limit) {
  if (count > limit - total)
    throw LimitError(text("there are more than ", limit, " simplices of degree ", k,
                          ", which do not fit the index type; build derham with DERHAM_INDEX64=ON"));
  return total + count;
}

Offset accumulate_counts(std::span<Index> counts, int k, Offset limit) {
  Offset total = 0;
  for (Index& end : counts) {
    total = add_count(total, end, k, limit);
    end = static_cast<Index>(total);
  }
  return total;
}

Index find_in_bucket(std::span<const Index> simplices, std::span<const Index> order, Index begin, Index end,
                     std::span<const Index> tuple) noexcept {
  const std::size_t width = tuple.size();
  const auto at = [&](Index i) {
    const Index s = order.empty() ? i : order[static_cast<std::size_t>(i)];
    return simplices.subspan(static_cast<std::size_t>(s) * width + 1, width - 1);
  };
  const auto rest = tuple.subspan(1);
  const auto less = [](std::span<const Index> a, std::span<const Index> b) {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i] != b[i]) return a[i] < b[i];
    return false;
  };
  Index low = begin, high = end;
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (less(at(middle), rest))
      low = middle + 1;
    else
      high = middle;
  }
  if (low == end || less(rest, at(low))) return -1;
  return order.empty() ? low : order[static_cast<std::size_t>(low)];
}

/// The simplices of degree 1..n-1 whose first vertex is v, and of each the faces that keep v.
template <int n>
void ComplexBuilder<n>::fill_lists(SimplicialComplex<n>& K, const UpperLink<n>& link, Index v) {
  using Ranks = typename UpperLink<n>::Ranks;
  for (int k = 1; k < n; ++k) {
    const auto width = static_cast<std::size_t>(k) + 1;
    const Index base = K.buckets_[k][static_cast<std::size_t>(v)];
    Index* simplex = K.simplices_[k].data() + static_cast<std::size_t>(base) * width;
    Index* face = k >= 2 ? K.faces_[k].data() + static_cast<std::size_t>(base) * width : nullptr;
    const Index lower_base = k >= 2 ? K.buckets_[k - 1][static_cast<std::size_t>(v)] : 0;
    link.for_each(k, [&](const Ranks& r) {
      *simplex++ = v;
      for (int i = 0; i < k; ++i) *simplex++ = link.vertex(r[static_cast<std::size_t>(i)]);
      if (k < 2) return;
      for (int omitted = k - 1; omitted >= 0; --omitted) {
        Ranks rest{};
        for (int i = 0, j = 0; i < k; ++i)
          if (i != omitted) rest[static_cast<std::size_t>(j++)] = r[static_cast<std::size_t>(i)];
        *face++ = lower_base + link.position(k - 1, rest);
      }
      ++face;  // the face that omits v: see fill_last_faces
    });
  }
}

/// The faces of a top simplex that keep its first vertex v.
template <int n>
void ComplexBuilder<n>::fill_top_faces(SimplicialComplex<n>& K, const UpperLink<n>& link, Index v,
                                       std::span<const Index> suffix, Index top) {
  Index* face = K.faces_[n].data() + static_cast<std::size_t>(top) * (n + 1);
  const Index base = K.buckets_[n - 1][static_cast<std::size_t>(v)];
  for (int omitted = n - 1; omitted >= 0; --omitted) {
    typename UpperLink<n>::Ranks rest{};
    for (int i = 0, j = 0; i < n; ++i)
      if (i != omitted) rest[static_cast<std::size_t>(j++)] = link.rank(suffix[static_cast<std::size_t>(i)]);
    *face++ = base + link.position(n - 1, rest);
  }
}

/// The face of every k-simplex (2 <= k < n) that omits its first vertex.
template <int n>
void ComplexBuilder<n>::fill_last_faces(SimplicialComplex<n>& K, int k) {
  const auto width = static_cast<std::size_t>(k) + 1;
  const auto& bucket = K.buckets_[k - 1];
  parallel_blocks(K.size(k), 1 << 14, [&](Offset first, Offset last) {
    for (Offset i = first; i < last; ++i) {
      const auto rest = K.simplex(k, static_cast<Index>(i)).subspan(1);
      const auto v = static_cast<std::size_t>(rest[0]);
      K.faces_[k][static_cast<std::size_t>(i) * width + width - 1] =
          find_in_bucket(K.simplices_[k - 1], {}, bucket[v], bucket[v + 1], rest);
    }
  });
}

template <int n>
RowSigns ComplexBuilder<n>::build(SimplicialComplex<n>& K, const SimplexList& rows, Index vertices,
                                  Index vertex_count) {
  K.simplices_[0] = BulkArray<Index>(static_cast<std::size_t>(vertices));
  std::iota(K.simplices_[0].begin(), K.simplices_[0].end(), Index{0});
  if constexpr (n == 2 || n == 3) {
    if (rows.is_uniform()) return build_blocks(K, rows, vertices, vertex_count);
  }
  if (!looks_sound(rows, vertices)) require_valid_input(check_input(rows, vertex_count), rows, vertex_count);
  return rows.is_uniform() ? build_pure(K, rows, vertices) : build_mixed(K, rows, vertices);
}

template <int n>
RowSigns ComplexBuilder<n>::build_pure(SimplicialComplex<n>& K, const SimplexList& rows, Index vertex_count) {
  const Offset tops = rows.size();
  std::vector<Sign> signs(static_cast<std::size_t>(tops), Sign{1});
  if constexpr (n == 0) {
    bool in_order = true;
    for (Offset row = 0; row < tops; ++row) in_order = in_order && rows[row][0] == row;
    if (tops != vertex_count) require_valid_input(check_input(rows, vertex_count), rows, vertex_count);
    for (Offset row = 0; row < tops && !in_order; ++row) K.rows_.push_back({0, rows[row][0]});
  } else {
    auto& T = K.simplices_[n];
    T = BulkArray<Index>(rows.vertices());
    parallel_blocks(tops, 1 << 14, [&](Offset first, Offset last) {
      for (Offset t = first; t < last; ++t)
        signs[static_cast<std::size_t>(t)] =
            sort_with_sign(std::span<Index>(T).subspan(static_cast<std::size_t>(t) * (n + 1), n + 1));
    });

    RecordSet<n> records;
    const Offset places = tops < (1 << 14) ? n : 1;  // small complexes, like links, are not worth a thread
    parallel_blocks(n, places, [&](Offset first, Offset last) {
      for (Offset p = first; p < last; ++p)
        records[static_cast<std::size_t>(p)] = Records(T, n, static_cast<int>(p), vertex_count);
    });
    ScratchPool<UpperLink<n>> links([&] { return UpperLink<n>(vertex_count); });

    // Count: how many simplices of each degree 1..n-1 begin at each vertex.
    for (int k = 1; k < n; ++k) K.buckets_[k].assign(static_cast<std::size_t>(vertex_count) + 1, 0);
    if constexpr (n >= 2) {
      parallel_blocks(vertex_count, block_size, [&](Offset first, Offset last) {
        const auto link = links.take();
        for (Index v = static_cast<Index>(first); v < last; ++v) {
          load<n>(*link, records, v);
          for (int k = 1; k < n; ++k) K.buckets_[k][static_cast<std::size_t>(v) + 1] = link->count(k);
        }
      });
    }
    for (int k = 1; k < n; ++k) {
      const Offset total = accumulate_counts(K.buckets_[k], k);
      K.simplices_[k] = BulkArray<Index>(static_cast<std::size_t>(total) * static_cast<std::size_t>(k + 1));
      if (k >= 2) K.faces_[k] = BulkArray<Index>(K.simplices_[k].size());
    }
    if (n >= 2) K.faces_[n] = BulkArray<Index>(T.size());
    K.buckets_[n] = records[0].begin;
    K.top_order_ = BulkArray<Index>(static_cast<std::size_t>(tops));

    // Fill: lists, and all faces whose first vertex is v.
    std::atomic<bool> duplicate{false}, in_order{true};
    parallel_blocks(vertex_count, block_size, [&](Offset first, Offset last) {
      const auto link = links.take();
      for (Index v = static_cast<Index>(first); v < last; ++v) {
        if constexpr (n >= 2) {
          load<n>(*link, records, v);
          fill_lists(K, *link, v);
          for (Index i = 0; i < records[0].count(v); ++i)
            fill_top_faces(K, *link, v, records[0].suffix(v, i), records[0].top(v, i));
          for (Index i = 0; i < records[1].count(v); ++i) {
            typename UpperLink<n>::Ranks r{};
            const auto suffix = records[1].suffix(v, i);
            for (std::size_t j = 0; j < suffix.size(); ++j) r[j] = link->rank(suffix[j]);
            K.faces_[n][static_cast<std::size_t>(records[1].top(v, i)) * (n + 1) + n] =
                K.buckets_[n - 1][static_cast<std::size_t>(v)] + link->position(n - 1, r);
          }
        }
        const auto less = [&](Index a, Index b) {
          const auto sa = records[0].suffix(v, a), sb = records[0].suffix(v, b);
          const auto c = std::lexicographical_compare_three_way(sa.begin(), sa.end(), sb.begin(), sb.end());
          return c != 0 ? c < 0 : a < b;
        };
        const auto order = std::span<Index>(K.top_order_)
                               .subspan(static_cast<std::size_t>(records[0].begin[static_cast<std::size_t>(v)]),
                                        static_cast<std::size_t>(records[0].count(v)));
        std::iota(order.begin(), order.end(), Index{0});
        std::ranges::sort(order, less);
        for (std::size_t i = 1; i < order.size(); ++i)
          if (std::ranges::equal(records[0].suffix(v, order[i - 1]), records[0].suffix(v, order[i]))) duplicate = true;
        for (std::size_t i = 0; i < order.size(); ++i) {
          order[i] = records[0].top(v, order[i]);
          if (order[i] != records[0].begin[static_cast<std::size_t>(v)] + static_cast<Index>(i)) in_order = false;
        }
      }
    });
    if (duplicate) require_valid_input(check_input(rows, vertex_count), rows, vertex_count);
    if (in_order) K.top_order_.shrink(0);

    // Look up: of every simplex between, the face that omits its first vertex begins at another vertex.
    for (int k = 2; k < n; ++k) fill_last_faces(K, k);
  }
  return {std::move(signs), false};
}

template RowSigns ComplexBuilder<0>::build(SimplicialComplex<0>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<1>::build(SimplicialComplex<1>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<2>::build(SimplicialComplex<2>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<3>::build(SimplicialComplex<3>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<4>::build(SimplicialComplex<4>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<5>::build(SimplicialComplex<5>&, const SimplexList&, Index, Index);
template RowSigns ComplexBuilder<6>::build(SimplicialComplex<6>&, const SimplexList&, Index, Index);

}  // namespace derham
