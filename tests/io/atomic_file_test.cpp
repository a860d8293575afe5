#include "derham/io/atomic_file.hpp"

#include "derham/io/text_writer.hpp"
#include "io/io_fixture.hpp"

#include <string>

#include <sys/stat.h>
#include <unistd.h>

namespace derham::io_test {
namespace {

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryDirectory directory;
  const auto path = directory / "result";
  write_bytes(path, "old");
  {
    AtomicFile file(path);
    file.write("new");
    EXPECT_EQ(read_bytes(path), "old");
    EXPECT_EQ(directory.file_count(), 2);
  }
  EXPECT_EQ(read_bytes(path), "old");
  EXPECT_EQ(directory.file_count(), 1);
  AtomicFile file(path);
  file.write("new");
  file.commit();
  EXPECT_EQ(read_bytes(path), "new");
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(AtomicFile, KeepsPermissionsAndLinks) {
  const TemporaryDirectory directory;
  write_bytes(directory / "target", "old");
  ASSERT_EQ(chmod((directory / "target").c_str(), 0640), 0);
  ASSERT_EQ(symlink("target", (directory / "link").c_str()), 0);
  AtomicFile file(directory / "link");
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
  EXPECT_EQ(read_bytes(directory / "target"), "new");
  struct stat status {};
  ASSERT_EQ(stat((directory / "target").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST(AtomicFile, SignalHandlersCanRemoveWhatIsPending) {
  const TemporaryDirectory directory;
  AtomicFile done(directory / "done");
  done.commit();
  AtomicFile first(directory / "first"), second(directory / "second");
  EXPECT_EQ(directory.file_count(), 3);
  remove_pending_temporaries();
  EXPECT_EQ(directory.file_count(), 1);
  EXPECT_TRUE(std::filesystem::exists(directory / "done"));
  EXPECT_THROW(first.commit(), FileError);
}

TEST(AtomicFile, RefusesWhereItCannotWrite) {
  const TemporaryDirectory directory;
  const auto expect_error = [](const std::string& path) {
    try {
      const AtomicFile file(path);
      ADD_FAILURE() << path;
    } catch (const FileError& error) {
      EXPECT_STREQ(error.kind(), "write");
      EXPECT_EQ(error.path(), path);
    }
  };
  expect_error(directory / ".");
  expect_error(directory / "absent/file");
  expect_error("");
}

TEST(AtomicFile, AFullDeviceIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  AtomicFile file("/dev/full");
  EXPECT_THROW(file.write("x"), FileError);
}

TEST(TextWriter, WritesWhatReadsBack) {
  const TemporaryDirectory directory;
  AtomicFile file(directory / "text");
  TextWriter writer(file);
  const std::string longer_than_the_buffer(200000, 'x');
  writer.put(-7).put(' ').put(0.1).put(' ').put(1e300).put('\n').put(longer_than_the_buffer).put('.');
  writer.flush();
  file.commit();
  EXPECT_EQ(read_bytes(directory / "text"), "-7 0.1 1e+300\n" + longer_than_the_buffer + ".");
}

}  // namespace
}  // namespace derham::io_test
