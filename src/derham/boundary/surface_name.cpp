#include "derham/boundary/surface_name.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace derham::detail {
namespace {

/// The number of boundary circles: of components of the graph of edges with one coface.
Index boundary_circles(const SimplicialComplex<2>& surface) {
  const FacetCofaces cofaces = facet_cofaces(surface);
  std::vector<Index> ends;
  for (Index e = 0; e < surface.size(1); ++e) {
    if (cofaces.count[static_cast<std::size_t>(e)] != 1) continue;
    const auto edge = surface.simplex<1>(e);
    ends.insert(ends.end(), edge.begin(), edge.end());
  }
  if (ends.empty()) return 0;
  return SimplicialComplex<1>(compact_rows(1, std::move(ends))).component_count();
}

std::string with_circles(const std::string& closed, Index circles) {
  if (circles == 0) return closed;
  return text(closed, " with ", circles, circles == 1 ? " hole" : " holes");
}

/// The name of a connected surface. Euler characteristic = 2 - 2 genus - circles, or 2 - crosscaps - circles.
std::string connected_surface_name(const SimplicialComplex<2>& surface) {
  const Index circles = boundary_circles(surface);
  const Offset defect = 2 - surface.euler_characteristic() - circles;
  if (surface.is_orientable()) {
    constexpr std::array planar{"a sphere", "a disc", "an annulus"};
    if (defect == 0 && circles <= 2) return planar[static_cast<std::size_t>(circles)];
    if (defect == 0) return with_circles("a sphere", circles);
    if (defect == 2) return with_circles("a torus", circles);
    return with_circles(text("a surface of genus ", defect / 2), circles);
  }
  if (defect == 1) return circles == 1 ? "a Möbius strip" : with_circles("a projective plane", circles);
  if (defect == 2) return with_circles("a Klein bottle", circles);
  return with_circles(text("a non-orientable surface with ", defect, " crosscaps"), circles);
}

}  // namespace

SimplexList compact_rows(int degree, std::vector<Index> vertices) {
  std::vector<Index> ids = vertices;
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (Index& v : vertices) v = static_cast<Index>(std::ranges::lower_bound(ids, v) - ids.begin());
  return {degree, std::move(vertices)};
}

std::string surface_name(const SimplexList& triangles) {
  const SimplicialComplex<2> surface(triangles);
  const FacetComponents components = facet_components(surface);
  if (components.count == 1) return connected_surface_name(surface);

  constexpr Index named_components = 4;
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(std::min(components.count, named_components)));
  for (Index t = 0; t < surface.size(2); ++t) {
    const auto component = static_cast<std::size_t>(components.of_top[static_cast<std::size_t>(t)]);
    if (component >= rows.size()) continue;
    const auto triangle = surface.simplex<2>(t);
    rows[component].insert(rows[component].end(), triangle.begin(), triangle.end());
  }
  std::string names;
  for (auto& part : rows) {
    names += names.empty() ? "" : ", ";
    names += connected_surface_name(SimplicialComplex<2>(compact_rows(2, std::move(part))));
  }
  return text(components.count, " components (", names, components.count > named_components ? ", …)" : ")");
}

}  // namespace derham::detail
