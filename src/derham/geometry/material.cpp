#include "derham/geometry/material.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"
#include "derham/geometry/naming.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace derham {
namespace {

/// ", that of 3-simplex 17 = (2, 5, 7, 9)": the first top simplex that has this row, if any has.
template <int n>
std::string user_of(const Material& material, const SimplicialComplex<n>& K, std::size_t row) {
  const auto size = static_cast<std::size_t>(material.width == 0 ? 1 : material.width * material.width);
  for (Index t = 0; t < K.size(n); ++t)
    if (material.of(t) == material.values.data() + row * size) return text(", that of ", simplex_text(K, n, t));
  return {};
}

/// The first entry (i, j) that differs from (j, i), as j * width + i; width² if there is none.
std::size_t first_asymmetry(const double* tensor, std::size_t width) {
  double largest = 0;
  for (std::size_t i = 0; i < width * width; ++i) largest = std::max(largest, std::abs(tensor[i]));
  for (std::size_t i = 0; i < width; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(tensor[i * width + j] - tensor[j * width + i]) > 1e-12 * largest) return j * width + i;
  return width * width;
}

/// Whether elimination without exchanges meets positive pivots only.
bool is_positive_definite(const double* tensor, std::size_t width) {
  std::vector<double> a(tensor, tensor + width * width);
  for (std::size_t k = 0; k < width; ++k) {
    if (!(a[k * width + k] > 0)) return false;
    for (std::size_t i = k + 1; i < width; ++i)
      for (std::size_t j = k + 1; j < width; ++j)
        a[i * width + j] -= a[i * width + k] * a[k * width + j] / a[k * width + k];
  }
  return true;
}

}  // namespace

template <int n>
void require_fits(const Material& material, const SimplicialComplex<n>& K, const Geometry<n>& geometry) {
  const int d = geometry.coordinate_dimension();
  if (material.width != 0 && material.width != d)
    throw InputError(text("material tensors of width ", material.width, "; expected ", d, ", or 0 for numbers"));
  const std::size_t width = static_cast<std::size_t>(material.width), size = width == 0 ? 1 : width * width;
  const std::size_t rows = material.values.size() / size;
  if (rows == 0 || material.values.size() % size != 0)
    throw InputError(text(material.values.size(), " values of a material; expected a multiple of ", size));
  const auto tops = static_cast<std::size_t>(K.size(n));
  if (material.row_of.empty() ? rows != 1 && rows != tops : material.row_of.size() != tops)
    throw InputError(text("a material of ", rows, " rows and ", material.row_of.size(), " row numbers; there are ",
                          tops, " top simplices: give one row, or one for each of them, or number the rows for each"));
  for (const Index row : material.row_of)
    if (row < 0 || static_cast<std::size_t>(row) >= rows)
      throw InputError(text("row ", row, " of a material of ", rows, " rows"));
  for (std::size_t i = 0; i < material.values.size(); ++i)
    if (!std::isfinite(material.values[i]))
      throw InputError(text("row ", i / size, " of a material", user_of(material, K, i / size), ", holds ",
                            material.values[i], "; values must be finite"));
  for (std::size_t row = 0; width > 0 && row < rows; ++row) {
    const double* const tensor = material.values.data() + row * size;
    const std::size_t entry = first_asymmetry(tensor, width), i = entry % width, j = entry / width;
    if (entry < size)
      throw InputError(text("tensor ", row, " of a material", user_of(material, K, row), ", is not symmetric: entry (",
                            i, ", ", j, ") is ", tensor[i * width + j], ", entry (", j, ", ", i, ") is ",
                            tensor[j * width + i]));
  }
}

template <int n>
void require_positive(const Material& material, const SimplicialComplex<n>& K) {
  if (material.width > n) return;
  const auto width = static_cast<std::size_t>(std::max(1, material.width));
  for (Index t = 0; t < K.size(n); ++t)
    if (!is_positive_definite(material.of(t), width))
      throw GeometryError(text("the material of ", simplex_text(K, n, t), " is ",
                               material.width == 0 ? text(*material.of(t)) : "a tensor that is not positive definite",
                               "; it must be positive"));
}

#define DERHAM_INSTANTIATE(n)                                                                   \
  template void require_fits(const Material&, const SimplicialComplex<n>&, const Geometry<n>&); \
  template void require_positive(const Material&, const SimplicialComplex<n>&);
DERHAM_INSTANTIATE(0)
DERHAM_INSTANTIATE(1)
DERHAM_INSTANTIATE(2)
DERHAM_INSTANTIATE(3)
DERHAM_INSTANTIATE(4)
#undef DERHAM_INSTANTIATE

}  // namespace derham
