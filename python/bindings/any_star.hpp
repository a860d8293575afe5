#pragma once

#include "any_complex.hpp"
#include "arrays.hpp"

#include "derham/geometry/material.hpp"
#include "derham/hodge/hodge_star.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>

#include <memory>
#include <optional>
#include <variant>

namespace derham::python {

/// A material as Python gives it: (numbers (rows,) or tensors (rows, m, m), the row of every top simplex or None), or None.
using MaterialArgument = std::optional<std::pair<Values, std::optional<Indices>>>;

[[nodiscard]] inline Material material_of(const MaterialArgument& given) {
  if (!given) return {};
  const auto& [values, rows] = *given;
  Material material{copied(values), values.ndim() == 3 ? static_cast<int>(values.shape(2)) : 0, {}};
  if (rows) material.row_of = copied(*rows);
  return material;
}

/// A diagonal Hodge star with what it refers to.
template <int n>
struct StarOf {
  Body<n> body;
  HodgeStar<n> star;

  StarOf(Body<n> complex, StarKind kind, const Material& material)
      : body(std::move(complex)), star(*body.complex, *body.geometry, std::move(kind), material) {}
};

/// A diagonal Hodge star of a dimension known at run time.
class AnyStar {
 public:
  AnyStar(const AnyComplex& any, StarKind kind, const Material& material)
      : star_(any.with_metric([&]<int n>(const Body<n>& body) {
          return Stars(std::make_shared<const StarOf<n>>(body, std::move(kind), material));
        })) {}

  /// action(star), a shared_ptr<const StarOf<n>>, with n from low.
  /// Throws   InputError in lower dimensions
  template <int low = 0, class Action>
  auto visit(Action&& action) const {
    return with_constant<low, max_metric_dimension>(
        static_cast<int>(star_.index()), "the dimension of the complex",
        [&](auto n) { return action(std::get<std::shared_ptr<const StarOf<n()>>>(star_)); });
  }

 private:
  template <int n>
  using Pointer = std::shared_ptr<const StarOf<n>>;
  using Stars = std::variant<Pointer<0>, Pointer<1>, Pointer<2>, Pointer<3>, Pointer<4>>;
  Stars star_;
};

}  // namespace derham::python
