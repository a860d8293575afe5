#pragma once

#include "arrays.hpp"

#include "derham/operators/linear_map.hpp"

#include <memory>
#include <tuple>

namespace derham::python {

/// The arrays of a sparse matrix by rows: values, indices, pointers. They are its memory and keep it alive together.
[[nodiscard]] inline auto arrays_of(SparseMatrix given) {
  given.makeCompressed();
  const auto matrix = std::make_shared<SparseMatrix>(std::move(given));
  const auto array = [&matrix](auto* data, Eigen::Index size) {
    auto* const kept = new std::shared_ptr<SparseMatrix>(matrix);
    const nb::capsule owner(kept,
                            [](void* memory) noexcept { delete static_cast<std::shared_ptr<SparseMatrix>*>(memory); });
    return Array<std::remove_pointer_t<decltype(data)>>(data, {static_cast<std::size_t>(size)}, owner);
  };
  return std::tuple(array(matrix->valuePtr(), matrix->nonZeros()), array(matrix->innerIndexPtr(), matrix->nonZeros()),
                    array(matrix->outerIndexPtr(), matrix->outerSize() + 1));
}

}  // namespace derham::python
