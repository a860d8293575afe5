#pragma once

#include "derham/forms/form.hpp"
#include "support/random_rows.hpp"
#include "support/random_values.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace derham::support {

/// A random pure complex, mostly non-manifold; every fourth also has maximal simplices of lower dimension.
template <int n>
SimplicialComplex<n> random_complex(std::uint64_t seed) {
  Random random(seed);
  return SimplicialComplex<n>(simplex_list(seed % 4 == 0 ? random_mixed(n, random) : random_pure(n, random)));
}

/// Normally distributed values.
template <int n, int k, Side side = Side::primal>
Form<n, k, side> random_form(const SimplicialComplex<n>& K, std::uint64_t seed) {
  return Form<n, k, side>(K, random_values(K.size(Form<n, k, side>::simplex_degree), seed));
}

/// Integers: sums are exact.
template <int n, int k, Side side = Side::primal>
Form<n, k, side> random_integer_form(const SimplicialComplex<n>& K, std::uint64_t seed) {
  return Form<n, k, side>(K, random_integers(K.size(Form<n, k, side>::simplex_degree), seed));
}

/// The largest value of a - b in magnitude.
template <int n, int k, Side side>
double distance(const Form<n, k, side>& a, const Form<n, k, side>& b) {
  double largest = 0;
  for (Index i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Calls f with 0, …, last as constants.
template <int last, class F>
void for_degrees(F&& f) {
  if constexpr (last >= 0) {
    for_degrees<last - 1>(f);
    f(std::integral_constant<int, last>());
  }
}

}  // namespace derham::support
