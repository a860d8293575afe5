#pragma once

#include "derham/core/types.hpp"

#include <array>

namespace derham {

/// The sign of det[p1-p0, ..., pn-p0]: +1 when the simplex (p0, ..., pn) of R^n is positively oriented, -1 when
/// negatively, 0 exactly when it is flat. The answer is that of exact arithmetic on the given doubles, whatever their
/// exponents. `points[i]` are the n finite coordinates of corner i.
/// Cost     one determinant; exact integers only where its rounding error could hide the sign
/// Source   the filter is the standard forward error analysis (Higham 2002, §3.1; Shewchuk 1997 for the idea)
template <int n>
[[nodiscard]] Sign orientation_sign(const std::array<const double*, n + 1>& points);

}  // namespace derham
