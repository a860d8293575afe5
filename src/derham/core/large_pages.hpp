#pragma once

#include <cstddef>
#include <vector>

namespace derham {

/// Asks the system to back new memory, `bytes` at `begin`, with large pages where it can: most of the time of filling a
/// large array goes into giving it one page after the other. Changes no content; at most a hint.
void prefer_large_pages(void* begin, std::size_t bytes) noexcept;

/// As values.reserve(count), in large pages.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  if (count <= values.capacity()) return;
  values.reserve(count);
  prefer_large_pages(values.data(), count * sizeof(T));
}

}  // namespace derham
