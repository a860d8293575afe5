#include "any_star.hpp"
#include "rooms.hpp"

#include <nanobind/stl/string.h>

#include <string>

namespace derham::python {
namespace {

StarKind kind_of(const std::string& name, const std::optional<Values>& weights) {
  if (name == "circumcentric") return Circumcentric{};
  if (name == "power") return PowerCircumcentric{weights ? copied(*weights) : std::vector<double>()};
  if (name == "barycentric") return Barycentric{};
  if (name == "lumped") return Lumped{};
  throw InputError("there is no diagonal star '" + name + "'; expected circumcentric, power, barycentric or lumped");
}

void construct(AnyStar* self, const AnyComplex& any, const std::string& kind, const std::optional<Values>& weights,
               const MaterialArgument& material) {
  without_gil([&] { new (self) AnyStar(any, kind_of(kind, weights), material_of(material)); });
}

auto diagonal(const AnyStar& any, int k) {
  return any.visit([k](const auto& star) { return view(star->star.diagonal(k), star); });
}

auto inverse_diagonal(const AnyStar& any, int k) {
  return any.visit(
      [k](const auto& star) { return owned(without_gil([&] { return star->star.inverse_diagonal(k); })); });
}

}  // namespace

void bind_hodge(StarClass& star) {
  using nb::arg;
  star.def("__init__", &construct, arg("complex"), arg("kind"), arg("weights").none(), arg("material").none());
  star.def("diagonal", &diagonal, arg("k"));
  star.def("inverse_diagonal", &inverse_diagonal, arg("k"));
}

}  // namespace derham::python
