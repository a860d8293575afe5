// Whatever happens to a file: within two seconds and without asking for a gigabyte of memory it is read, or refused with
// an error of ours. The seeds are fixed, so a failure repeats.
#include "io/damage.hpp"
#include "io/bounded_read.hpp"
#include "io/io_fixture.hpp"
#include "io/sample_files.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

// Read by AddressSanitizer when the program starts: one allocation of more than this many MiB is an error.
extern "C" const char* __asan_default_options();  // NOLINT: a name of the compiler's
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=1024"; }  // NOLINT

namespace derham::io_test {
namespace {

class Damage : public ::testing::TestWithParam<SampleFile> {};
class TextDamage : public Damage {};

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
