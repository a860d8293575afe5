#pragma once

#include "derham/complex/simplicial_complex.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <span>
#include <string>

namespace derham {

/// "3-simplex 17 = (2, 5, 7, 9)".
template <int n>
[[nodiscard]] std::string simplex_text(const SimplicialComplex<n>& K, int k, Index i) {
  return text(k, "-simplex ", i, " = ", tuple_text(K.simplex(k, i)));
}

/// The first few of a list of k-simplices: "3-simplex 17 = (2, 5, 7, 9), 3-simplex 18 = (2, 5, 7, 8) and 40 more".
template <int n>
[[nodiscard]] std::string simplices_text(const SimplicialComplex<n>& K, int k, std::span<const Index> list) {
  constexpr std::size_t shown = 5;
  std::string out;
  for (std::size_t i = 0; i < std::min(shown, list.size()); ++i) out += (i ? ", " : "") + simplex_text(K, k, list[i]);
  return list.size() > shown ? out + text(" and ", list.size() - shown, " more") : out;
}

}  // namespace derham
