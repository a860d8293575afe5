// The Laplacian here is that of functions.
#include "derham/hodge/laplacian.hpp"

namespace derham {

auto result(const HodgeStar<3>& star) {
#ifndef CONTROL
  return laplacian(star, Form<3, 1>(star.complex()));
#else
  return laplacian(star, Form<3, 0>(star.complex()));
#endif
}

}  // namespace derham
