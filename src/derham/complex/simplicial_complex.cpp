#include "derham/complex/simplicial_complex.hpp"

#include "derham/complex/construction.hpp"
#include "derham/complex/validation.hpp"
#include "derham/core/disjoint_sets.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace derham {
namespace {

/// The largest dimension of `rows` is not n: throws for the first row that is too long, or else for the first of the
/// longest, none of which is long enough.
[[noreturn]] void refuse_dimension(const SimplexList& rows, int n) {
  if (rows.empty()) throw InputError("there are vertices but no simplices; every vertex must be used by one");
  const int offending = rows.dimension() > n ? n + 1 : rows.dimension();
  Offset row = 0;
  while (static_cast<int>(rows[row].size()) - 1 < offending) ++row;
  throw InputError(text("row ", row, " ", tuple_text(rows[row]), " has dimension ", rows[row].size() - 1,
                        rows.dimension() > n ? ", more than" : ", and no row has", " the dimension ", n,
                        " of the complex; give at least one row of ", n + 1, " vertices and none longer"),
                   row);
}

}  // namespace

template <int n>
SimplicialComplex<n>::SimplicialComplex() {
  for (auto& bucket : buckets_) bucket.assign(1, 0);
}

template <int n>
SimplicialComplex<n>::SimplicialComplex(const SimplexList& rows, Index vertex_count) : SimplicialComplex() {
  if (rows.empty() && vertex_count <= 0) return;
  if (rows.dimension() != n) refuse_dimension(rows, n);
  if (rows.size() > std::numeric_limits<Index>::max())
    throw LimitError(text(rows.size(), " rows do not fit the index type; build derham with DERHAM_INDEX64=ON"));
  const Index vertices = vertex_count < 0 ? rows.vertex_bound() : vertex_count;
  // More vertices than ids: some vertex is unused, found without allocating by the largest id.
  if (vertices < 0 || static_cast<std::size_t>(vertices) > rows.vertices().size())
    require_valid_input(check_input(rows, vertex_count), rows, vertex_count);
  RowSigns signs = ComplexBuilder<n>::build(*this, rows, vertices, vertex_count);
  if (signs.coherent)
    orientation_.sign = std::move(signs.sign);
  else
    orientation_ = coherent_orientation(*this, signs.sign);
}

template <int n>
SignedIndex SimplicialComplex<n>::find(std::span<const Index> alias) const noexcept {
  const int k = static_cast<int>(alias.size()) - 1;
  if (k < 0 || k > n) return {};
  std::array<Index, n + 1> storage{};
  const std::span<Index> tuple(storage.data(), alias.size());
  std::ranges::copy(alias, tuple.begin());
  const Sign permutation = sort_with_sign(tuple);
  if (permutation == 0 || tuple.front() < 0 || tuple.back() >= size(0)) return {};
  if (k == 0) return {tuple[0], 1};
  const auto& bucket = buckets_[static_cast<std::size_t>(k)];
  const auto v = static_cast<std::size_t>(tuple[0]);
  const Index index =
      find_in_bucket(simplices(k), k == n ? std::span<const Index>(top_order_) : std::span<const Index>(), bucket[v],
                     bucket[v + 1], tuple);
  if (index < 0) return {};
  return {index, static_cast<Sign>(permutation * sign(k, index))};
}

template <int n>
SignedIndex SimplicialComplex<n>::at(std::span<const Index> alias) const {
  const SignedIndex found = find(alias);
  if (!found) throw InputError(text(tuple_text(alias), " is not a simplex of the complex"));
  return found;
}

template <int n>
void SimplicialComplex<n>::orient_by(std::span<const double> weight) {
  if (weight.size() != static_cast<std::size_t>(size(n)))
    throw InputError(text("there are ", weight.size(), " weights for ", size(n), " top simplices"));
  if (!orientation_.orientable || n == 0) return;
  bool any_negative = false;  // usually not, and then no sum is
  for (std::size_t t = 0; t < weight.size(); ++t) any_negative |= orientation_.sign[t] * weight[t] < 0;
  if (!any_negative) return;
  const FacetComponents components = facet_components(*this);
  std::vector<double> sum(static_cast<std::size_t>(components.count), 0), magnitude(sum.size(), 0);
  const auto component = [&](std::size_t t) {
    return components.of_top.empty() ? std::size_t{0} : static_cast<std::size_t>(components.of_top[t]);
  };
  for (std::size_t t = 0; t < weight.size(); ++t) {
    sum[component(t)] += orientation_.sign[t] * weight[t];
    magnitude[component(t)] += std::abs(weight[t]);
  }
  for (std::size_t t = 0; t < weight.size(); ++t) {
    const std::size_t c = component(t);
    if (sum[c] < -1e-10 * magnitude[c]) orientation_.sign[t] = static_cast<Sign>(-orientation_.sign[t]);
  }
}

template <int n>
Index SimplicialComplex<n>::component_count() const {
  DisjointSets joined(size(0));
  for (Index e = 0; e < size(1); ++e) {
    const auto edge = simplex(1, e);
    joined.unite(edge[0], edge[1]);
  }
  return joined.count();
}

template <int n>
Offset SimplicialComplex<n>::euler_characteristic() const noexcept {
  Offset chi = 0;
  for (int k = 0; k <= n; ++k) chi += face_sign(k) * static_cast<Offset>(size(k));
  return chi;
}

template class SimplicialComplex<0>;
template class SimplicialComplex<1>;
template class SimplicialComplex<2>;
template class SimplicialComplex<3>;
template class SimplicialComplex<4>;
template class SimplicialComplex<5>;
template class SimplicialComplex<6>;

}  // namespace derham
