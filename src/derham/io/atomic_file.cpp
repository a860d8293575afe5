#include "derham/io/atomic_file.hpp"

#include "derham/core/error.hpp"
#include "derham/core/text.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace derham {
namespace {

// Names of pending temporaries, where a signal handler may read them: no allocation, no lock. A name too long for its
// slot, or one more than there are slots, is simply not listed.
enum class SlotState : int { free, filling, pending };
struct Slot {
  std::atomic<SlotState> state{SlotState::free};
  std::array<char, 1024> path{};
};
std::array<Slot, 32> slots;
static_assert(std::atomic<SlotState>::is_always_lock_free);

int take_slot(const std::string& path) noexcept {
  for (std::size_t i = 0; i < slots.size() && path.size() < slots[i].path.size(); ++i) {
    auto expected = SlotState::free;
    if (!slots[i].state.compare_exchange_strong(expected, SlotState::filling)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].state.store(SlotState::pending);
    return static_cast<int>(i);
  }
  return -1;
}

void free_slot(int slot) noexcept {
  if (slot >= 0) slots[static_cast<std::size_t>(slot)].state.store(SlotState::free);
}

// A name that no other process or thread uses; short, so that long file names still have one.
std::string temporary_beside(const std::string& target) {
  static std::atomic<unsigned> counter{0};
  const auto slash = target.find_last_of('/');
  const auto directory = slash == std::string::npos ? std::string() : target.substr(0, slash + 1);
  return text(directory, ".derham-", ::getpid(), "-", counter.fetch_add(1), ".tmp");
}

}  // namespace

void remove_pending_temporaries() noexcept {
  for (auto& slot : slots)
    if (slot.state.load() == SlotState::pending) ::unlink(slot.path.data());
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), target_(path_) {
  if (path_ == "-" || path_ == "/dev/stdout") {
    descriptor_ = STDOUT_FILENO;
    is_stdout_ = true;
    return;
  }
  if (path_.empty()) fail("cannot write to an empty file name", ENOENT);
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail("cannot write", EISDIR);
  if (exists && ::access(path_.c_str(), W_OK) != 0) fail("cannot write", errno);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot open", errno);
    return;
  }
  if (exists) {
    std::error_code error;
    target_ = std::filesystem::canonical(path_, error).string();
    if (error) fail("cannot write", error.value());
  }

  // Listed before it exists, so that no signal finds a file that is not listed.
  for (int attempt = 0;; ++attempt) {
    temporary_ = temporary_beside(target_);
    slot_ = take_slot(temporary_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) break;
    const int code = errno;
    free_slot(std::exchange(slot_, -1));
    if (code != EEXIST || attempt == 1000) fail("cannot create", code);
  }
  // Where the file system has no permissions to keep, there is nothing to lose.
  if (exists) (void)::fchmod(descriptor_, status.st_mode & 07777);
}

AtomicFile::~AtomicFile() {
  if (!is_stdout_ && descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  free_slot(slot_);
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor_, bytes.data(), std::min(bytes.size(), std::size_t{1} << 30));
    if (written < 0 && errno != EINTR) fail("cannot write", errno);
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::finish() {
  if (is_stdout_ || descriptor_ < 0) return;
  if (!temporary_.empty() && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
    fail("cannot write", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("cannot write", errno);
}

void AtomicFile::remove_old() const {
  if (temporary_.empty()) return;
  if (::unlink(target_.c_str()) != 0 && errno != ENOENT) fail("cannot replace", errno);
}

void AtomicFile::commit() {
  finish();
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot rename to", errno);
  temporary_.clear();
  free_slot(std::exchange(slot_, -1));
}

void AtomicFile::fail(const char* action, int code) const {
  throw FileError(FileError::Action::write, path_, 0, text(action, ": ", std::generic_category().message(code)));
}

}  // namespace derham
