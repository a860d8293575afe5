#pragma once

#include "dispatch.hpp"

#include "derham/complex/simplicial_complex.hpp"
#include "derham/geometry/geometry.hpp"
#include "derham/geometry/mesh_data.hpp"

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>

namespace derham::python {

/// The dimensions that the metric part of the library is instantiated for.
inline constexpr int max_metric_dimension = 4;

/// A complex of dimension n and, if it has one, its metric.
template <int n>
struct Body {
  std::shared_ptr<const SimplicialComplex<n>> complex;
  std::conditional_t<n <= max_metric_dimension, std::shared_ptr<const Geometry<n>>, std::monostate> geometry;
};

/// A complex whose dimension is known at run time, with the metric and the rest of the mesh that it was made from.
class AnyComplex {
 public:
  using Bodies = std::variant<Body<0>, Body<1>, Body<2>, Body<3>, Body<4>, Body<5>, Body<6>>;

  /// The complex of the rows of a mesh, oriented by volume where it fills space. It keeps what the lists of the complex and
  /// the metric do not hold: parts, fields, listed simplices of lower dimension, tags.
  /// signs    (|K_n|,) or empty: every component is oriented as these are
  /// Throws   what SimplicialComplex and Geometry throw
  explicit AnyComplex(MeshData mesh, std::span<const Sign> signs = {});

  /// A complex that there is already, with the metric and the rest of its mesh.
  AnyComplex(Bodies complex, MeshData mesh);

  /// A complex that another object of the library owns or made.
  template <int n>
  explicit AnyComplex(Body<n> body) : body_(std::move(body)) {}

  [[nodiscard]] int dimension() const noexcept { return static_cast<int>(body_.index()); }
  [[nodiscard]] const MeshData& rest() const noexcept { return rest_; }
  [[nodiscard]] MeshData& rest() noexcept { return rest_; }

  /// The whole mesh again: rows in the order of the top simplices, each positively oriented.
  [[nodiscard]] MeshData mesh() const;

  template <int n>
  [[nodiscard]] const Body<n>& body() const {
    return std::get<Body<n>>(body_);
  }

  /// action(body) with the body of this dimension, one of low to high.
  /// Throws   InputError in other dimensions
  template <int low = 0, int high = max_dimension, class Action>
  auto visit(Action&& action) const {
    return with_constant<low, high>(dimension(), "the dimension of the complex",
                                    [&](auto n) { return action(this->template body<n()>()); });
  }

  /// action(K).
  template <int low = 0, int high = max_dimension, class Action>
  auto with_complex(Action&& action) const {
    return visit<low, high>([&](const auto& body) { return action(*body.complex); });
  }

  /// action(body) for something that needs a metric.
  /// Throws   as `visit`; TopologyError if the complex is not pure; GeometryError if it has no metric
  template <int low = 0, class Action>
  auto with_metric(Action&& action) const {
    return visit<low, max_metric_dimension>([&](const auto& body) {
      if (!body.geometry) refuse_metric(body.complex->is_pure());
      return action(body);
    });
  }

 private:
  [[noreturn]] static void refuse_metric(bool pure);
  void drop_what_the_body_holds();

  Bodies body_;
  MeshData rest_;
};

}  // namespace derham::python
