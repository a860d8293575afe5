#include "derham/io/cursor.hpp"

#include "derham/core/error.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>

namespace derham {
namespace {

Cursor cursor(std::string_view bytes) { return {bytes, "file", '#'}; }

double real(std::string_view bytes) {
  auto c = cursor(bytes);
  EXPECT_TRUE(c.next_line());
  const double value = c.real("a coordinate");
  c.end_file();
  return value;
}

TEST(Cursor, SkipsBlanksCommentsAndByteOrderMark) {
  auto c = cursor("\xef\xbb\xbf# first\r\n\r\n \t1\t2 # two\r\n\n3");
  ASSERT_TRUE(c.next_line());
  EXPECT_EQ(c.integer("a"), 1);
  EXPECT_FALSE(c.at_line_end());
  EXPECT_EQ(c.integer("b"), 2);
  EXPECT_TRUE(c.at_line_end());
  ASSERT_TRUE(c.next_line());
  EXPECT_EQ(c.integer("c"), 3);
  c.end_line();
  EXPECT_FALSE(c.next_line());
  c.end_file();
}

TEST(Cursor, ReadsRealsToTheLastBit) {
  EXPECT_EQ(real("0.1"), 0.1);
  EXPECT_EQ(real("-1.7976931348623157e308"), -std::numeric_limits<double>::max());
  EXPECT_EQ(real("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(real("2.2250738585072011e-308"), 2.2250738585072011e-308);
  EXPECT_EQ(real("+2.5"), 2.5);
  EXPECT_EQ(real(".5"), 0.5);
  EXPECT_EQ(real("5."), 5.0);
  EXPECT_TRUE(std::signbit(real("-0")));
}

TEST(Cursor, RefusesWhatIsNoFiniteReal) {
  for (const auto* bytes :
       {"nan", "NaN", "-nan", "inf", "-Infinity", "1e400", "-1e400", "0x10", "1,5", "1.0D0",     "+-1", "++1",
        "+",   "-",   ".",    "e5",  "1e",        "1.2.3", "abc",    "",     "# 1", "1\xc2\xa0", "\x01"})
    EXPECT_THROW((void)cursor(bytes).real("a coordinate"), FileError) << bytes;
}

TEST(Cursor, RefusesWhatIsNoInteger) {
  for (const auto* bytes : {"1.0", "1e3", "+1", "0x1", "9223372036854775808", "--1", "1-", "one", ""})
    EXPECT_THROW((void)cursor(bytes).integer("an id"), FileError) << bytes;
  EXPECT_EQ(cursor("-9223372036854775808").integer("an id"), std::numeric_limits<std::int64_t>::min());
}

// Of any length, with anything behind, at the end of the file or not.
TEST(Cursor, ReadsIntegersOfAnyLength) {
  std::string digits;
  std::int64_t value = 0;
  for (const char digit : std::string_view("123456789098765432")) {
    digits += digit;
    value = 10 * value + (digit - '0');
    for (const char* sign : {"", "-"})
      for (const char* behind : {"", " ", "\n", "\r\n", "\t7 8 9 10 11", "#comment", " 99999999 99999999"}) {
        const std::string bytes = sign + digits + behind;
        auto c = cursor(bytes);
        EXPECT_EQ(c.integer("an id"), *sign == '-' ? -value : value) << digits << behind;
        EXPECT_EQ(c.offset(), static_cast<std::int64_t>(digits.size() + std::string_view(sign).size()));
      }
    for (const char* behind : {".", "/1", ":", "x", "-", "\x80\xff", "e5 1234567", "\xb0 1234567"})
      EXPECT_THROW((void)cursor(digits + behind).integer("an id"), FileError) << digits << behind;
  }
}

TEST(Cursor, ErrorsSayWhereWhatAndWhy) {
  auto c = cursor(
      "1\n\n2 x\xff"
      "y\n");
  ASSERT_TRUE(c.next_line());
  (void)c.integer("a");
  ASSERT_TRUE(c.next_line());
  (void)c.integer("b");
  try {
    (void)c.integer("a vertex id");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(error.line(), 3);
    EXPECT_STREQ(error.what(), "file:3: found 'x\\xffy', expected an integer as a vertex id");
  }
}

TEST(Cursor, AnInfiniteNumberIsNamed) {
  for (const std::string token : {"nan", "-inf", "+infinity"}) {
    const std::string bytes = "\n1   " + token + " 2\n";
    auto c = cursor(bytes);
    ASSERT_TRUE(c.next_line());
    (void)c.real("x");
    try {
      (void)c.real("a coordinate");
      FAIL();
    } catch (const FileError& error) {
      EXPECT_EQ(std::string(error.what()), "file:2: found '" + token + "', expected a finite number as a coordinate");
    }
  }
}

TEST(Cursor, BytesAreTakenOnlyIfTheyAreThere) {
  auto c = cursor("ab cd\n");
  EXPECT_EQ(c.bytes(3, "a block"), "ab ");
  EXPECT_EQ(c.offset(), 3);
  c.name_bytes(true);
  for (const std::int64_t count : {std::int64_t{100}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()}) {
    try {
      (void)c.bytes(count, "a block");
      FAIL();
    } catch (const FileError& error) {
      EXPECT_EQ(error.line(), 0);
      EXPECT_TRUE(std::string(error.what()).starts_with("file: byte 3: a block takes ")) << error.what();
    }
  }
  EXPECT_EQ(c.bytes(c.remaining(), "the rest").size(), 3U);
  EXPECT_EQ(c.bytes(0, "nothing"), "");
}

TEST(Cursor, EndOfFileIsOnItsLastLine) {
  auto c = cursor("1\n2\n");
  while (c.next_line()) c.skip_line();
  try {
    c.fail("gone");
  } catch (const FileError& error) {
    EXPECT_EQ(error.line(), 2);
  }
}

TEST(Cursor, CountsAreBoundedByWhatTheFileCanHold) {
  EXPECT_EQ(cursor("2\n0 0 0\n0 0 0").count("n", 6), 2);
  EXPECT_THROW((void)cursor("3\n0 0 0\n0 0 0").count("n", 6), FileError);
  EXPECT_THROW((void)cursor("9223372036854775807\n0 0 0\n").count("n", 6), FileError);
  EXPECT_THROW((void)cursor("-1\n").count("n", 6), FileError);
}

TEST(Cursor, FindsLines) {
  auto c = cursor("a\n$End b\n $EndX\n 7");
  EXPECT_FALSE(c.skip_past_line("$EndY"));
  ASSERT_TRUE(c.skip_past_line("$EndX"));
  ASSERT_TRUE(c.next_line());
  EXPECT_EQ(c.integer("n"), 7);
}

TEST(Cursor, QuotesOnlyPrintableAsciiAndNotMuch) {
  EXPECT_EQ(quoted_token("a\n\x80"), "'a\\x0a\\x80'");
  EXPECT_LT(quoted_token(std::string(1000, 'x')).size(), 60U);
}

}  // namespace
}  // namespace derham
