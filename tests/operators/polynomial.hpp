#pragma once

#include "derham/operators/minors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

// Polynomials and polynomial forms on R^m with their exterior derivative, for the tests of operators.
namespace derham::test {

struct Polynomial {
  struct Term {
    double coefficient;
    std::vector<int> exponents;  // (m,)
  };
  std::vector<Term> terms;

  [[nodiscard]] double operator()(std::span<const double> x) const {
    double sum = 0;
    for (const auto& [coefficient, exponents] : terms) {
      double product = coefficient;
      for (std::size_t c = 0; c < exponents.size(); ++c)
        for (int i = 0; i < exponents[c]; ++i) product *= x[c];
      sum += product;
    }
    return sum;
  }

  [[nodiscard]] Polynomial derivative(int axis) const {
    Polynomial result;
    for (Term term : terms) {
      int& exponent = term.exponents[static_cast<std::size_t>(axis)];
      if (exponent == 0) continue;
      term.coefficient *= exponent--;
      result.terms.push_back(term);
    }
    return result;
  }
};

/// Calls body(exponents) for all monomials of degree <= degree in `count` variables.
template <class Body>
void for_each_monomial(int count, int degree, Body&& body) {
  std::vector<int> exponents(static_cast<std::size_t>(count), 0);
  while (true) {
    body(exponents);
    std::size_t i = 0;
    int used = 0;
    for (const int e : exponents) used += e;
    for (; i < exponents.size(); ++i) {
      if (used < degree) {
        ++exponents[i];
        break;
      }
      used -= exponents[i];
      exponents[i] = 0;
    }
    if (i == exponents.size()) return;
  }
}

inline Polynomial random_polynomial(int m, int degree, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Polynomial result;
  for_each_monomial(m, degree, [&](const std::vector<int>& exponents) {
    result.terms.push_back({uniform(random), exponents});
  });
  return result;
}

/// Components in lexicographic order.
template <int k>
struct PolynomialForm {
  int m;
  std::vector<Polynomial> component;

  [[nodiscard]] std::vector<double> operator()(std::span<const double> x) const {
    std::vector<double> values;
    for (const auto& p : component) values.push_back(p(x));
    return values;
  }
};

template <int k>
PolynomialForm<k> random_form(int m, int degree, std::uint32_t seed) {
  std::mt19937 random(seed);
  PolynomialForm<k> result{m, {}};
  for (std::size_t i = 0; i < subsets<k>(m).size(); ++i)
    result.component.push_back(random_polynomial(m, degree, random));
  return result;
}

/// (dω)_I = Σ (-1)^j ∂ω_{I without i_j} / ∂x^{i_j}.
template <int k>
PolynomialForm<k + 1> d(const PolynomialForm<k>& w) {
  const auto lower = subsets<k>(w.m);
  PolynomialForm<k + 1> result{w.m, {}};
  for (const auto& I : subsets<k + 1>(w.m)) {
    Polynomial sum;
    for (std::size_t j = 0; j <= k; ++j) {
      std::array<int, static_cast<std::size_t>(k)> rest{};
      for (std::size_t i = 0; i < k; ++i) rest[i] = I[i < j ? i : i + 1];
      const auto place = static_cast<std::size_t>(std::ranges::find(lower, rest) - lower.begin());
      for (auto term : w.component[place].derivative(I[j]).terms) {
        term.coefficient *= j % 2 == 0 ? 1 : -1;
        sum.terms.push_back(term);
      }
    }
    result.component.push_back(sum);
  }
  return result;
}

}  // namespace derham::test
