#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace derham::cli {

using Json = nlohmann::ordered_json;

enum class Exit : std::uint8_t {
  ok = 0,
  check_failed = 1,
  usage = 2,
  unreadable = 3,
  unwritable = 4,
  numerical = 5,
  limit = 6,
};

/// A failure that already knows how the program ends.
class Failure : public std::runtime_error {
 public:
  Failure(Exit exit, const char* failure_kind, const std::string& message, std::string path = {}, std::int64_t at = 0)
      : std::runtime_error(message), code(exit), kind(failure_kind), file(std::move(path)), line(at) {}
  Exit code;
  std::string kind, file;
  std::int64_t line;
};

/// What every subcommand takes.
struct Common {
  bool json = false;
  bool quiet = false;
};

/// Messages for people: to stderr, unless --quiet.
class Console {
 public:
  explicit Console(const Common& common) : quiet_(common.quiet) {}
  void message(const std::string& text) const;
  /// A line that the next stage overwrites; only on a terminal.
  void stage(const std::string& text);
  void clear_stage();

 private:
  bool quiet_;
  bool open_stage_ = false;
};

/// Writes to stdout: the JSON object, ended by a newline. Throws Failure(unwritable) if stdout does not take it.
void print(const Json& json);
void print(const std::string& text);

/// " (did you mean 'x'?)" for the entry of `known` closest to `word`, or nothing if none is close.
[[nodiscard]] std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}  // namespace derham::cli
