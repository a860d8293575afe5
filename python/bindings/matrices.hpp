#pragma once

#include "arrays.hpp"

#include "derham/operators/linear_map.hpp"

#include <memory>
#include <span>
#include <tuple>

namespace derham::python {

/// The arrays of a sparse matrix by rows: values, indices, pointers. They are its memory and keep it alive together.
[[nodiscard]] inline auto arrays_of(SparseMatrix given) {
  given.makeCompressed();
  const auto matrix = std::make_shared<SparseMatrix>(std::move(given));
  const auto entries = static_cast<std::size_t>(matrix->nonZeros());
  const auto rows = static_cast<std::size_t>(matrix->outerSize());
  return std::tuple(view(std::span(matrix->valuePtr(), entries), matrix),
                    view(std::span(matrix->innerIndexPtr(), entries), matrix),
                    view(std::span(matrix->outerIndexPtr(), rows + 1), matrix));
}

}  // namespace derham::python
