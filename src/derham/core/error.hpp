#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace derham {

/// The root of everything derham throws. `kind()` is the stable machine-readable name used by the command line's JSON.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  [[nodiscard]] virtual const char* kind() const noexcept { return "error"; }
};

/// An argument has a wrong shape, range or value.
class InputError : public Error {
 public:
  using Error::Error;
  /// `row` is the first offending row of the input (0-based), or -1.
  InputError(const std::string& message, std::int64_t row) : Error(message), row_(row) {}
  [[nodiscard]] const char* kind() const noexcept override { return "input"; }
  [[nodiscard]] std::int64_t row() const noexcept { return row_; }

 private:
  std::int64_t row_ = -1;
};

/// A complex lacks a topological property that was demanded (purity, manifold, orientability).
class TopologyError : public Error {
 public:
  using Error::Error;
  [[nodiscard]] const char* kind() const noexcept override { return "topology"; }
};

/// A metric quantity does not exist: degenerate simplex, NaN position, division by a zero dual volume.
class GeometryError : public Error {
 public:
  using Error::Error;
  [[nodiscard]] const char* kind() const noexcept override { return "geometry"; }
};

/// Something does not fit: the index type, or a stated bound on size.
class LimitError : public Error {
 public:
  using Error::Error;
  [[nodiscard]] const char* kind() const noexcept override { return "limit"; }
};

/// A file cannot be read, parsed or written. `what()` already holds "path:line: message".
class FileError : public Error {
 public:
  enum class Action : std::uint8_t { read, write };
  /// `line` is 1-based, 0 when no line applies (binary data, a file that cannot be opened).
  FileError(Action action, std::string path, std::int64_t line, const std::string& message)
      : Error(path + (line > 0 ? std::string(":").append(std::to_string(line)) : std::string()) + ": " + message),
        action_(action), path_(std::move(path)), line_(line) {}
  [[nodiscard]] const char* kind() const noexcept override { return action_ == Action::read ? "read" : "write"; }
  [[nodiscard]] Action action() const noexcept { return action_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::int64_t line() const noexcept { return line_; }

 private:
  Action action_;
  std::string path_;
  std::int64_t line_;
};

}  // namespace derham
