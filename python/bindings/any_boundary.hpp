#pragma once

#include "any_complex.hpp"

#include "derham/boundary/boundary_complex.hpp"

#include <memory>
#include <variant>

namespace derham::python {

/// The boundary of a complex with what it belongs to.
template <int n>
struct BoundaryOf {
  Body<n> body;
  BoundaryComplex<n> boundary;
  explicit BoundaryOf(Body<n> of) : body(std::move(of)), boundary(boundary_complex(*body.complex)) {}
};

/// The boundary of a complex of a dimension known at run time.
/// Throws   InputError for n = 0; TopologyError if the complex is not pure
class AnyBoundary {
 public:
  explicit AnyBoundary(const AnyComplex& any)
      : boundary_(any.visit<1>(
            []<int n>(const Body<n>& body) { return Boundaries(std::make_shared<const BoundaryOf<n>>(body)); })) {}

  /// action(boundary), a shared_ptr<const BoundaryOf<n>>, with n up to high.
  /// Throws   InputError in higher dimensions
  template <int high = max_dimension, class Action>
  auto visit(Action&& action) const {
    return with_constant<1, high>(static_cast<int>(boundary_.index()) + 1, "the dimension of the complex",
                                  [&](auto n) { return action(std::get<Pointer<n()>>(boundary_)); });
  }

 private:
  template <int n>
  using Pointer = std::shared_ptr<const BoundaryOf<n>>;
  using Boundaries = std::variant<Pointer<1>, Pointer<2>, Pointer<3>, Pointer<4>, Pointer<5>, Pointer<6>>;
  Boundaries boundary_;
};

}  // namespace derham::python
