// Complexes whose maximal simplices have several dimensions: plain sort and unique of all faces, degree by degree.
#include "derham/complex/construction.hpp"
#include "derham/complex/simplex.hpp"
#include "derham/complex/validation.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace derham {
namespace {

using Padded = std::array<Index, max_dimension + 1>;  // a sorted tuple, padded with zeros

Padded padded(std::span<const Index> tuple) {
  Padded result{};
  std::ranges::copy(tuple, result.begin());
  return result;
}

/// All k-simplices of the closure of `rows` (sorted tuples), in lexicographic order.
std::vector<Padded> faces_of_degree(const std::vector<std::vector<Index>>& rows, int k) {
  std::vector<Padded> faces;
  for (const auto& row : rows) {
    for (unsigned mask = 0; mask < (1u << row.size()); ++mask) {
      if (std::popcount(mask) != k + 1) continue;
      Padded face{};
      for (std::size_t i = 0, j = 0; i < row.size(); ++i)
        if (mask >> i & 1u) face[j++] = row[i];
      faces.push_back(face);
    }
  }
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace

template <int n>
RowSigns ComplexBuilder<n>::build_mixed(SimplicialComplex<n>& K, const SimplexList& rows, Index vertex_count) {
  std::vector<Sign> signs;
  std::vector<std::vector<Index>> sorted(static_cast<std::size_t>(rows.size()));
  for (Offset row = 0; row < rows.size(); ++row) {
    auto& tuple = sorted[static_cast<std::size_t>(row)];
    tuple.assign(rows[row].begin(), rows[row].end());
    const Sign sign = sort_with_sign(tuple);
    if (static_cast<int>(tuple.size()) == n + 1) signs.push_back(sign);
  }
  const InputReport report = check_input(rows, vertex_count);
  require_valid_input(report, rows, vertex_count);

  for (int k = 0; k <= n; ++k) {
    std::vector<Padded> list = faces_of_degree(sorted, k);
    if (list.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
      throw LimitError(text("there are ", list.size(), " simplices of degree ", k,
                            ", which do not fit the index type; build derham with DERHAM_INDEX64=ON"));
    auto& bucket = K.buckets_[k];
    bucket.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (const Padded& simplex : list) ++bucket[static_cast<std::size_t>(simplex[0]) + 1];
    std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
    if (k == n) {  // top simplices keep the order of the input
      std::vector<Padded> in_order;
      K.top_order_ = BulkArray<Index>(list.size());
      for (const auto& tuple : sorted) {
        if (static_cast<int>(tuple.size()) != n + 1) continue;
        const auto place = std::ranges::lower_bound(list, padded(tuple)) - list.begin();
        K.top_order_[static_cast<std::size_t>(place)] = static_cast<Index>(in_order.size());
        in_order.push_back(padded(tuple));
      }
      list = std::move(in_order);
    }
    auto& simplices = K.simplices_[k] = BulkArray<Index>(list.size() * static_cast<std::size_t>(k + 1));
    Index* vertex = simplices.begin();
    for (const Padded& simplex : list) vertex = std::copy(simplex.begin(), simplex.begin() + k + 1, vertex);
    if (k < 2) continue;
    auto& faces = K.faces_[k] = BulkArray<Index>(simplices.size());
    Index* next = faces.begin();
    for (Index i = 0; i < K.size(k); ++i) {
      const auto simplex = K.simplex(k, i);
      std::array<Index, n + 1> face{};
      for (int omitted = k; omitted >= 0; --omitted) {
        std::copy(simplex.begin(), simplex.begin() + omitted, face.begin());
        std::copy(simplex.begin() + omitted + 1, simplex.end(), face.begin() + omitted);
        *next++ = K.find(std::span<const Index>(face.data(), static_cast<std::size_t>(k))).index;
      }
    }
  }

  std::array<std::vector<char>, n + 1> has_coface;
  for (int k = 0; k <= n; ++k) has_coface[k].assign(static_cast<std::size_t>(K.size(k)), 0);
  for (int k = 1; k <= n; ++k)
    for (const Index face : K.face_table(k)) has_coface[k - 1][static_cast<std::size_t>(face)] = 1;
  for (int k = 0; k < n; ++k)
    for (Index i = 0; i < K.size(k); ++i)
      if (!has_coface[k][static_cast<std::size_t>(i)]) K.maximal_lower_.push_back({k, i});
  Index tops = 0;
  for (const auto& tuple : sorted) {
    const int k = static_cast<int>(tuple.size()) - 1;
    K.rows_.push_back({k, k == n ? tops++ : K.find(tuple).index});
  }
  return {std::move(signs), false};
}

template RowSigns ComplexBuilder<0>::build_mixed(SimplicialComplex<0>&, const SimplexList&, Index);
template RowSigns ComplexBuilder<1>::build_mixed(SimplicialComplex<1>&, const SimplexList&, Index);
template RowSigns ComplexBuilder<2>::build_mixed(SimplicialComplex<2>&, const SimplexList&, Index);
template RowSigns ComplexBuilder<3>::build_mixed(SimplicialComplex<3>&, const SimplexList&, Index);
template RowSigns ComplexBuilder<4>::build_mixed(SimplicialComplex<4>&, const SimplexList&, Index);
template RowSigns ComplexBuilder<5>::build_mixed(SimplicialComplex<5>&, const SimplexList&, Index);
template RowSigns ComplexBuilder<6>::build_mixed(SimplicialComplex<6>&, const SimplexList&, Index);

}  // namespace derham
