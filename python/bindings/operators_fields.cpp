#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/geometry/top_volumes.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/quadrature.hpp"
#include "derham/operators/sharp_and_flat.hpp"

#include <nanobind/stl/string.h>

#include <string>
#include <utility>
#include <vector>

// Between smooth and discrete forms: integration, sharps and flats.
namespace derham::python {
namespace {

/// (|K_k|, nodes, m)
auto nodes(const AnyComplex& any, int k, int order) {
  return any.with_metric([&]<int n>(const Body<n>& body) {
    auto points = without_gil([&] {
      const DeRhamMap<n> R(*body.complex, *body.geometry, order);
      return with_constant<0, n>(k, "the degree k", [&](auto degree) { return R.template nodes<degree()>(); });
    });
    const auto simplices = static_cast<std::size_t>(body.complex->size(k));
    const auto m = static_cast<std::size_t>(body.geometry->ambient_dimension());
    const std::size_t count = simplices > 0 ? points.size() / simplices / m : 0;
    return owned(std::move(points), {simplices, count, m});
  });
}

auto integrate(const AnyComplex& any, int k, int order, const Values& values) {
  return any.with_metric([&]<int n>(const Body<n>& body) {
    return owned(without_gil([&] {
      const DeRhamMap<n> R(*body.complex, *body.geometry, order);
      return with_constant<0, n>(k, "the degree k", [&](auto degree) {
        return values_of(R.template components_at_nodes<degree()>(span_of(values)));
      });
    }));
  });
}

/// The integrals of f times the volume form over the top simplices, f given at the nodes.
auto integrate_density(const AnyComplex& any, int order, const Values& values) {
  return any.with_metric([&]<int n>(const Body<n>& body) {
    return owned(without_gil([&] {
      if (!body.complex->is_orientable())
        throw TopologyError("a density is a form of top degree only on an orientable complex; this one is not");
      const auto rule = simplex_rule<n>(order);
      std::vector<double> result = top_volumes(*body.complex, *body.geometry).volume;
      const double* next = values.data();
      for (double& integral : result) {
        double mean = 0;
        for (const double weight : rule.weights) mean += weight * *next++;
        integral *= mean;
      }
      return result;
    }));
  });
}

auto sharp(const AnyComplex& any, const std::string& kind, const Values& w) {
  return any.with_metric<1>([&]<int n>(const Body<n>& body) {
    const Geometry<n>& geometry = *body.geometry;
    auto vectors = without_gil([&] {
      const PrimalForm<n, 1> form(*body.complex, copied(w));
      return kind == "pp"   ? pp_sharp(geometry, form)
             : kind == "pd" ? pd_sharp(geometry, form)
                            : whitney_sharp(geometry, form);
    });
    const auto d = static_cast<std::size_t>(geometry.coordinate_dimension());
    const std::size_t count = vectors.size() / d;
    return owned(std::move(vectors), {count, d});
  });
}

auto flat(const AnyComplex& any, const std::string& kind, const Values& X) {
  return any.with_metric<1>([&](const auto& body) {
    return owned(without_gil([&] {
      const auto& K = *body.complex;
      if (kind == "dpd") return values_of(dpd_flat(K, *body.geometry, span_of(X)));
      return values_of(kind == "dpp" ? dpp_flat(K, *body.geometry, span_of(X))
                                     : ppp_flat(K, *body.geometry, span_of(X)));
    }));
  });
}

}  // namespace

void bind_operator_fields(ComplexClass& complex) {
  using nb::arg;
  complex.def("nodes", &nodes, arg("k"), arg("order"));
  complex.def("integrate", &integrate, arg("k"), arg("order"), arg("values").noconvert());
  complex.def("integrate_density", &integrate_density, arg("order"), arg("values").noconvert());
  complex.def("sharp", &sharp, arg("kind"), arg("w").noconvert());
  complex.def("flat", &flat, arg("kind"), arg("X").noconvert());
}

}  // namespace derham::python
