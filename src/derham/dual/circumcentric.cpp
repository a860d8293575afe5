#include "derham/dual/circumcentric.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/dual/kept_volumes.hpp"
#include "derham/geometry/naming.hpp"

#include <cmath>
#include <utility>

namespace derham {

template <int n>
CircumcentricDual<n> circumcentric_dual(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  CircumcentricDual<n> result;
  detail::KeptVolumes<n> sink(K, result);
  detail::run_recursion(K, geometry, sink, result);
  return result;
}

template <int n>
ByDegree<n> dual_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  auto result = circumcentric_dual(K, geometry);
  if (!result.degenerate.empty())
    throw GeometryError(text("dual volumes do not exist: ", result.degenerate.size(), " flat top simplices: ",
                             simplices_text<n>(K, n, result.degenerate), "; move their vertices or remove them"));
  for (int k = 0; k <= n; ++k)
    for (Index i = 0; i < K.size(k); ++i)
      if (std::isnan(result.dual[k][i]))
        throw GeometryError(
            text("the dual volume of ", simplex_text(K, k, i),
                 " is out of the range of doubles; scale the mesh so that edge lengths are closer to 1"));
  return std::move(result.dual);
}

#define DERHAM_INSTANTIATE(n)                                                                           \
  template CircumcentricDual<n> circumcentric_dual<n>(const SimplicialComplex<n>&, const Geometry<n>&); \
  template ByDegree<n> dual_volumes<n>(const SimplicialComplex<n>&, const Geometry<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
