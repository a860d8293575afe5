#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/geometry/top_volumes.hpp"
#include "derham/operators/de_rham_map.hpp"
#include "derham/operators/point_locator.hpp"
#include "derham/operators/quadrature.hpp"
#include "derham/operators/sharp_and_flat.hpp"
#include "derham/operators/whitney_map.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <limits>
#include <string>
#include <tuple>

// Between smooth and discrete forms: integration, interpolation, sharps and flats.
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

/// The top simplices of points, -1 outside, barycentric coordinates there, and how far away from them the points are.
struct Places {
  std::vector<Index> simplex;
  std::vector<double> barycentric, distance;
};

template <int n>
Places places_of(const PointLocator<n>& locator, std::span<const double> points, bool nearest) {
  Places places;
  const auto add = [&places](const BarycentricPoint<n>& point, double distance) {
    places.simplex.push_back(point.simplex);
    places.barycentric.insert(places.barycentric.end(), point.barycentric.begin(), point.barycentric.end());
    places.distance.push_back(distance);
  };
  if (nearest)
    for (const NearestPoint<n>& found : locator.nearest_all(points)) add(found.point, found.distance);
  else
    for (const BarycentricPoint<n>& found : locator.locate_all(points))
      add(found, found.simplex < 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0);
  return places;
}

template <int n>
struct LocatorOf {
  Body<n> body;
  PointLocator<n> locator;
  explicit LocatorOf(Body<n> of) : body(std::move(of)), locator(*body.complex, *body.geometry) {}
};

/// A PointLocator with what it refers to.
class AnyLocator {
 public:
  explicit AnyLocator(const AnyComplex& any)
      : locator_(any.with_metric<1>(
            []<int n>(const Body<n>& body) { return Locators(std::make_shared<const LocatorOf<n>>(body)); })) {}

  /// Where points are, or their nearest points: simplex (count,), barycentric (count, n+1), distance (count,).
  [[nodiscard]] auto locate(const Values& points, bool nearest) const {
    return std::visit(
        [&]<int n>(const std::shared_ptr<const LocatorOf<n>>& of) {
          Places places = without_gil([&] { return places_of<n>(of->locator, span_of(points), nearest); });
          const std::size_t count = places.simplex.size();
          return std::tuple(owned(std::move(places.simplex)), owned(std::move(places.barycentric), {count, n + 1}),
                            owned(std::move(places.distance)));
        },
        locator_);
  }

 private:
  template <int n>
  using Pointer = std::shared_ptr<const LocatorOf<n>>;
  using Locators = std::variant<Pointer<1>, Pointer<2>, Pointer<3>, Pointer<4>>;
  Locators locator_;
};

/// (points, C(d, k)), NaN where there is no simplex.
auto interpolate(const AnyComplex& any, int k, const Values& w, const Indices& simplex, const Values& barycentric) {
  return any.with_metric([&]<int n>(const Body<n>& body) {
    const std::size_t count = simplex.size();
    auto values = without_gil([&] {
      std::vector<BarycentricPoint<n>> points(count);
      for (std::size_t i = 0; i < count; ++i) {
        points[i].simplex = span_of(simplex)[i];
        std::ranges::copy(span_of(barycentric).subspan(i * (n + 1), n + 1), points[i].barycentric.begin());
      }
      const WhitneyMap<n> W(*body.complex, *body.geometry);
      return with_constant<0, n>(k, "the degree k", [&](auto degree) {
        return W.at(PrimalForm<n, degree()>(*body.complex, copied(w)), std::span<const BarycentricPoint<n>>(points));
      });
    });
    return owned(std::move(values),
                 {count, static_cast<std::size_t>(binomial(body.geometry->coordinate_dimension(), k))});
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

void bind_operator_fields(nb::module_& module, ComplexClass& complex) {
  using nb::arg;
  nb::class_<AnyLocator>(module, "Locator")
      .def(nb::init<const AnyComplex&>(), arg("complex"), nb::call_guard<Unlocked>())
      .def("locate", &AnyLocator::locate, arg("points").noconvert(), arg("nearest"));
  complex.def("nodes", &nodes, arg("k"), arg("order"));
  complex.def("integrate", &integrate, arg("k"), arg("order"), arg("values").noconvert());
  complex.def("integrate_density", &integrate_density, arg("order"), arg("values").noconvert());
  complex.def("interpolate", &interpolate, arg("k"), arg("w").noconvert(), arg("simplex").noconvert(),
              arg("barycentric").noconvert());
  complex.def("sharp", &sharp, arg("kind"), arg("w").noconvert());
  complex.def("flat", &flat, arg("kind"), arg("X").noconvert());
}

}  // namespace derham::python
