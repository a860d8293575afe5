#include "derham/operators/whitney_map.hpp"

#include "derham/operators/not_flat.hpp"

namespace derham {

template <int n>
WhitneyMap<n>::WhitneyMap(const SimplicialComplex<n>& K, const Geometry<n>& geometry)
    : complex_(&K), geometry_(&geometry) {
  detail::require_not_flat(K, geometry);
}

template class WhitneyMap<0>;
template class WhitneyMap<1>;
template class WhitneyMap<2>;
template class WhitneyMap<3>;
template class WhitneyMap<4>;

// Component c of X goes with the set of all axes but c, which is number m-1-c in lexicographic order.
std::vector<double> flux_vectors(std::span<const double> components, int m) {
  const auto width = static_cast<std::size_t>(m);
  if (m < 1 || components.size() % width != 0)
    throw InputError(
        text(components.size(), " components of (m-1)-forms in dimension m = ", m, "; expected m for every point"));
  std::vector<double> result(components.size());
  for (std::size_t row = 0; row < components.size(); row += width)
    for (std::size_t c = 0; c < width; ++c) result[row + c] = (c % 2 == 0 ? 1 : -1) * components[row + width - 1 - c];
  return result;
}

}  // namespace derham
