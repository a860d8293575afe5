#include "derham/io/byte_stream.hpp"

#include <gtest/gtest.h>

namespace derham::io_test {
namespace {

std::string taken(ByteStream& stream, std::int64_t count) {
  std::string room;
  std::string_view bytes;
  return stream.take(count, room, bytes) ? std::string(bytes) : "refused";
}

TEST(ByteStream, DecodesBase64InAnyPieces) {
  for (const auto* text : {"YWJjZGVmZ2g=", " YWJj\nZGVm Z2g=\n", "YQ==YmNkZWZnaA==", "YWI=Y2Q=ZWY=Z2g="}) {
    for (std::int64_t first = 0; first <= 8; ++first) {
      ByteStream stream(text, true);
      EXPECT_GE(stream.bound(), 8);
      EXPECT_EQ(taken(stream, first), std::string("abcdefgh").substr(0, static_cast<std::size_t>(first)));
      EXPECT_EQ(stream.at_end(), first == 8);
      EXPECT_EQ(taken(stream, 8 - first), std::string("abcdefgh").substr(static_cast<std::size_t>(first)));
      EXPECT_TRUE(stream.at_end());
      EXPECT_EQ(taken(stream, 1), "refused");
    }
  }
}

TEST(ByteStream, RefusesWhatIsNotBase64) {
  for (const auto* text : {"YWJ", "YW!j", "=AAA", "A=AA", "AA=A", "YWJjYWJ"}) {
    ByteStream stream(text, true);
    EXPECT_EQ(taken(stream, 4), "refused") << text;
  }
}

TEST(ByteStream, TakesRawBytesAsTheyAre) {
  ByteStream stream("a b", false);
  EXPECT_EQ(taken(stream, 2), "a ");
  EXPECT_EQ(taken(stream, 2), "refused");
  EXPECT_EQ(taken(stream, -1), "refused");
  EXPECT_EQ(taken(stream, 1), "b");
  EXPECT_TRUE(stream.at_end());
}

}  // namespace
}  // namespace derham::io_test
