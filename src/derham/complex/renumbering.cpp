#include "derham/complex/renumbering.hpp"

#include "derham/complex/validation.hpp"
#include "derham/core/error.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>

namespace derham {
namespace {

std::size_t index(Offset i) { return static_cast<std::size_t>(i); }

void require_as_many(std::span<const double> values, std::span<const SignedIndex> map) {
  if (values.size() != map.size())
    throw InputError(text("there are ", values.size(), " values for ", map.size(), " simplices"));
}

}  // namespace

Renumbering with_rows_in_order(std::vector<Index> new_vertex, const SimplexList& rows) {
  std::vector<Index> lowest(index(rows.size())), next(new_vertex.size() + 1, 0);
  parallel_blocks(rows.size(), 1 << 14, [&](Offset begin, Offset end) {
    for (Offset row = begin; row < end; ++row) {
      Index low = new_vertex[index(rows[row].front())];
      for (const Index v : rows[row]) low = std::min(low, new_vertex[index(v)]);
      lowest[index(row)] = low;
    }
  });
  for (const Index v : lowest) ++next[index(v) + 1];
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  std::vector<Index> old_row(lowest.size());
  for (std::size_t row = 0; row < lowest.size(); ++row)
    old_row[index(next[index(lowest[row])]++)] = static_cast<Index>(row);
  return {std::move(new_vertex), std::move(old_row)};
}

SimplexList renumbered(const SimplexList& rows, const Renumbering& renumbering) {
  const auto renumber = [&](std::span<const Index> row, auto out) {
    for (const Index v : row) *out++ = renumbering.new_vertex[index(v)];
  };
  if (rows.is_uniform() && !rows.empty()) {
    const std::size_t width = index(rows.dimension()) + 1;
    std::vector<Index> vertices(rows.vertices().size());
    parallel_blocks(rows.size(), 1 << 14, [&](Offset begin, Offset end) {
      for (Offset row = begin; row < end; ++row) {
        const Offset ahead = std::min(row + 16, end - 1);
        __builtin_prefetch(rows[renumbering.old_row[index(ahead)]].data());
        renumber(rows[renumbering.old_row[index(row)]],
                 vertices.begin() + static_cast<std::ptrdiff_t>(width * index(row)));
      }
    });
    return {rows.dimension(), std::move(vertices)};
  }
  SimplexList result;
  std::vector<Index> row;
  for (const Index old : renumbering.old_row) {
    row.clear();
    renumber(rows[old], std::back_inserter(row));
    result.push_back(row);
  }
  return result;
}

VertexGaps vertex_gaps(const SimplexList& rows) {
  VertexGaps gaps;
  for (Offset row = 0; row < rows.size(); ++row) {
    const auto [low, high] = std::ranges::minmax(rows[row]);
    gaps.mean += static_cast<double>(high - low);
    gaps.largest = std::max(gaps.largest, high - low);
  }
  if (!rows.empty()) gaps.mean /= static_cast<double>(rows.size());
  return gaps;
}

template <int n>
std::vector<SignedIndex> simplex_map(const SimplicialComplex<n>& K, const SimplicialComplex<n>& L,
                                     const Renumbering& renumbering, int k) {
  if (k < 0 || k > n) throw InputError(text("degree ", k, " in a complex of dimension ", n));
  if (K.size(k) != L.size(k) || renumbering.new_vertex.size() != index(K.size(0)))
    throw InputError("the second complex is not the renumbered first one");
  std::vector<SignedIndex> map(index(K.size(k)));
  parallel_blocks(K.size(k), 1 << 12, [&](Offset begin, Offset end) {
    std::array<Index, n + 1> storage{};
    const std::span<Index> tuple(storage.data(), index(k) + 1);
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      std::ranges::transform(K.simplex(k, i), tuple.begin(), [&](Index v) { return renumbering.new_vertex[index(v)]; });
      const SignedIndex found = L.at(tuple);
      map[index(i)] = {found.index, static_cast<Sign>(found.sign * K.sign(k, i))};
    }
  });
  return map;
}

template <int n>
void orient_as(SimplicialComplex<n>& L, const SimplicialComplex<n>& K, const Renumbering& renumbering) {
  const auto tops = simplex_map(K, L, renumbering, n);
  std::vector<double> weight(tops.size());
  for (const auto& [t, sign] : tops)
    weight[index(t)] = sign * L.sign(n, t);  // +1 where the representative is positive in K
  L.orient_by(weight);
}

std::vector<double> carried(std::span<const double> values, std::span<const SignedIndex> map) {
  require_as_many(values, map);
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < map.size(); ++i) result[index(map[i].index)] = map[i].sign * values[i];
  return result;
}

std::vector<double> carried_back(std::span<const double> values, std::span<const SignedIndex> map) {
  require_as_many(values, map);
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < map.size(); ++i) result[i] = map[i].sign * values[index(map[i].index)];
  return result;
}

#define DERHAM_INSTANTIATE(n)                                                                             \
  template std::vector<SignedIndex> simplex_map(const SimplicialComplex<n>&, const SimplicialComplex<n>&, \
                                                const Renumbering&, int);                                 \
  template void orient_as(SimplicialComplex<n>&, const SimplicialComplex<n>&, const Renumbering&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
DERHAM_INSTANTIATE(5)
DERHAM_INSTANTIATE(6)
#undef DERHAM_INSTANTIATE

}  // namespace derham
