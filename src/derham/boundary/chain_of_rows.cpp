#include "derham/boundary/chain_of_rows.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>

namespace derham {

template <int k, int n>
Chain<n, k> chain_of_rows(const SimplicialComplex<n>& K, const SimplexList& rows, std::span<const Index> members) {
  std::vector<typename Chain<n, k>::Term> terms;
  terms.reserve(members.size());
  for (const Index row : members) {
    if (row < 0 || row >= rows.size())
      throw InputError(text("row ", row, " of a list of ", rows.size(), " simplices"), row);
    const auto vertices = rows[row];
    if (vertices.size() != static_cast<std::size_t>(k) + 1)
      throw InputError(text("row ", row, ", ", tuple_text(vertices), ", has ", vertices.size(),
                            " vertices; a simplex of this chain has ", k + 1),
                       row);
    const SignedIndex found = K.find(vertices);
    if (!found) throw InputError(text("row ", row, ", ", tuple_text(vertices), ", is no simplex of the complex"), row);
    terms.push_back({found.index, found.sign});
  }
  return Chain<n, k>(K, std::move(terms));
}

template <int n, int k>
  requires(k >= 1)
Chain<n, k> coherent(const Chain<n, k>& chain) {
  const auto& K = chain.complex();
  if (chain.is_zero()) return chain;
  std::vector<Index> rows;
  for (const auto& [simplex, coefficient] : chain.terms()) {
    const auto vertices = K.simplex(k, simplex);
    rows.insert(rows.end(), vertices.begin(), vertices.end());
    if (coefficient * K.sign(k, simplex) < 0) std::swap(rows.end()[-1], rows.end()[-2]);
  }
  std::vector<Index> used = rows;
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (Index& v : rows) v = static_cast<Index>(std::ranges::lower_bound(used, v) - used.begin());

  const SimplicialComplex<k> S(SimplexList(k, std::move(rows)));
  if (std::ranges::any_of(facet_cofaces(S).count, [](Index count) { return count > 2; }))
    throw TopologyError("more than two simplices of the chain meet in a face; it has no coherent orientation");
  if (!S.is_orientable()) throw TopologyError("the simplices of the chain are not orientable");
  auto terms = std::vector(chain.terms().begin(), chain.terms().end());
  for (std::size_t i = 0; i < terms.size(); ++i)
    terms[i].coefficient = S.sign(k, static_cast<Index>(i)) * K.sign(k, terms[i].simplex);
  return Chain<n, k>(K, std::move(terms));
}

#define DERHAM_ROWS(n, k) \
  template Chain<n, k> chain_of_rows<k, n>(const SimplicialComplex<n>&, const SimplexList&, std::span<const Index>);
#define DERHAM_CHAIN(n, k) \
  DERHAM_ROWS(n, k)        \
  template Chain<n, k> coherent(const Chain<n, k>&);
DERHAM_ROWS(0, 0)
DERHAM_ROWS(1, 0)
DERHAM_CHAIN(1, 1)
DERHAM_ROWS(2, 0)
DERHAM_CHAIN(2, 1)
DERHAM_CHAIN(2, 2)
DERHAM_ROWS(3, 0)
DERHAM_CHAIN(3, 1)
DERHAM_CHAIN(3, 2)
DERHAM_CHAIN(3, 3)
DERHAM_ROWS(4, 0)
DERHAM_CHAIN(4, 1)
DERHAM_CHAIN(4, 2)
DERHAM_CHAIN(4, 3)
DERHAM_CHAIN(4, 4)
#undef DERHAM_CHAIN
#undef DERHAM_ROWS

}  // namespace derham
