// The star of a 1-form in dimension 3 is a dual 2-form.
#include "derham/hodge/hodge_star.hpp"

namespace derham {

auto result(const HodgeStar<3>& star) {
#ifndef CONTROL
  return Form<3, 1, Side::dual>(star(Form<3, 1>(star.complex())));
#else
  return Form<3, 2, Side::dual>(star(Form<3, 1>(star.complex())));
#endif
}

}  // namespace derham
