#pragma once

#include "derham/core/types.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace derham {

/// The k-subsets of {0, …, m-1} in lexicographic order: they number the components of k-forms and k-vectors of R^m, so that
/// component I of v_1 ∧ … ∧ v_k is the determinant of the columns I.
/// Shape    C(m, k)
template <int k>
[[nodiscard]] std::vector<std::array<int, static_cast<std::size_t>(k)>> subsets(int m) {
  std::vector<std::array<int, static_cast<std::size_t>(k)>> result;
  if (k > m) return result;
  std::array<int, static_cast<std::size_t>(k)> chosen{};
  for (std::size_t i = 0; i < k; ++i) chosen[i] = static_cast<int>(i);
  while (true) {
    result.push_back(chosen);
    int i = k - 1;
    while (i >= 0 && chosen[static_cast<std::size_t>(i)] == m - k + i) --i;
    if (i < 0) return result;
    int next = ++chosen[static_cast<std::size_t>(i)];
    for (auto j = static_cast<std::size_t>(i) + 1; j < k; ++j) chosen[j] = ++next;
  }
}

/// det of k rows of k numbers, 0 <= k <= 4, by expansion along the first column.
template <int k>
[[nodiscard]] constexpr double determinant(
    const std::array<std::array<double, static_cast<std::size_t>(k)>, static_cast<std::size_t>(k)>& a) noexcept {
  if constexpr (k == 0) {
    return 1;
  } else if constexpr (k == 1) {
    return a[0][0];
  } else if constexpr (k == 2) {
    return a[0][0] * a[1][1] - a[0][1] * a[1][0];
  } else {
    double sum = 0;
    for (std::size_t row = 0; row < k; ++row) {
      std::array<std::array<double, k - 1>, k - 1> minor{};
      for (std::size_t i = 0; i < k; ++i)
        if (i != row)
          for (std::size_t j = 1; j < k; ++j) minor[i - (i > row ? 1 : 0)][j - 1] = a[i][j];
      sum += (row % 2 == 0 ? 1 : -1) * a[row][0] * determinant<k - 1>(minor);
    }
    return sum;
  }
}

/// det of the given columns of k rows, rows[i] pointing to row i.
template <int k>
[[nodiscard]] double minor_of(const std::array<const double*, static_cast<std::size_t>(k)>& rows,
                              const std::array<int, static_cast<std::size_t>(k)>& columns) noexcept {
  std::array<std::array<double, static_cast<std::size_t>(k)>, static_cast<std::size_t>(k)> a{};
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) a[i][j] = rows[i][columns[j]];
  return determinant<k>(a);
}

}  // namespace derham
