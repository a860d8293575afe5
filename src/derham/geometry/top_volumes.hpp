#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"

#include <vector>

namespace derham {

/// What one look at every top simplex gives.
struct TopVolumes {
  std::vector<double> volume;     ///< (|K_n|,) of the representatives, signed where geometry.has_signed_volume()
  std::vector<Index> degenerate;  ///< as QualityReport::degenerate
};

/// A volume of -0.0 is that of a negative simplex which is out of the range of doubles.
template <int n>
[[nodiscard]] TopVolumes top_volumes(const SimplicialComplex<n>& K, const Geometry<n>& geometry);

}  // namespace derham
