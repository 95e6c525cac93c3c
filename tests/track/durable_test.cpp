// SPDX-License-Identifier: MIT
// What is on the disk, and in which order: a power cut keeps what was flushed, and loses what was not. The calls are seen because this
// program puts itself in front of the system's.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "libtrack/file.h"

namespace {

std::vector<std::string> calls;
std::string root;

std::string below_root(const std::string& path) {
  return path == root ? "." : path.starts_with(root + '/') ? path.substr(root.size() + 1) : path;
}

std::string name_of(int fd) {
  std::error_code failed;
  return below_root(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd), failed).string());
}

}  // namespace

extern "C" {
int fsync(int fd) {
  calls.push_back("flush " + name_of(fd));
  return static_cast<int>(syscall(SYS_fsync, fd));
}

int fdatasync(int fd) {
  calls.push_back("flush " + name_of(fd));
  return static_cast<int>(syscall(SYS_fdatasync, fd));
}

int rename(const char* from, const char* to) noexcept {
  calls.push_back("rename " + below_root(to));
  return static_cast<int>(syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
}
}

namespace swarmfit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::StartsWith;

class Durable : public testing::Test {
 protected:
  void SetUp() override {
    root = (fs::canonical(fs::temp_directory_path()) / ("swarmfit_durable_" + std::to_string(getpid()))).string();
    fs::create_directories(root);
    calls.clear();
  }
  void TearDown() override { fs::remove_all(root); }
};

TEST_F(Durable, AFileIsFlushedThenRenamedThenItsFolderIsFlushed) {
  write_file_atomically(root + "/a", "one");
  EXPECT_THAT(calls, ElementsAre(StartsWith("flush a."), "rename a", "flush ."));
}

TEST_F(Durable, EveryAppendIsFlushedAndSoIsTheName) {
  AppendedFile file(root + "/log");
  EXPECT_THAT(calls, ElementsAre("flush ."));
  file.append("one");
  file.append("two");
  EXPECT_THAT(calls, ElementsAre("flush .", "flush log", "flush log"));
  EXPECT_EQ(read_file(root + "/log"), "onetwo");
}

TEST_F(Durable, NewFoldersAreFlushedIntoThoseAbove) {
  make_directory(root + "/a/b");
  EXPECT_THAT(calls, ElementsAre("flush .", "flush a"));
  calls.clear();
  make_directory(root + "/a/b");
  EXPECT_TRUE(calls.empty());
}

}  // namespace
}  // namespace swarmfit
