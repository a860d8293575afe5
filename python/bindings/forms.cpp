#include "arrays.hpp"
#include "rooms.hpp"

#include "derham/forms/wedge.hpp"

namespace derham::python {
namespace {

void wedge_of(const AnyComplex& any, int p, const Values& a, int q, const Values& b, const Output& y) {
  without_gil(
      [&] { any.with_complex([&](const auto& K) { apply_wedge(K, p, span_of(a), q, span_of(b), span_of(y)); }); });
}

}  // namespace

void bind_forms(ComplexClass& complex) {
  using nb::arg;
  complex.def("apply_wedge", &wedge_of, arg("p"), arg("a").noconvert(), arg("q"), arg("b").noconvert(),
              arg("y").noconvert());
}

}  // namespace derham::python
