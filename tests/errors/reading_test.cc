// Getting at the bytes: folders, missing files, pipes, endless and huge inputs, odd paths.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "frontend/input_file.h"
#include "frontend/read_model.h"
#include "support/temp_dir.h"
#include "support/urdf_text.h"

namespace arboc::test {
namespace {

Reading try_path(const std::string& path) {
  return try_reading([&](Diagnostics& d) { return read_model(path, d); });
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Writes `text` `times` times into the pipe at `path`, or until its reader goes away.
std::thread writer(const std::string& path, const std::string& text, long times) {
  std::signal(SIGPIPE, SIG_IGN);
  return std::thread([=] {
    const int fd = ::open(path.c_str(), O_WRONLY);
    for (long k = 0; k < times; ++k)
      if (::write(fd, text.data(), text.size()) < 0) break;
    ::close(fd);
  });
}

TEST(Reading, Folder) {
  const TempDir dir;
  EXPECT_EQ(try_path(dir.path()).what, dir.path() + ": error: is a directory (give a file)");
}

TEST(Reading, MissingFile) {
  EXPECT_EQ(try_path("/nonexistent/arm.urdf").what,
            "/nonexistent/arm.urdf: error: cannot be opened: No such file or directory");
  EXPECT_EQ(try_path("%s%s%s%n%n").what,
            "%s%s%s%n%n: error: cannot be opened: No such file or directory");
}

TEST(Reading, PathTooLong) {
  const Reading reading = try_path(repeated("/long", 2000));
  ASSERT_FALSE(reading.model);
  EXPECT_NE(reading.what.find("cannot be opened: File name too long"), std::string::npos);
}

TEST(Reading, EmptyDevice) {
  EXPECT_EQ(try_path("/dev/null").what, "/dev/null:1:1: error: the file is empty");
}

TEST(Reading, EndlessDevice) {
  EXPECT_EQ(try_path("/dev/zero").what, "/dev/zero: error: is too large: the limit is 64 MiB");
}

TEST(Reading, Pipe) {
  const TempDir dir;
  const std::string path = dir / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread thread = writer(path, chain_text(3), 1);
  const Reading reading = try_path(path);
  thread.join();
  ASSERT_TRUE(reading.model) << reading.what;
  EXPECT_EQ(reading.model->links.size(), 4u);
}

TEST(Reading, EndlessPipe) {
  const TempDir dir;
  const std::string path = dir / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread thread = writer(path, repeated("<link name=\"a\"/>", 4096), 1L << 40);
  const Reading reading = try_path(path);
  thread.join();
  EXPECT_EQ(reading.what, path + ": error: is too large: the limit is 64 MiB");
}

TEST(Reading, SparseFile) {
  const TempDir dir;
  const std::string path = dir / "sparse.urdf";
  write(path, "<robot name=\"a\">");
  std::filesystem::resize_file(path, uintmax_t{4} << 30);
  EXPECT_EQ(try_path(path).what, path + ": error: is too large: the limit is 64 MiB");
}

TEST(Reading, FileOfTheLargestSize) {
  const TempDir dir;
  const std::string path = dir / "largest.urdf";
  std::string text = chain_text(1);
  text.resize(kMaxFileBytes, '\n');
  write(path, text);
  EXPECT_TRUE(try_path(path).model);
  write(path, text + "\n");
  EXPECT_EQ(try_path(path).what, path + ": error: is too large: the limit is 64 MiB");
}

TEST(Reading, OddPath) {
  const TempDir dir;
  const std::string path = dir / "two words 'n \"quotes\" \xC3\xA9\xE6\x9C\xBA.urdf";
  write(path, chain_text(2));
  const Reading reading = try_path(path);
  ASSERT_TRUE(reading.model) << reading.what;
  EXPECT_EQ(reading.model->file, "two words 'n \"quotes\" \xC3\xA9\xE6\x9C\xBA.urdf");
  EXPECT_EQ(reading.model->name, "chain");
  EXPECT_EQ(reading.model->source_sha256.size(), 64u);
}

TEST(Reading, OtherKinds) {
  EXPECT_EQ(try_path("arm.dh.toml").what,
            "arm.dh.toml: error: cannot be opened: No such file or directory");
  EXPECT_EQ(try_path("arm.urdf.xacro").what,
            "arm.urdf.xacro: error: this is a xacro file (run xacro on it first)");
}

}  // namespace
}  // namespace arboc::test
