#pragma once

#include "derham/core/cancel.hpp"
#include "derham/core/parallel.hpp"
#include "derham/core/types.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

namespace derham {

/// Three steps for each of `count` blocks, when a block must know the sum of what came before it:
///
///   prepare(scratch, block)   in parallel
///   number(scratch, block)    one block at a time, in their order
///   finish(scratch, block)    in parallel
///
/// Each thread takes the next block and keeps one scratch object, made by make_scratch(). The block with the smallest
/// number never waits, so there is no deadlock however few threads there are. The first exception reaches the caller.
template <class MakeScratch, class Prepare, class Number, class Finish>
void ordered_blocks(Offset count, MakeScratch&& make_scratch, Prepare&& prepare, Number&& number, Finish&& finish) {
  std::atomic<Offset> next{0}, turn{0};
  std::atomic<bool> failed{false};
  const auto work = [&] {
    try {
      auto scratch = make_scratch();
      for (Offset block = next++; block < count; block = next++) {
        poll_cancel();
        prepare(scratch, block);
        while (turn.load(std::memory_order_acquire) != block) {
          if (failed.load(std::memory_order_relaxed)) return;
          std::this_thread::yield();
        }
        number(scratch, block);
        turn.store(block + 1, std::memory_order_release);
        finish(scratch, block);
      }
    } catch (...) {
      failed = true;
      next = count;
      throw;
    }
  };
  parallel_blocks(std::min<Offset>(thread_count(), count), 1, [&](Offset, Offset) { work(); });
}

}  // namespace derham
