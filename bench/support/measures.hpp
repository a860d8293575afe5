#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include <ctime>

namespace derham::bench {

/// Seconds of processor that this program has used, all its threads and the kernel on its behalf: other programs on the
/// machine hardly change it.
inline double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The memory that the program takes, above what it held when the object was made. Linux counts it in pages that were
/// touched.
class PeakMemory {
 public:
  PeakMemory() {
    std::ofstream("/proc/self/clear_refs") << "5";
    before_ = status("VmRSS:");
  }
  /// The largest since then.
  [[nodiscard]] std::int64_t bytes() const { return status("VmHWM:") - before_; }
  /// Now.
  [[nodiscard]] std::int64_t held() const { return status("VmRSS:") - before_; }

 private:
  static std::int64_t status(std::string_view key) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with(key)) return 1024 * std::stoll(line.substr(key.size()));
    return 0;
  }
  std::int64_t before_ = 0;
};

}  // namespace derham::bench
