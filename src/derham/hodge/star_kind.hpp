#pragma once

#include <variant>
#include <vector>

namespace derham {

/// Dual cells whose corners are circumcentres: orthogonal to their simplices, with signed volumes. Consistent in every degree.
struct Circumcentric {};

/// The same with power centres: a weight for every vertex moves the cells without turning them. See power_dual.
struct PowerCircumcentric {
  std::vector<double> weights;  ///< (|V|,); units length²
};

/// Dual cells whose corners are barycentres: always positive, but not orthogonal to their simplices. For 0 < k < n this
/// diagonal star is not consistent: what is computed with it does not converge to the solution, on any family of meshes
/// but special ones. Only degrees 0 and n are good for use.
struct Barycentric {};

/// The lumped mass: an equal share of every top simplex for each of its vertices, and 1/|T|. Degrees 0 and n only, where it is
/// that of Barycentric.
struct Lumped {};

/// Which dual cells a diagonal Hodge star is made of.
using StarKind = std::variant<Circumcentric, PowerCircumcentric, Barycentric, Lumped>;

}  // namespace derham
