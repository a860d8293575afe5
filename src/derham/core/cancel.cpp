#include "derham/core/cancel.hpp"

#include <atomic>
#include <chrono>
#include <utility>

namespace derham {
namespace {

std::atomic<CancelCheck> the_check{nullptr};
thread_local bool working_for_another = false;

}  // namespace

void set_cancel_check(CancelCheck check) noexcept { the_check = check; }

void poll_cancel() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds interval{100};
  const CancelCheck check = the_check.load(std::memory_order_relaxed);
  if (check == nullptr || working_for_another) return;
  thread_local Clock::time_point last{};
  const Clock::time_point now = Clock::now();
  if (now - last < interval) return;
  last = now;
  check();
}

namespace detail {
WorkingForAnother::WorkingForAnother(bool does) noexcept
    : before_(std::exchange(working_for_another, working_for_another || does)) {}
WorkingForAnother::~WorkingForAnother() { working_for_another = before_; }
}  // namespace detail

}  // namespace derham
