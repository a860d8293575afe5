// What damage_test does to files in one piece, for the faces and edges beside a TetGen mesh.
#include "io/bounded_read.hpp"
#include "io/damage.hpp"
#include "io/io_fixture.hpp"
#include "io/tetgen_faces.hpp"

#include <string>
#include <string_view>

namespace derham::io_test {
namespace {

struct FacesSample {
  const char* name;
  std::string_view bytes;
  bool is_quadratic;
};
class TetgenFacesDamage : public ::testing::TestWithParam<FacesSample> {
 protected:
  static bool is_sound(std::string_view bytes) {
    return is_read([&] { return read_tetgen_faces(bytes, {.corner_nodes = GetParam().is_quadratic}); });
  }
};

TEST_P(TetgenFacesDamage, TheSampleItselfIsRead) {
  const auto mesh = read_tetgen_faces(GetParam().bytes, {.corner_nodes = GetParam().is_quadratic});
  ASSERT_EQ(mesh.lower.size(), 3u);
  EXPECT_EQ(mesh.lower[2].size(), GetParam().is_quadratic ? 2 : 4);
  EXPECT_EQ(mesh.lower[1].size(), GetParam().is_quadratic ? 2 : 3);
}

TEST_P(TetgenFacesDamage, TruncationAtEveryByte) {
  const auto bytes = GetParam().bytes;
  const auto zero = bytes.find('\0');
  // Complete but for the last newline: the faces, without a file of edges, and both.
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_EQ(is_sound(bytes.substr(0, length)), length == zero - 1 || length == zero || length == bytes.size() - 1)
        << "cut to " << length << " bytes";
}

TEST_P(TetgenFacesDamage, EveryByteReplaced) {
  for (std::size_t at = 0; at < GetParam().bytes.size(); ++at)
    for (const char c : {'\0', '\xff', '-', '9', ' ', '\n', '#', 'x', '.', '$'}) {
      std::string damaged(GetParam().bytes);
      damaged[at] = c;
      (void)is_sound(damaged);
    }
}

TEST_P(TetgenFacesDamage, TwoThousandMutations) {
  Damager damaged(20291);
  int read = 0;
  for (int i = 0; i < 2000; ++i) read += is_sound(damaged(GetParam().bytes));
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 2000);
}

TEST_P(TetgenFacesDamage, HugeNumbersAreRefused) {
  const auto bytes = GetParam().bytes;
  // The first number of every line: a count, or the number of a face or an edge.
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (bytes[at] < '0' || bytes[at] > '9' || (at > 0 && bytes[at - 1] != '\n' && bytes[at - 1] != '\0')) continue;
    for (const auto* huge : {"2147483646", "4294967297", "1152921504606846976", "9223372036854775807"}) {
      std::string damaged(bytes);
      EXPECT_FALSE(is_sound(damaged.replace(at, 1, huge))) << "byte " << at << ": " << huge;
    }
  }
}

TEST(TetgenFacesCorpus, KeptByTheFuzzer) {
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DERHAM_FUZZ_CORPUS "/fuzz_tetgen_faces")) {
    const auto bytes = read_bytes(entry.path().string());
    const bool is_quadratic = bytes.size() % 2 == 1;  // as the fuzzer does
    (is_read([&] { return read_tetgen_faces(bytes, {.corner_nodes = is_quadratic}); }) ? read : refused) += 1;
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Samples, TetgenFacesDamage,
                         ::testing::Values(FacesSample{"linear", tetgen_faces_sample, false},
                                           FacesSample{"quadratic", tetgen_quadratic_faces_sample, true}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace derham::io_test
