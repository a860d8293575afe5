#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace derham {

/// Scratch objects shared by the pieces of a parallel loop: as many are made as pieces run at the same time.
template <class T>
class ScratchPool {
 public:
  explicit ScratchPool(std::function<T()> make) : make_(std::move(make)) {}

  /// An object that returns to the pool when the handle dies.
  [[nodiscard]] auto take() {
    std::unique_ptr<T> object;
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        object = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (!object) {
      object = std::make_unique<T>(make_());
      const std::lock_guard lock(mutex_);
      free_.reserve(++made_);  // so that returning an object cannot throw
    }
    const auto put_back = [this](T* raw) {
      std::unique_ptr<T> owned(raw);
      const std::lock_guard lock(mutex_);
      free_.push_back(std::move(owned));
    };
    return std::unique_ptr<T, decltype(put_back)>(object.release(), put_back);
  }

 private:
  std::function<T()> make_;
  std::mutex mutex_;
  std::size_t made_ = 0;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace derham
