#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/forms/dual_wedge.hpp"
#include "derham/forms/trace.hpp"
#include "derham/forms/wedge.hpp"

#include <memory>
#include <vector>

namespace derham::python {
namespace {

void wedge_of(const AnyComplex& any, int p, const Values& a, int q, const Values& b, const Output& y) {
  without_gil(
      [&] { any.with_complex([&](const auto& K) { apply_wedge(K, p, span_of(a), q, span_of(b), span_of(y)); }); });
}

/// f ∧ a of a function and a q-form, not both primal.
auto function_wedge(const AnyComplex& any, bool f_dual, const Values& f, bool a_dual, int q, const Values& a) {
  return any.with_complex([&]<int n>(const SimplicialComplex<n>& K) {
    return owned(without_gil([&] {
      return with_constant<0, n>(q, "the degree q", [&](auto degree) {
        using Primal = PrimalForm<n, degree()>;
        using Dual = DualForm<n, degree()>;
        if (!f_dual) return values_of(wedge(PrimalForm<n, 0>(K, copied(f)), Dual(K, copied(a))));
        const DualForm<n, 0> g(K, copied(f));
        return a_dual ? values_of(wedge(g, Dual(K, copied(a)))) : values_of(wedge(g, Primal(K, copied(a))));
      });
    }));
  });
}

/// a ∧ b of dual 1-forms in dimension 2.
auto polygon_wedge(const AnyComplex& any, const Values& a, const Values& b) {
  return any.with_complex<2, 2>([&](const SimplicialComplex<2>& K) {
    return owned(
        without_gil([&] { return values_of(wedge(DualForm<2, 1>(K, copied(a)), DualForm<2, 1>(K, copied(b)))); }));
  });
}

auto trace_of(const AnyBoundary& any, int k, const Values& w) {
  return any.visit([&]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) {
    return owned(without_gil([&] {
      return with_constant<0, n - 1>(k, "the degree k", [&](auto degree) {
        return values_of(trace(of->boundary, PrimalForm<n, degree()>(*of->body.complex, copied(w))));
      });
    }));
  });
}

auto term_of(const AnyBoundary& any, int j, const Values& b) {
  return any.visit([&]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) {
    return owned(without_gil([&] {
      return with_constant<0, n - 1>(j, "the degree j", [&](auto degree) {
        const DualForm<n - 1, degree()> on_boundary(of->boundary.complex, copied(b));
        return values_of(boundary_term(*of->body.complex, of->boundary, on_boundary));
      });
    }));
  });
}

/// d of a dual j-form with its trace.
auto closed_d(const AnyBoundary& any, int j, const Values& w, const Values& b) {
  return any.visit([&]<int n>(const std::shared_ptr<const BoundaryOf<n>>& of) {
    return owned(without_gil([&] {
      return with_constant<0, n - 1>(j, "the degree j", [&](auto degree) {
        const DualForm<n - 1, degree()> on_boundary(of->boundary.complex, copied(b));
        return values_of(d(DualForm<n, degree()>(*of->body.complex, copied(w)), of->boundary, on_boundary));
      });
    }));
  });
}

}  // namespace

void bind_forms(ComplexClass& complex, BoundaryClass& boundary) {
  using nb::arg;
  complex.def("apply_wedge", &wedge_of, arg("p"), arg("a").noconvert(), arg("q"), arg("b").noconvert(),
              arg("y").noconvert());
  complex.def("function_wedge", &function_wedge, arg("f_dual"), arg("f").noconvert(), arg("a_dual"), arg("q"),
              arg("a").noconvert());
  complex.def("polygon_wedge", &polygon_wedge, arg("a").noconvert(), arg("b").noconvert());
  boundary.def("trace", &trace_of, arg("k"), arg("w").noconvert());
  boundary.def("boundary_term", &term_of, arg("j"), arg("b").noconvert());
  boundary.def("d", &closed_d, arg("j"), arg("w").noconvert(), arg("b").noconvert());
}

}  // namespace derham::python
