#pragma once

#include <mutex>
#include <optional>

namespace derham {

/// A value that is made when it is first asked for, and kept. Any number of threads may ask.
template <class T>
class Kept {
 public:
  /// The value, from make() if there is none yet. If that throws, there is none, and the next who asks makes it: not so with
  /// std::call_once, where pthread_once may then wait for ever.
  template <class Make>
  const T& get(Make&& make) const {
    const std::scoped_lock lock(mutex_);
    if (!value_) value_.emplace(make());
    return *value_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::optional<T> value_;
};

}  // namespace derham
