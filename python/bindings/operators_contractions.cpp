#include "any_star.hpp"
#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/core/parallel.hpp"
#include "derham/operators/interior_product.hpp"

#include <functional>
#include <span>
#include <vector>

// Interior products: with a smooth vector field, and by the star and a wedge product.
namespace derham::python {
namespace {

using Field = std::function<std::span<const double>(std::span<const double>)>;
using Function = nb::typed<nb::callable, nb::object(nb::object)>;

/// Calls `work` without the interpreter's lock, and so that all loops within run on one thread, in their order.
template <class Work>
void in_order(Work&& work) {
  without_gil([&] {
    parallel_blocks(2, 1, [&](Offset begin, Offset) {
      if (begin == 0) work();
    });
  });
}

/// operation(X) for a field that Python evaluates at all points at once: the operation runs twice, first with a field that
/// notes where it is asked for, then with the values in the same order. What it asks may not depend on what it gets.
template <class Operation>
void with_all_values(const Function& X, std::size_t m, Operation&& operation) {
  std::vector<double> points;
  const std::vector<double> nothing(m);
  const Field note = [&](std::span<const double> x) {
    points.insert(points.end(), x.begin(), x.end());
    return std::span<const double>(nothing);
  };
  in_order([&] { operation(note); });
  const std::size_t count = points.size() / m;
  const auto values = nb::cast<Values>(X(owned(std::move(points), {count, m})));
  const double* next = values.data();
  const Field give = [&](std::span<const double>) { return std::span<const double>(std::exchange(next, next + m), m); };
  in_order([&] { operation(give); });
}

template <int n>
std::vector<double> contraction(const Body<n>& body, int k, const Values& w, const Field& X, bool upwind, int order) {
  const InteriorProduct<n, Field> i_X(*body.complex, *body.geometry, X, upwind ? Trace::upwind : Trace::mean, order);
  return with_constant<1, n>(k, "the degree k", [&](auto degree) {
    return values_of(i_X(PrimalForm<n, degree()>(*body.complex, copied(w))));
  });
}

Field constant(const Values& X) {
  return [value = span_of(X)](std::span<const double>) { return value; };
}

auto contract_constant(const AnyComplex& any, int k, const Values& w, const Values& X, bool upwind, int order) {
  return any.with_metric<1>([&](const auto& body) {
    return owned(without_gil([&] { return contraction(body, k, w, constant(X), upwind, order); }));
  });
}

auto contract(const AnyComplex& any, int k, const Values& w, const Function& X, bool upwind, int order) {
  return any.with_metric<1>([&](const auto& body) {
    std::vector<double> result;
    with_all_values(X, static_cast<std::size_t>(body.geometry->ambient_dimension()),
                    [&](const Field& field) { result = contraction(body, k, w, field, upwind, order); });
    return owned(std::move(result));
  });
}

template <int n>
double bound(const Body<n>& body, const Field& X, int order) {
  return InteriorProduct<n, Field>(*body.complex, *body.geometry, X, Trace::upwind, order).cfl_bound();
}

double bound_constant(const AnyComplex& any, const Values& X, int order) {
  return any.with_metric<1>(
      [&](const auto& body) { return without_gil([&] { return bound(body, constant(X), order); }); });
}

double bound_of(const AnyComplex& any, const Function& X, int order) {
  return any.with_metric<1>([&](const auto& body) {
    double result = 0;
    with_all_values(X, static_cast<std::size_t>(body.geometry->ambient_dimension()),
                    [&](const Field& field) { result = bound(body, field, order); });
    return result;
  });
}

/// By the star and a wedge product with X♭: of dual forms, of primal n-forms, and of primal 1-forms in the plane.
template <int n, int k>
std::vector<double> algebraic(const HodgeStar<n>& star, bool dual, const Values& X_flat, const Values& w) {
  const SimplicialComplex<n>& K = star.complex();
  if (dual) return values_of(interior_product(star, PrimalForm<n, 1>(K, copied(X_flat)), DualForm<n, k>(K, copied(w))));
  if constexpr (k == n || (n == 2 && k == 1))
    return values_of(interior_product(star, DualForm<n, 1>(K, copied(X_flat)), PrimalForm<n, k>(K, copied(w))));
  throw InputError(text("there is no algebraic interior product of primal ", k, "-forms in dimension ", n,
                        "; there are those of n-forms and of dual forms"));
}

auto contract_algebraically(const AnyStar& any, int k, bool dual, const Values& X_flat, const Values& w) {
  return any.visit<1>([&]<int n>(const std::shared_ptr<const StarOf<n>>& of) {
    return owned(without_gil([&] {
      return with_constant<1, n>(k, "the degree k",
                                 [&](auto degree) { return algebraic<n, degree()>(of->star, dual, X_flat, w); });
    }));
  });
}

}  // namespace

void bind_operator_contractions(ComplexClass& complex, StarClass& star) {
  using nb::arg;
  complex.def("contract", &contract_constant, arg("k"), arg("w").noconvert(), arg("X").noconvert(), arg("upwind"),
              arg("order"));
  complex.def("contract", &contract, arg("k"), arg("w").noconvert(), arg("X"), arg("upwind"), arg("order"));
  complex.def("cfl_bound", &bound_constant, arg("X").noconvert(), arg("order"));
  complex.def("cfl_bound", &bound_of, arg("X"), arg("order"));
  star.def("contract", &contract_algebraically, arg("k"), arg("dual"), arg("X_flat").noconvert(), arg("w").noconvert());
}

}  // namespace derham::python
