#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <thread>

// Work without the interpreter's lock, so that other Python threads may run.
namespace derham::python {

namespace nb = nanobind;

/// While there is one, this thread has given up the lock.
///
/// Until Python 3.14 a daemon thread that wants the lock back when the interpreter ends is unwound by pthread_exit. Our callers,
/// who may not throw, would turn that into an abort; so the thread stays here until the process ends, as from Python 3.14 on.
class Unlocked {
 public:
  Unlocked() = default;
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    try {
      PyEval_RestoreThread(state_);
    } catch (...) {
      while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    }
  }

 private:
  PyThreadState* state_ = PyEval_SaveThread();
};

/// The result of `work`, done without the lock.
template <class Work>
auto without_gil(Work&& work) {
  const Unlocked unlocked;
  return work();
}

}  // namespace derham::python
