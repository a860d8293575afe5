#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace derham {

/// A finitely generated abelian group Z^betti + sum of Z_d over the torsion coefficients d.
struct HomologyGroup {
  Index betti = 0;
  std::vector<std::int64_t> torsion;  ///< each > 1 and dividing the next
  friend bool operator==(const HomologyGroup&, const HomologyGroup&) = default;
};

/// The integer homology H_0, …, H_n of a small complex (a link): exact, with torsion.
/// Shape    n+1 groups
/// Cost     one Smith form per boundary matrix; meant for complexes of up to some 10^5 simplices
/// Source   Munkres, "Elements of Algebraic Topology", 1984, §11
template <int n>
[[nodiscard]] std::vector<HomologyGroup> small_homology(const SimplicialComplex<n>& K);

/// Whether `groups` are H_0, …, H_n of a sphere S^n (n >= 0).
[[nodiscard]] bool is_homology_of_sphere(std::span<const HomologyGroup> groups);

/// Whether `groups` are those of a point, hence of a ball.
[[nodiscard]] bool is_homology_of_point(std::span<const HomologyGroup> groups);

/// For messages: "H_0 = Z, H_1 = Z_3, H_2 = 0, H_3 = Z".
[[nodiscard]] std::string homology_text(std::span<const HomologyGroup> groups);

}  // namespace derham
