#pragma once

#include "derham/core/types.hpp"

#include <algorithm>
#include <type_traits>

namespace derham {

/// How many threads parallel loops may use; the hardware's number unless set.
[[nodiscard]] int thread_count();

/// Limits parallel loops to `count` >= 1 threads. Results never depend on it. Throws InputError when count < 1.
void set_thread_count(int count);

namespace detail {
using BlockFunction = void (*)(void* context, Offset block);
void run_blocks(Offset blocks, BlockFunction function, void* context);
}  // namespace detail

/// Calls `body(begin, end)` on consecutive pieces of [0, size) of `grain` items each (the last may be shorter), in any
/// order and on several threads. The pieces do not depend on the number of threads, so a body that writes only what
/// belongs to its piece gives the same bits always. The first exception thrown by a body reaches the caller.
/// A loop inside the body of another runs on the thread of that body.
template <class Body>
void parallel_blocks(Offset size, Offset grain, Body&& body) {
  if (size <= 0) return;
  struct Context {
    std::remove_reference_t<Body>* body;
    Offset size, grain;
  } context{&body, size, grain};
  detail::run_blocks((size + grain - 1) / grain,
                     [](void* raw, Offset block) {
                       const auto& c = *static_cast<Context*>(raw);
                       (*c.body)(block* c.grain, std::min(c.size, (block + 1) * c.grain));
                     },
                     &context);
}

}  // namespace derham
