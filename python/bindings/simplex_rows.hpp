#pragma once

#include "arrays.hpp"

#include "derham/complex/simplex_list.hpp"

#include <cstddef>

namespace derham::python {

/// Rows of several lengths: `ends` says where in `vertices` each ends.
[[nodiscard]] inline SimplexList rows_of(const Indices& vertices, const Indices& ends) {
  SimplexList list;
  std::size_t begin = 0;
  for (const Index end : span_of(ends)) {
    list.push_back(span_of(vertices).subspan(begin, static_cast<std::size_t>(end) - begin));
    begin = static_cast<std::size_t>(end);
  }
  return list;
}

}  // namespace derham::python
