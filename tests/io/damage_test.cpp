// Whatever happens to a file: within two seconds and without asking for a gigabyte of memory it is read, or refused with
// an error of ours. The seeds are fixed, so a failure repeats.
#include "io/damage.hpp"
#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <sys/time.h>
#include <unistd.h>

// Read by AddressSanitizer when the program starts: one allocation of more than this many MiB is an error.
extern "C" const char* __asan_default_options();  // NOLINT(bugprone-reserved-identifier,cert-*)
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=1024"; }  // NOLINT

namespace derham::io_test {
namespace {

class Damage : public ::testing::TestWithParam<SampleFile> {};
class TextDamage : public Damage {};

// Ends the program, and with it the test, when a read takes more than two seconds of processor time.
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

// Reads within the limits, and expects of a success that it is a sound MeshData.
bool is_read(std::string_view bytes, MeshFormat format, const ReadOptions& options = {}) {
  const TwoSeconds limit;
  try {
    const auto mesh = read_mesh_from_memory(bytes, format, "damaged", options);
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
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST_P(TextDamage, LineEndsAndByteOrderMarkMakeNoDifference) {
  const auto format = GetParam().format;
  const auto bytes = GetParam().bytes;
  const auto plain = read_mesh_from_memory(bytes, format, "plain");
  std::string variant = "\xef\xbb\xbf";
  for (const char c : bytes) variant += c == '\n' ? std::string(" \t\r\n") : std::string(1, c == ' ' ? '\t' : c);
  while (variant.back() == '\n' || variant.back() == '\r' || variant.back() == '\t' || variant.back() == ' ')
    variant.pop_back();
  const auto changed = read_mesh_from_memory(variant, format, "variant");
  EXPECT_EQ(changed.simplices, plain.simplices);
  EXPECT_EQ(changed.points, plain.points);
  EXPECT_EQ(changed.vertex_tags, plain.vertex_tags);
  EXPECT_EQ(changed.row_tags, plain.row_tags);
  EXPECT_EQ(changed.lower_count(), plain.lower_count());
}

TEST_P(Damage, TruncationAtEveryByte) {
  const auto& sample = GetParam();
  for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
    const bool read = is_read(sample.bytes.substr(0, length), sample.format);
    if (length < sample.refused_below) {
      EXPECT_FALSE(read) << "cut to " << length << " bytes";
    }
  }
}

TEST_P(Damage, EveryByteReplaced) {
  const auto format = GetParam().format;
  const auto bytes = GetParam().bytes;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const char c : {'\0', '\xff', '-', '9', ' ', '\n', '#', 'x', '.', '$'}) {
      std::string damaged(bytes);
      damaged[at] = c;
      (void)is_read(damaged, format);
    }
}

TEST_P(Damage, TwoThousandMutations) {
  const auto format = GetParam().format;
  Damager damaged(20261 + static_cast<unsigned>(format));
  int read = 0;
  for (int i = 0; i < 2000; ++i) read += is_read(damaged(GetParam().bytes), format);
  // Neither everything nor nothing gets through, or the mutations would test nothing.
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 2000);
}

TEST_P(Damage, KeptCorpusOfTheFuzzers) {
  const auto format = GetParam().format;
  const std::string folder = std::string(DERHAM_FUZZ_CORPUS) + "/fuzz_" + format_name(format);
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    (is_read(read_bytes(entry.path().string()), format) ? read : refused) += 1;
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

TEST_P(Damage, HugeCountsReserveNothing) {
  const auto format = GetParam().format;
  const auto bytes = GetParam().bytes;
  // Every number of the file in turn is made huge: refused, or a harmless number.
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (bytes[at] < '0' || bytes[at] > '9' || (at > 0 && bytes[at - 1] != ' ' && bytes[at - 1] != '\n')) continue;
    for (const auto* huge : {"2147483646", "4294967297", "1152921504606846976", "9223372036854775807"}) {
      std::string damaged(bytes);
      damaged.replace(at, 1, huge);
      (void)is_read(damaged, format);
    }
  }
}

std::vector<SampleFile> text_samples() {
  std::vector<SampleFile> samples;
  std::ranges::copy_if(sample_files, std::back_inserter(samples), &SampleFile::is_text);
  return samples;
}

INSTANTIATE_TEST_SUITE_P(Formats, Damage, ::testing::ValuesIn(sample_files),
                         [](const auto& test) { return std::string(test.param.name); });

INSTANTIATE_TEST_SUITE_P(Formats, TextDamage, ::testing::ValuesIn(text_samples()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace derham::io_test
