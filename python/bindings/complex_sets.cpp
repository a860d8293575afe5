#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/complex/incidence.hpp"
#include "derham/complex/subcomplex.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

// Neighbours of simplices, and sets of them: closure, star, link, boundary.
namespace derham::python {
namespace {

auto incident(const AnyComplex& any, int k, int m) {
  auto table = without_gil([&] { return any.with_complex([&](const auto& K) { return incidence(K, k, m); }); });
  return std::pair(owned(std::move(table.offsets)), owned(std::move(table.indices)));
}

/// A set of simplices as Python has it: the increasing indices of every degree.
using Lists = std::vector<Indices>;

template <int n>
SimplexSet<n> set_of(const Lists& lists) {
  SimplexSet<n> set;
  for (std::size_t k = 0; k < std::min(lists.size(), set.indices.size()); ++k) set.indices[k] = copied(lists[k]);
  return set;
}

template <class Set>
auto lists_of(Set set) {
  return owned_each(std::move(set.indices));
}

auto closure_of(const AnyComplex& any, const Lists& lists) {
  return any.with_complex([&]<int n>(const SimplicialComplex<n>& K) {
    return lists_of(without_gil([&] { return closure(K, set_of<n>(lists)); }));
  });
}

auto open_star_of(const AnyComplex& any, const Lists& lists) {
  return any.with_complex([&]<int n>(const SimplicialComplex<n>& K) {
    return lists_of(without_gil([&] { return star(CofaceLists<n>(K), set_of<n>(lists)); }));
  });
}

auto link_of(const AnyComplex& any, const Lists& lists) {
  return any.with_complex([&]<int n>(const SimplicialComplex<n>& K) {
    return lists_of(without_gil([&] { return link(K, CofaceLists<n>(K), set_of<n>(lists)); }));
  });
}

auto boundary_of(const AnyComplex& any) {
  return any.with_complex([](const auto& K) { return lists_of(without_gil([&] { return boundary_simplices(K); })); });
}

}  // namespace

void bind_complex_sets(ComplexClass& complex) {
  using nb::arg;
  complex.def("incidence", &incident, arg("k"), arg("m"));
  complex.def("closure", &closure_of, arg("set"));
  complex.def("open_star", &open_star_of, arg("set"));
  complex.def("link", &link_of, arg("set"));
  complex.def("boundary_simplices", &boundary_of);
}

}  // namespace derham::python
