#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace derham {

/// The whole content of a file, in memory.
class FileBytes {
 public:
  /// Reads `path`: a regular file, a pipe or device, or standard input when it is "-".
  /// Throws   FileError if it cannot be opened or read, or is a directory; LimitError if it is longer than half of the
  ///          machine's memory (an endless pipe ends here too), or a device that gives more than 64 MiB
  explicit FileBytes(const std::string& path);

  [[nodiscard]] std::string_view view() const noexcept { return {data_.get(), size_}; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

}  // namespace derham
