#pragma once

#include "derham/operators/operator.hpp"
#include "support/random_forms.hpp"

#include <gtest/gtest.h>

namespace derham::test {

/// The matrix that an operator makes is what comes out when the identity is fed, and applying it is the same.
template <class From, class To>
void expect_own_matrix(const Operator<From, To>& A) {
  const SparseMatrix difference = A.matrix() - detail::fed_with_identity(*A.map());
  EXPECT_LE(difference.norm(), 1e-13 * (1 + A.matrix().norm()));
  From w(A.from(), support::random_values(A.matrix().cols(), 5));
  EXPECT_LT(support::distance(A(w), A.assembled()(w)), 1e-12 * (1 + A.matrix().norm()));
}

}  // namespace derham::test
