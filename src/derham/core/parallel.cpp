#include "derham/core/parallel.hpp"

#include "derham/core/cancel.hpp"
#include "derham/core/error.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#ifdef DERHAM_THREADS_TBB
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace derham {
namespace {

std::atomic<int> chosen_threads{0};
thread_local bool inside_loop = false;  // this thread runs a block: loops within it run on this thread alone

/// Whether `count` more threads can be started at all: a limit on memory or processes would otherwise end the program
/// from within the thread library. Asked once.
bool can_start_threads(Offset count) {
  static const bool possible = [count] {
    try {
      std::vector<std::jthread> probes;
      for (Offset i = 0; i < count; ++i) probes.emplace_back([] { std::this_thread::yield(); });
      return true;
    } catch (const std::system_error&) {
      return false;
    }
  }();
  return possible;
}

#if defined(DERHAM_THREADS_TBB)
/// The arena of this thread, kept for its next loop: a new one takes a hundred times as long as a short loop, and TBB 2021.8
/// does not free all of it.
tbb::task_arena& arena_of_this_thread() {
  thread_local std::optional<tbb::task_arena> arena;
  // Never more than TBB's own workers: it would print that it ignores the others.
  const int count = std::min(thread_count(), tbb::info::default_concurrency());
  if (!arena || arena->max_concurrency() != count) arena.emplace(count);
  return *arena;
}
#endif

/// Calls one block of a parallel loop that `owner` began.
void run_block(detail::BlockFunction function, void* context, Offset block, std::thread::id owner) {
  struct Inside {
    bool before = std::exchange(inside_loop, true);
    ~Inside() { inside_loop = before; }
  } inside;
  const detail::WorkingForAnother working(std::this_thread::get_id() != owner);
  poll_cancel();
  function(context, block);
}

}  // namespace

int thread_count() {
  const int chosen = chosen_threads.load();
  if (chosen > 0) return chosen;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void set_thread_count(int count) {
  if (count < 1) throw InputError("thread count is " + std::to_string(count) + "; it must be at least 1");
  chosen_threads = count;
}

namespace detail {

void run_blocks(Offset blocks, BlockFunction function, void* context) {
  const Offset threads = std::min<Offset>(thread_count(), blocks);
  if (threads <= 1 || inside_loop || !can_start_threads(threads - 1)) {
    for (Offset block = 0; block < blocks; ++block) {
      poll_cancel();
      function(context, block);
    }
    return;
  }
  const std::thread::id owner = std::this_thread::get_id();
#if defined(DERHAM_THREADS_TBB)
  arena_of_this_thread().execute([&] {
    tbb::parallel_for(
        Offset{0}, blocks, [&](Offset block) { run_block(function, context, block, owner); },
        tbb::simple_partitioner());
  });
#elif defined(DERHAM_THREADS_STD)
  std::atomic<Offset> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (Offset block = next++; block < blocks; block = next++) run_block(function, context, block, owner);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = blocks;
    }
  };
  std::vector<std::jthread> workers;
  for (Offset i = 1; i < threads; ++i) workers.emplace_back(work);
  work();
  workers.clear();
  if (failure) std::rethrow_exception(failure);
#else
  for (Offset block = 0; block < blocks; ++block) run_block(function, context, block, owner);
#endif
}

}  // namespace detail
}  // namespace derham
