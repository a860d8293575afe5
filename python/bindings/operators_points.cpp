#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/operators/point_locator.hpp"
#include "derham/operators/whitney_map.hpp"

#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

// Where points are, and forms there.
namespace derham::python {
namespace {

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

}  // namespace

void bind_operator_points(nb::module_& module, ComplexClass& complex) {
  using nb::arg;
  nb::class_<AnyLocator>(module, "Locator")
      .def(nb::init<const AnyComplex&>(), arg("complex"), nb::call_guard<Unlocked>())
      .def("locate", &AnyLocator::locate, arg("points").noconvert(), arg("nearest"));
  complex.def("interpolate", &interpolate, arg("k"), arg("w").noconvert(), arg("simplex").noconvert(),
              arg("barycentric").noconvert());
}

}  // namespace derham::python
