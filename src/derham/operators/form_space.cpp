#include "derham/operators/form_space.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

namespace derham {

template <int n>
FormSpace<n>::FormSpace(const SimplicialComplex<n>& K, std::span<const Index> facets) : complex_(&K) {
  std::vector<bool> inside(static_cast<std::size_t>(K.size(n - 1))), below;
  for (const Index f : facets) {
    if (f < 0 || f >= K.size(n - 1)) throw InputError(text("facet ", f, " of a part; there are ", K.size(n - 1)));
    inside[static_cast<std::size_t>(f)] = true;
  }
  for (Index t = 0; t < K.size(n); ++t) free_[n].push_back(t);
  for (int k = n - 1; k >= 0; --k) {
    const auto degree = static_cast<std::size_t>(k);
    for (Index i = 0; i < K.size(k); ++i)
      (inside[static_cast<std::size_t>(i)] ? prescribed_ : free_)[degree].push_back(i);
    if (k == 0) break;
    below.assign(static_cast<std::size_t>(K.size(k - 1)), false);
    for (const Index i : prescribed_[degree])
      for (const Index face : K.faces(k, i)) below[static_cast<std::size_t>(face)] = true;
    inside = below;
  }
}

template <int n>
FormSpace<n> FormSpace<n>::relative(const SimplicialComplex<n>& K) {
  const FacetCofaces cofaces = facet_cofaces(K);
  std::vector<Index> boundary;
  for (Index f = 0; f < K.size(n - 1); ++f)
    if (cofaces.count[static_cast<std::size_t>(f)] == 1) boundary.push_back(f);
  return FormSpace(K, boundary);
}

template <int n>
std::span<const Index> FormSpace<n>::free(int k) const& {
  require_degree(k);
  return free_[static_cast<std::size_t>(k)];
}

template <int n>
std::span<const Index> FormSpace<n>::prescribed(int k) const& {
  require_degree(k);
  return prescribed_[static_cast<std::size_t>(k)];
}

template <int n>
SparseMatrix FormSpace<n>::extension(int k) const {
  const auto rows = free(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < rows.size(); ++j)
    entries.emplace_back(static_cast<int>(rows[j]), static_cast<int>(j), 1.0);
  SparseMatrix result(complex_->size(k), static_cast<Eigen::Index>(rows.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

template <int n>
void FormSpace<n>::require_degree(int k) const {
  if (k < 0 || k > n) throw InputError(text("forms of degree ", k, "; degrees are 0 to ", n));
}

template <int n>
void FormSpace<n>::require_same(const SimplicialComplex<n>& K) const {
  if (&K != complex_) throw InputError("the form and the form space belong to different complexes");
}

template <int n>
void FormSpace<n>::require_length(int k, std::size_t length) const {
  if (length != free(k).size())
    throw InputError(text(length, " values for the free ", k, "-simplices, of which there are ", free(k).size()));
}

template class FormSpace<1>;
template class FormSpace<2>;
template class FormSpace<3>;
template class FormSpace<4>;

}  // namespace derham
