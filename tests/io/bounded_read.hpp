#pragma once

#include "derham/core/error.hpp"
#include "derham/io/read_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string_view>

#include <sys/time.h>
#include <unistd.h>

namespace derham::io_test {

/// Ends the program, and with it the test, when a read takes more than two seconds of processor time.
class TwoSeconds {
 public:
  TwoSeconds() {
    std::signal(SIGPROF, [](int) {
      constexpr std::string_view message = "a reader took more than two seconds\n";
      (void)!::write(STDERR_FILENO, message.data(), message.size());
      std::abort();
    });
    set(2);
  }
  TwoSeconds(const TwoSeconds&) = delete;
  TwoSeconds& operator=(const TwoSeconds&) = delete;
  ~TwoSeconds() { set(0); }

 private:
  static void set(int seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = seconds;
    ::setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

/// Expects that what is said in `mesh` of vertices, rows, parts and fields agrees.
inline void expect_sound(const MeshData& mesh) {
  EXPECT_LE(mesh.simplices.vertex_bound(), mesh.vertex_count);
  if (mesh.ambient_dimension > 0 && !mesh.has_corners()) {
    EXPECT_EQ(mesh.points.size(),
              static_cast<std::size_t>(mesh.vertex_count) * static_cast<std::size_t>(mesh.ambient_dimension));
  }
  for (const auto& list : mesh.lower)
    for (const Index v : list.vertices()) EXPECT_TRUE(v >= 0 && v < mesh.vertex_count);
  const int n = mesh.simplices.dimension();
  for (const auto& part : mesh.parts) {
    const Offset bound = part.degree == n   ? mesh.simplices.size()
                         : part.degree == 0 ? Offset{mesh.vertex_count}
                         : part.degree < std::ssize(mesh.lower)
                             ? mesh.lower[static_cast<std::size_t>(part.degree)].size()
                             : 0;
    EXPECT_TRUE(std::ranges::adjacent_find(part.members, std::greater_equal<>()) == part.members.end());
    for (const Index member : part.members) EXPECT_TRUE(member >= 0 && member < bound);
  }
  for (const auto& field : mesh.fields) {
    const Offset items = field.on == MeshField::On::rows ? mesh.simplices.size() : Offset{mesh.vertex_count};
    EXPECT_EQ(static_cast<Offset>(field.values.size()), items * field.components);
  }
  for (const Index v : mesh.simplices.vertices()) EXPECT_GE(v, 0);
  EXPECT_TRUE(mesh.vertex_tags.empty() || static_cast<Index>(mesh.vertex_tags.size()) == mesh.vertex_count);
  EXPECT_TRUE(mesh.row_tags.empty() || static_cast<Offset>(mesh.row_tags.size()) == mesh.simplices.size());
}

/// Whether `read` gives a mesh, which is then expected to be sound, or refuses with an error of ours; nothing else is
/// allowed, nor more than two seconds.
template <class Read>
bool is_read(const Read& read) {
  const TwoSeconds limit;
  try {
    expect_sound(read());
    return true;
  } catch (const Error&) {
    return false;
  }
}

inline bool is_read(std::string_view bytes, MeshFormat format) {
  return is_read([&] { return read_mesh_from_memory(bytes, format, "damaged"); });
}

}  // namespace derham::io_test
