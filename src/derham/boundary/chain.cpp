#include "derham/boundary/chain.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace derham {
namespace {

[[noreturn]] void refuse_overflow(int k, Index simplex) {
  throw LimitError(text("the coefficient of simplex ", simplex, " of degree ", k, " does not fit 64 bits"));
}

}  // namespace

template <int n, int k>
Chain<n, k>::Chain(const SimplicialComplex<n>& K, std::vector<Term> terms) : complex_(&K), terms_(std::move(terms)) {
  for (const Term& term : terms_)
    if (term.simplex < 0 || term.simplex >= K.size(k))
      throw InputError(text("simplex ", term.simplex, " of degree ", k, "; allowed are 0 to ", K.size(k) - 1));
  normalize();
}

template <int n, int k>
void Chain<n, k>::add(std::span<const Index> alias, std::int64_t coefficient) {
  if (alias.size() != static_cast<std::size_t>(k) + 1)
    throw InputError(text(tuple_text(alias), " has ", alias.size(), " vertices; a simplex of this chain has ", k + 1));
  const SignedIndex found = complex_->at(alias);
  auto terms = terms_;
  terms.push_back({found.index, found.sign * coefficient});
  *this = Chain(*complex_, std::move(terms));
}

template <int n, int k>
std::int64_t Chain<n, k>::operator()(std::initializer_list<Index> alias) const {
  if (alias.size() != static_cast<std::size_t>(k) + 1)
    throw InputError(text("an alias of ", alias.size(), " vertices; a simplex of this chain has ", k + 1));
  const SignedIndex found = complex_->at(alias);
  const auto term = std::ranges::lower_bound(terms_, found.index, {}, &Term::simplex);
  return term == terms_.end() || term->simplex != found.index ? 0 : found.sign * term->coefficient;
}

template <int n, int k>
Chain<n, k>& Chain<n, k>::operator+=(const Chain& other) {
  if (complex_ != other.complex_) throw InputError("the chains belong to different complexes");
  std::vector<Term> terms;
  terms.reserve(terms_.size() + other.terms_.size());
  std::ranges::copy(terms_, std::back_inserter(terms));
  std::ranges::copy(other.terms_, std::back_inserter(terms));
  return *this = Chain(*complex_, std::move(terms));
}

template <int n, int k>
Chain<n, k>& Chain<n, k>::operator-=(const Chain& other) {
  return *this += -other;
}

template <int n, int k>
Chain<n, k>& Chain<n, k>::operator*=(std::int64_t factor) {
  auto terms = terms_;
  for (Term& term : terms)
    if (__builtin_mul_overflow(term.coefficient, factor, &term.coefficient)) refuse_overflow(k, term.simplex);
  if (factor == 0) terms.clear();
  terms_ = std::move(terms);
  return *this;
}

template <int n, int k>
void Chain<n, k>::normalize() {
  std::ranges::sort(terms_, {}, &Term::simplex);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms_.size();) {
    Term sum = terms_[i];
    for (++i; i < terms_.size() && terms_[i].simplex == sum.simplex; ++i)
      if (__builtin_add_overflow(sum.coefficient, terms_[i].coefficient, &sum.coefficient))
        refuse_overflow(k, sum.simplex);
    if (sum.coefficient != 0) terms_[kept++] = sum;
  }
  terms_.resize(kept);
}

template <int n, int k>
  requires(k >= 1)
Chain<n, k - 1> boundary(const Chain<n, k>& chain) {
  const auto& K = chain.complex();
  std::vector<typename Chain<n, k - 1>::Term> terms;
  terms.reserve(chain.terms().size() * (k + 1));
  for (const auto& [simplex, coefficient] : chain.terms()) {
    const auto faces = K.template faces<k>(simplex);
    for (int j = 0; j <= k; ++j)
      terms.push_back({faces[static_cast<std::size_t>(j)], coefficient * K.sign(k, simplex) * face_sign(k - j)});
  }
  return Chain<n, k - 1>(K, std::move(terms));
}

template <int n>
Chain<n, n> fundamental_chain(const SimplicialComplex<n>& K) {
  if (!K.is_orientable())
    throw TopologyError(
        "the complex is not orientable and has no fundamental chain; see orientation().one_sided for a cycle of top "
        "simplices that reverses orientation");
  std::vector<typename Chain<n, n>::Term> terms;
  for (Index i = 0; i < K.size(n); ++i) terms.push_back({i, 1});
  return Chain<n, n>(K, std::move(terms));
}

#define DERHAM_CHAIN(n, k) template class Chain<n, k>;
#define DERHAM_CHAIN_BOUNDARY(n, k) \
  DERHAM_CHAIN(n, k)                \
  template Chain<n, k - 1> boundary(const Chain<n, k>&);
#define DERHAM_DIMENSION(n) \
  DERHAM_CHAIN(n, 0)        \
  template Chain<n, n> fundamental_chain(const SimplicialComplex<n>&);
DERHAM_DIMENSION(0)
DERHAM_DIMENSION(1)
DERHAM_CHAIN_BOUNDARY(1, 1)
DERHAM_DIMENSION(2)
DERHAM_CHAIN_BOUNDARY(2, 1)
DERHAM_CHAIN_BOUNDARY(2, 2)
DERHAM_DIMENSION(3)
DERHAM_CHAIN_BOUNDARY(3, 1)
DERHAM_CHAIN_BOUNDARY(3, 2)
DERHAM_CHAIN_BOUNDARY(3, 3)
DERHAM_DIMENSION(4)
DERHAM_CHAIN_BOUNDARY(4, 1)
DERHAM_CHAIN_BOUNDARY(4, 2)
DERHAM_CHAIN_BOUNDARY(4, 3)
DERHAM_CHAIN_BOUNDARY(4, 4)
DERHAM_DIMENSION(5)
DERHAM_CHAIN_BOUNDARY(5, 1)
DERHAM_CHAIN_BOUNDARY(5, 2)
DERHAM_CHAIN_BOUNDARY(5, 3)
DERHAM_CHAIN_BOUNDARY(5, 4)
DERHAM_CHAIN_BOUNDARY(5, 5)
DERHAM_DIMENSION(6)
DERHAM_CHAIN_BOUNDARY(6, 1)
DERHAM_CHAIN_BOUNDARY(6, 2)
DERHAM_CHAIN_BOUNDARY(6, 3)
DERHAM_CHAIN_BOUNDARY(6, 4)
DERHAM_CHAIN_BOUNDARY(6, 5)
DERHAM_CHAIN_BOUNDARY(6, 6)
#undef DERHAM_DIMENSION
#undef DERHAM_CHAIN_BOUNDARY
#undef DERHAM_CHAIN

}  // namespace derham
