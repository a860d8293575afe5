#pragma once

#include <string>
#include <string_view>

namespace derham {

/// A file that appears complete or not at all: written to a temporary name in the same directory, then renamed.
///
/// "-" and "/dev/stdout" are standard output, and a path that names a pipe or a device is opened as it is: those are
/// written directly. A symbolic link keeps pointing to the file it names; an existing file keeps its permissions.
class AtomicFile {
 public:
  /// Throws FileError if the temporary file cannot be created, or `path` is a directory or write-protected.
  explicit AtomicFile(std::string path);

  /// Removes the temporary file unless `commit` has succeeded; an older file under the name is then untouched.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Throws FileError, e.g. when the disk is full.
  void write(std::string_view bytes);

  /// Flushes to the disk; nothing may be written after it. What is left to `commit` is to give the file its name.
  /// Throws FileError if it fails, e.g. when the disk is full.
  void finish();

  /// Removes an older file under the name: there is none until `commit`. For files that are replaced together.
  void remove_old() const;

  /// As `finish`, and gives the file its name. Throws FileError if either fails.
  void commit();

  /// The name as it was given.
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  [[noreturn]] void fail(const char* action, int code) const;

  std::string path_;       // as given, for messages
  std::string target_;     // with symbolic links followed
  std::string temporary_;  // empty when writing directly
  int descriptor_ = -1;
  bool is_stdout_ = false;  // the descriptor is not ours to close (a file of ours may well be number 0 or 1)
  int slot_ = -1;           // in the list of pending temporaries
};

/// Removes the temporary files of all AtomicFiles that are not committed yet. Safe to call in a signal handler, for a
/// process that is about to end.
void remove_pending_temporaries() noexcept;

}  // namespace derham
