#include "derham/boundary/smith_form.hpp"

#include "derham/core/error.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace derham {
namespace {

using Dense = std::vector<std::vector<std::int64_t>>;
using Divisors = std::vector<std::int64_t>;

IntegerMatrix sparse(const Dense& rows) {
  IntegerMatrix A{static_cast<Index>(rows.size()), {0}, {}};
  for (std::size_t j = 0; !rows.empty() && j < rows[0].size(); ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i][j] != 0) A.entries.push_back({static_cast<Index>(i), rows[i][j]});
    A.offsets.push_back(static_cast<Offset>(A.entries.size()));
  }
  return A;
}

TEST(SmithForm, OfSmallMatrices) {
  EXPECT_EQ(smith_form(sparse({})).rank, 0);
  EXPECT_EQ(smith_form(sparse({{0, 0}, {0, 0}})).rank, 0);

  const SmithForm textbook = smith_form(sparse({{2, 4, 4}, {-6, 6, 12}, {10, 4, 16}}));
  EXPECT_EQ(textbook.rank, 3);
  EXPECT_EQ(textbook.divisors, (Divisors{2, 2, 156}));

  const SmithForm coprime = smith_form(sparse({{4, 0}, {0, 9}}));
  EXPECT_EQ(coprime.divisors, Divisors{36}) << "each divisor must divide the next";
  EXPECT_EQ(coprime.rank, 2);

  const SmithForm hidden_unit = smith_form(sparse({{2, 3}}));
  EXPECT_EQ(hidden_unit.rank, 1);
  EXPECT_TRUE(hidden_unit.divisors.empty());
}

TEST(SmithForm, RefusesRowsOutOfRange) {
  const IntegerMatrix A{2, {0, 1}, {{2, 1}}};
  EXPECT_THROW(static_cast<void>(smith_form(A)), InputError);
}

/// p^2 and the divisor lcm(p, 4 q) exceed 63 bits; what comes out fits, or is refused.
TEST(SmithForm, KnowsIntegersOfMoreThan64Bits) {
  const std::int64_t p = 4000000007, q = 3999999979;
  const SmithForm form = smith_form(sparse({{p, q, p * 2}, {q, p, q * 2}, {p * 2, q * 2, p * 4}}));
  EXPECT_EQ(form.rank, 2) << "the third row is twice the first";
  EXPECT_EQ(form.divisors, Divisors{(p - q) * (p + q)});
  EXPECT_THROW(static_cast<void>(smith_form(sparse({{p, 0}, {0, 4 * q}}))), LimitError);
}

/// diag(d) multiplied by random unimodular matrices on both sides must give d back.
TEST(SmithForm, IsInvariantUnderUnimodularChanges) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    const Divisors divisors = {1, 1, 1, 2, 6, 12};
    const std::size_t rows = 9, columns = 8;
    Dense A(rows, std::vector<std::int64_t>(columns, 0));
    for (std::size_t i = 0; i < divisors.size(); ++i) A[i][i] = divisors[i];
    for (int step = 0; step < 40; ++step) {
      const std::size_t r = random() % rows, s = random() % rows, c = random() % columns, e = random() % columns;
      const int sign = random() % 2 ? 1 : -1;
      if (r != s)
        for (std::size_t j = 0; j < columns; ++j) A[r][j] += sign * A[s][j];
      if (c != e)
        for (std::size_t i = 0; i < rows; ++i) A[i][c] += sign * A[i][e];
    }
    const SmithForm form = smith_form(sparse(A));
    EXPECT_EQ(form.rank, 6);
    EXPECT_EQ(form.divisors, (Divisors{2, 6, 12}));
  }
}

}  // namespace
}  // namespace derham
