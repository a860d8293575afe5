#pragma once

#include "derham/core/text.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <algorithm>
#include <string>

namespace derham {

/// Dimension of the simplices that the form has its values on.
inline int simplex_degree(const MeshData& mesh, const MeshForm& form) {
  const int n = std::max(mesh.simplices.dimension(), 0);
  return form.is_dual ? n - form.degree : form.degree;
}

/// Why the form cannot be one on this mesh; empty if it can. The number of its values is known without the complex on
/// vertices and on rows; on the simplices between it is left to those who have the complex.
inline std::string form_defect(const MeshData& mesh, const MeshForm& form) {
  const int n = std::max(mesh.simplices.dimension(), 0), k = simplex_degree(mesh, form);
  if (k < 0 || k > n) return text("a form of degree ", form.degree, " on a mesh of dimension ", n);
  if (k > 0 && k < n) return {};
  const Offset expected = k == 0 ? Offset{mesh.vertex_count} : mesh.simplices.size();
  if (static_cast<Offset>(form.values.size()) == expected) return {};
  return text("a ", form.is_dual ? "dual " : "primal ", form.degree, "-form with ", form.values.size(),
              " values; expected ", expected, k == 0 ? ", one for every vertex" : ", one for every row");
}

}  // namespace derham
