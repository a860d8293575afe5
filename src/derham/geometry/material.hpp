#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/types.hpp"
#include "derham/geometry/geometry.hpp"

#include <cstddef>
#include <vector>

namespace derham {

/// What a metric is weighed with: a number or a symmetric tensor for every top simplex, for all of them, or for every tag.
///
/// Tensors are in the coordinates of geometry.corners(): those of R^m, or, with edge lengths only, of the frame of every top
/// simplex itself; of a surface in space their tangential part counts.
/// Units    any: those of the result are multiplied by them
struct Material {
  /// (rows,) numbers, or (rows, width, width) tensors row-major.
  std::vector<double> values{1.0};

  /// 0 for numbers; for tensors coordinate_dimension() of the geometry.
  int width = 0;

  /// (|K_n|,) the row of every top simplex, for instance its tag; empty: its own, or the only one.
  std::vector<Index> row_of{};

  /// The number or tensor of top simplex t.
  [[nodiscard]] const double* of(Index t) const noexcept {
    const std::size_t size = width == 0 ? 1 : static_cast<std::size_t>(width) * static_cast<std::size_t>(width);
    if (values.size() == size) return values.data();
    return values.data() + size * static_cast<std::size_t>(row_of.empty() ? t : row_of[static_cast<std::size_t>(t)]);
  }
};

/// Throws   InputError on a wrong shape, a row that is not there, a value that is not finite, or a tensor that is not
///          symmetric to 1e-12 of its largest entry (names the first, and a top simplex that has it)
template <int n>
void require_fits(const Material& material, const SimplicialComplex<n>& K, const Geometry<n>& geometry);

/// Tensors wider than n are passed over: only their tangential parts must be positive.
/// Throws   GeometryError naming the first top simplex whose number is not positive or tensor not positive definite
template <int n>
void require_positive(const Material& material, const SimplicialComplex<n>& K);

}  // namespace derham
