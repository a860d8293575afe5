#include "derham/io/file_bytes.hpp"

#include "derham/core/error.hpp"
#include "derham/core/large_pages.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace derham {
namespace {

// A descriptor that closes itself; standard input stays open.
struct Descriptor {
  int fd = -1;
  Descriptor(int number) : fd(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd > STDIN_FILENO) ::close(fd);
  }
};

// Devices such as /dev/zero need not end.
constexpr std::size_t longest_device = std::size_t{1} << 26;

std::size_t longest_file() {
  const auto pages = ::sysconf(_SC_PHYS_PAGES);
  const auto page = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) / 2 * static_cast<std::size_t>(page)
                               : std::size_t{1} << 32;
}

}  // namespace

FileBytes::FileBytes(const std::string& path) {
  const bool standard_input = path == "-";
  const std::string name = standard_input ? "stdin" : path;
  const auto fail = [&](const char* action, int code) {
    throw FileError(FileError::Action::read, name, 0, text(action, ": ", std::generic_category().message(code)));
  };

  const Descriptor file(standard_input ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.fd < 0) fail("cannot open", errno);
  struct stat status {};
  if (::fstat(file.fd, &status) != 0) fail("cannot read", errno);
  if (S_ISDIR(status.st_mode)) fail("cannot read", EISDIR);

  // The size is only a first guess: pipes have none and files may grow. One byte more than the file lets the read that
  // finds its end happen without growing.
  const bool is_device = S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode);
  const std::size_t limit = is_device ? longest_device : longest_file();
  std::size_t capacity = std::size_t{1} << 16;
  if (S_ISREG(status.st_mode) && status.st_size > 0) capacity = static_cast<std::size_t>(status.st_size) + 1;
  while (true) {
    if (capacity > limit)
      throw LimitError(text(
          name, ": longer than ", limit, " bytes, ",
          is_device ? "the most that is read from a device; give a file or a pipe" : "half of this machine's memory"));
    auto larger = std::make_unique_for_overwrite<char[]>(capacity);
    prefer_large_pages(larger.get(), capacity);
    if (size_ > 0) std::memcpy(larger.get(), data_.get(), size_);
    data_ = std::move(larger);
    while (size_ < capacity) {
      const auto got = ::read(file.fd, data_.get() + size_, std::min(capacity - size_, std::size_t{1} << 30));
      if (got == 0) return;
      if (got < 0 && errno != EINTR) fail("cannot read", errno);
      if (got > 0) size_ += static_cast<std::size_t>(got);
    }
    capacity *= 2;
  }
}

}  // namespace derham
