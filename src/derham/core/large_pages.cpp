#include "derham/core/large_pages.hpp"

#include <cstdint>

#include <sys/mman.h>

namespace derham {

void prefer_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
  // Only pages that lie within the memory as a whole, so that it does not become more.
  constexpr std::size_t page = std::size_t{1} << 21;
  const std::size_t skipped = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  if (bytes < skipped + page) return;
  (void)::madvise(static_cast<char*>(begin) + skipped, (bytes - skipped) / page * page, MADV_HUGEPAGE);
#endif
}

}  // namespace derham
