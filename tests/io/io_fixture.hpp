#pragma once

#include "derham/core/error.hpp"
#include "derham/io/read_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace derham::io_test {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The error that reading `bytes` raises; its line 0 with an empty path when it raises none.
inline FileError read_error(std::string_view bytes, MeshFormat format) {
  try {
    (void)read_mesh_from_memory(bytes, format, "mesh");
  } catch (const FileError& error) {
    return error;
  }
  ADD_FAILURE() << "this was read without an error:\n" << bytes;
  return FileError(FileError::Action::read, "", 0, "no error");
}

/// Expects that reading `bytes` fails at `line` with a message that contains `part`.
inline void expect_refused(std::string_view bytes, MeshFormat format, std::int64_t line, const std::string& part) {
  const auto error = read_error(bytes, format);
  EXPECT_EQ(error.line(), line) << error.what();
  EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what() << "\nlacks: " << part;
}

/// `bytes` with the first `what`, which must be there, replaced.
inline std::string replaced(std::string_view bytes, std::string_view what, std::string_view with) {
  std::string out(bytes);
  const auto at = out.find(what);
  if (at == std::string::npos) {
    ADD_FAILURE() << "there is no " << what;
    return out;
  }
  return out.replace(at, what.size(), with);
}

/// Expects a field; NaN is expected where `values` has it.
inline void expect_field(const MeshField& field, const std::string& name, MeshField::On on, int components,
                         const std::vector<double>& values) {
  EXPECT_EQ(field.name, name);
  EXPECT_EQ(field.on, on);
  EXPECT_EQ(field.components, components);
  ASSERT_EQ(field.values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i])) {
      EXPECT_TRUE(std::isnan(field.values[i])) << name << i;
    } else {
      EXPECT_EQ(field.values[i], values[i]) << name << i;
    }
}

/// A new directory that disappears with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "derham-io-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = pattern;
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] int file_count() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline void write_bytes(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}
inline std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace derham::io_test
