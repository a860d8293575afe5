#include "matrices.hpp"
#include "rooms.hpp"

#include "derham/geometry/refined_mesh.hpp"
#include "derham/operators/form_space.hpp"
#include "derham/operators/tagged_chain.hpp"
#include "derham/operators/tagged_facets.hpp"
#include "derham/operators/transfer_operators.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

// Boundary conditions, tagged chains, refinement.
namespace derham::python {
namespace {

/// By degree the free simplices and the prescribed ones; without facets the whole boundary is prescribed.
auto form_space(const AnyComplex& any, const std::optional<Indices>& facets) {
  return any.visit<1, max_metric_dimension>([&]<int n>(const Body<n>& body) {
    const FormSpace<n> space = without_gil(
        [&] { return facets ? FormSpace<n>(*body.complex, span_of(*facets)) : FormSpace<n>::relative(*body.complex); });
    std::vector<std::pair<Array<Index>, Array<Index>>> result;
    for (int k = 0; k <= n; ++k) {
      const auto free = space.free(k), prescribed = space.prescribed(k);
      result.emplace_back(owned(std::vector<Index>(free.begin(), free.end())),
                          owned(std::vector<Index>(prescribed.begin(), prescribed.end())));
    }
    return result;
  });
}

/// The chain of a part. Rows of a pure complex are its top simplices, positive ones, and kept by K alone.
template <int k, int n>
Chain<n, k> chain_of(const SimplicialComplex<n>& K, const MeshData& rest, const MeshPart& part) {
  if (k < n || !K.is_pure()) return tagged_chain<k>(K, rest, part);
  std::vector<typename Chain<n, k>::Term> terms;
  for (const Index row : part.members) terms.push_back({row, 1});
  return Chain<n, k>(K, std::move(terms));
}

/// The terms of the chain of part number `number` of the mesh: simplices and coefficients.
auto tagged(const AnyComplex& any, std::size_t number, bool make_coherent) {
  const MeshPart& part = any.rest().parts.at(number);
  std::vector<Index> simplices;
  std::vector<std::int64_t> coefficients;
  without_gil([&] {
    any.with_complex<1, max_metric_dimension>([&]<int n>(const SimplicialComplex<n>& K) {
      with_constant<0, n>(part.degree, "the degree of the part", [&](auto degree) {
        constexpr int k = degree();
        Chain<n, k> chain = chain_of<k>(K, any.rest(), part);
        if constexpr (k >= 1)
          if (make_coherent) chain = coherent(chain);
        for (const auto& [simplex, coefficient] : chain.terms()) {
          simplices.push_back(simplex);
          coefficients.push_back(coefficient);
        }
      });
    });
  });
  return std::pair(owned(std::move(simplices)), owned(std::move(coefficients)));
}

/// The facets that part number `number` of the mesh tags.
auto facets_of(const AnyComplex& any, std::size_t number) {
  return owned(without_gil([&] {
    return any.with_complex<1, max_metric_dimension>(
        [&](const auto& K) { return tagged_facets(K, any.rest(), any.rest().parts.at(number)); });
  }));
}

template <int n>
struct RefinementOf {
  Body<n> coarse;
  Refinement<n> refinement;
  explicit RefinementOf(Body<n> body) : coarse(std::move(body)), refinement(*coarse.complex) {}
};

/// The edgewise subdivision with what it refers to.
class AnyRefinement {
  template <class Action>
  auto visit(Action&& action) const {
    return std::visit(action, refinement_);
  }

 public:
  explicit AnyRefinement(const AnyComplex& any)
      : refinement_(any.visit<1, 4>(
            []<int n>(const Body<n>& body) { return Refinements(std::make_shared<const RefinementOf<n>>(body)); })),
        coarse_mesh_(any.mesh()) {}

  /// The fine complex: that of the refinement itself, with the metric and the parts of the refined mesh.
  [[nodiscard]] AnyComplex fine() const {
    return visit([this]<int n>(const std::shared_ptr<const RefinementOf<n>>& of) {
      std::shared_ptr<const SimplicialComplex<n>> complex(of, &of->refinement.fine());
      return AnyComplex(Body<n>{std::move(complex), {}}, refined_mesh(coarse_mesh_, of->refinement));
    });
  }

  [[nodiscard]] auto prolongation(int k) const {
    return visit([k]<int n>(const std::shared_ptr<const RefinementOf<n>>& of) {
      return arrays_of(without_gil([&] {
        return with_constant<0, n>(k, "the degree k", [&](auto degree) {
          return SparseMatrix(prolongation_operator<degree()>(of->refinement).matrix());
        });
      }));
    });
  }

  [[nodiscard]] auto restriction(int k) const {
    return visit([k]<int n>(const std::shared_ptr<const RefinementOf<n>>& of) {
      return arrays_of(without_gil([&] {
        return with_constant<0, n>(k, "the degree k", [&](auto degree) {
          return SparseMatrix(restriction_operator<degree()>(of->refinement).matrix());
        });
      }));
    });
  }

 private:
  template <int n>
  using Pointer = std::shared_ptr<const RefinementOf<n>>;
  using Refinements = std::variant<Pointer<1>, Pointer<2>, Pointer<3>, Pointer<4>>;
  Refinements refinement_;
  MeshData coarse_mesh_;
};

}  // namespace

void bind_operator_spaces(nb::module_& module, ComplexClass& complex) {
  using nb::arg;
  complex.def("form_space", &form_space, arg("facets").none());
  complex.def("tagged_chain", &tagged, arg("part"), arg("coherent"));
  complex.def("tagged_facets", &facets_of, arg("part"));
  nb::class_<AnyRefinement>(module, "Refinement")
      .def(nb::init<const AnyComplex&>(), arg("complex"), nb::call_guard<Unlocked>())
      .def("fine", &AnyRefinement::fine, nb::call_guard<Unlocked>())
      .def("prolongation", &AnyRefinement::prolongation, arg("k"))
      .def("restriction", &AnyRefinement::restriction, arg("k"));
}

}  // namespace derham::python
