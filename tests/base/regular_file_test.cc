// SPDX-License-Identifier: Apache-2.0
// What is no regular file is refused before anything opens it.
#include "base/regular_file.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

class RegularFile : public ::testing::Test {
 protected:
  RegularFile() { fs::create_directories(folder_); }
  ~RegularFile() override { fs::remove_all(folder_); }

  // What reading says, without the folder; "" if it is read.
  std::string Message(const fs::path& path) const {
    try {
      ReadFile(path);
    } catch (const InputError& e) {
      std::string text = e.what();
      const std::string prefix = folder_.string() + "/";
      if (text.starts_with(prefix)) text.erase(0, prefix.size());
      return text;
    }
    return "";
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("ridgeline_regular_" + std::to_string(::getpid()));
};

TEST_F(RegularFile, PipesDevicesAndSocketsAreRefusedAtOnce) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(Message(folder_ / "pipe"),
            "pipe: got a pipe or a device, expected a file, as a regular file");
  EXPECT_EQ(Message("/dev/zero"),
            "/dev/zero: got a pipe or a device, expected a file, as a regular file");
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (folder_ / "s").c_str(), sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(Message(folder_ / "s"),
            "s: got a pipe or a device, expected a file, as a regular file");
  ::close(descriptor);
}

TEST_F(RegularFile, FoldersAbsentFilesAndLoopsOfLinks) {
  EXPECT_EQ(Message(folder_), folder_.string() + ": got a folder, expected a file");
  EXPECT_EQ(Message(folder_ / "no"), "no: got no such file, expected a file");
  fs::create_symlink(folder_ / "loop", folder_ / "loop");
  EXPECT_EQ(Message(folder_ / "loop"),
            "loop: got Too many levels of symbolic links, expected a file");
}

TEST_F(RegularFile, FilesAreReadWhole) {
  const std::string content = std::string("a\0b", 3) + std::string(200'000, 'x');
  WriteFileAtomically(folder_ / "file", content);
  fs::create_symlink(folder_ / "file", folder_ / "link");
  EXPECT_EQ(ReadFile(folder_ / "file"), content);
  EXPECT_EQ(ReadFile(folder_ / "link"), content);
  WriteFileAtomically(folder_ / "empty", "");
  EXPECT_EQ(ReadFile(folder_ / "empty"), "");
}

// Files of /proc have the size 0 and more in them; memory cannot be read from its beginning.
TEST_F(RegularFile, AFileThatFailsWhileItIsReadIsNoEmptyFile) {
  EXPECT_EQ(Message("/proc/self/mem"),
            "/proc/self/mem: got a file that cannot be read, expected a whole one");
}

}  // namespace
}  // namespace ridgeline
