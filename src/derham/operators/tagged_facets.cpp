#include "derham/operators/tagged_facets.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/operators/tagged_chain.hpp"

#include <algorithm>
#include <utility>

namespace derham {
namespace {

/// Of a row that is known to be a facet.
template <int n>
Index facet_of(const SimplicialComplex<n>& K, const MeshData& mesh, Index member) {
  if constexpr (n == 1) return member;
  const auto& rows = mesh.simplices.dimension() == n - 1 ? mesh.simplices : mesh.lower[n - 1];
  return K.find(rows[member]).index;
}

template <int n>
void append(const SimplicialComplex<n>& K, const FacetCofaces& cofaces, const MeshData& mesh, const MeshPart& part,
            std::vector<Index>& facets) {
  // As a chain only to be checked: a facet that is listed with both orientations cancels there.
  (void)tagged_chain<n - 1>(K, mesh, part);
  for (const Index member : part.members) {
    const Index facet = facet_of(K, mesh, member), count = cofaces.count[static_cast<std::size_t>(facet)];
    if (count != 1)
      throw InputError(text("part ", part.number, " '", part.name, "' tags ", tuple_text(K.simplex(n - 1, facet)),
                            ", which is not on the boundary but in ", count, " ", n,
                            "-simplices; leave it out, or prescribe values on it by FormSpace(K, facets)"),
                       member);
    facets.push_back(facet);
  }
}

std::vector<Index> each_once(std::vector<Index> facets) {
  std::ranges::sort(facets);
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

}  // namespace

template <int n>
  requires(n >= 1)
std::vector<Index> tagged_facets(const SimplicialComplex<n>& K, const MeshData& mesh, const MeshPart& part) {
  std::vector<Index> facets;
  append(K, facet_cofaces(K), mesh, part, facets);
  return each_once(std::move(facets));
}

template <int n>
  requires(n >= 1)
std::vector<Index> tagged_facets(const SimplicialComplex<n>& K, const MeshData& mesh,
                                 std::initializer_list<std::string_view> names) {
  const FacetCofaces cofaces = facet_cofaces(K);
  std::vector<Index> facets;
  for (const std::string_view name : names) append(K, cofaces, mesh, tagged_part(mesh, n - 1, name), facets);
  return each_once(std::move(facets));
}

#define DERHAM_INSTANTIATE(n)                                                                               \
  template std::vector<Index> tagged_facets(const SimplicialComplex<n>&, const MeshData&, const MeshPart&); \
  template std::vector<Index> tagged_facets(const SimplicialComplex<n>&, const MeshData&,                   \
                                            std::initializer_list<std::string_view>);
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
