#include "derham/geometry/material.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cmath>

namespace derham {
namespace {

void require_symmetric(const double* tensor, std::size_t width, std::size_t row) {
  double largest = 0;
  for (std::size_t i = 0; i < width * width; ++i) largest = std::max(largest, std::abs(tensor[i]));
  for (std::size_t i = 0; i < width; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(tensor[i * width + j] - tensor[j * width + i]) > 1e-12 * largest)
        throw InputError(text("tensor ", row, " of a material is not symmetric: entry (", i, ", ", j, ") is ",
                              tensor[i * width + j], ", entry (", j, ", ", i, ") is ", tensor[j * width + i]));
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
      throw InputError(text("row ", i / size, " of a material holds ", material.values[i], "; values must be finite"));
  if (width > 0)
    for (std::size_t row = 0; row < rows; ++row) require_symmetric(material.values.data() + row * size, width, row);
}

template void require_fits(const Material&, const SimplicialComplex<0>&, const Geometry<0>&);
template void require_fits(const Material&, const SimplicialComplex<1>&, const Geometry<1>&);
template void require_fits(const Material&, const SimplicialComplex<2>&, const Geometry<2>&);
template void require_fits(const Material&, const SimplicialComplex<3>&, const Geometry<3>&);
template void require_fits(const Material&, const SimplicialComplex<4>&, const Geometry<4>&);

}  // namespace derham
