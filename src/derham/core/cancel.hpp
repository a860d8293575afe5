#pragma once

#include "derham/core/error.hpp"

namespace derham {

/// Work was stopped because somebody asked for it; see `set_cancel_check`.
class Cancelled : public Error {
 public:
  using Error::Error;
  [[nodiscard]] const char* kind() const noexcept override { return "cancelled"; }
};

/// Called about ten times a second while the library works, on the thread that called the library only. It cancels the work by
/// throwing: a `Cancelled`, or whatever should reach the caller. What was being made is then gone, what existed is unchanged,
/// except that vectors to be written to may hold some of the results. Other threads end their blocks before the caller sees it.
using CancelCheck = void (*)();

/// Sets the check for the whole process; nullptr, as at first, for none.
///
///     std::atomic<bool> stop = false;  // at namespace scope; set by a signal handler or another thread
///     set_cancel_check([] { if (stop) throw Cancelled("stopped"); });
void set_cancel_check(CancelCheck check) noexcept;

/// Calls the check if there is one and its last call on this thread is 0.1 s ago. Parallel loops do it for every block; long
/// loops of another kind do it themselves, about every 10 µs or rarer. Cost: that of reading a clock, and of nothing without a
/// check.
void poll_cancel();

namespace detail {
/// While it lives, this thread works for another one, which does the polling.
class WorkingForAnother {
 public:
  explicit WorkingForAnother(bool does) noexcept;
  ~WorkingForAnother();
  WorkingForAnother(const WorkingForAnother&) = delete;
  WorkingForAnother& operator=(const WorkingForAnother&) = delete;

 private:
  bool before_;
};
}  // namespace detail

}  // namespace derham
