// SPDX-License-Identifier: Apache-2.0
#include "base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
 protected:
  AtomicFile() : folder_(fs::path(testing::TempDir()) /
                         ("ridgeline_atomic_file_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~AtomicFile() override { fs::remove_all(folder_); }

  int CountFiles() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(AtomicFile, FilesThatBelongTogetherAreThereTogetherOrNotAtAll) {
  WriteFileAtomically(folder_ / "a.txt", "old");
  EXPECT_THROW(WriteFilesAtomically({{folder_ / "a.txt", "new"}, {folder_ / "none/b.txt", "new"}}),
               InputError);
  EXPECT_EQ(ReadFile(folder_ / "a.txt"), "old");
  EXPECT_EQ(CountFiles(), 1);
  WriteFilesAtomically({{folder_ / "a.txt", "new"}, {folder_ / "b.txt", "other"}});
  EXPECT_EQ(ReadFile(folder_ / "a.txt") + ReadFile(folder_ / "b.txt"), "newother");
  EXPECT_EQ(CountFiles(), 2);
}

TEST_F(AtomicFile, ReplacesTheWholeContentAndLeavesNothingElse) {
  const fs::path path = folder_ / "pose.json";
  WriteFileAtomically(path, "a long first content");
  WriteFileAtomically(path, "second");
  EXPECT_EQ(ReadFile(path), "second");
  EXPECT_EQ(CountFiles(), 1);
}

TEST_F(AtomicFile, MissingFolderIsNamed) {
  try {
    WriteFileAtomically(folder_ / "none" / "pose.json", "x");
    FAIL() << "nothing thrown";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("expected an existing folder"));
  }
}

TEST_F(AtomicFile, PlaceTakenByAFolderLeavesNoTemporary) {
  fs::create_directories(folder_ / "pose.json" / "inside");
  EXPECT_THROW(WriteFileAtomically(folder_ / "pose.json", "x"), InputError);
  EXPECT_EQ(CountFiles(), 1);
}

TEST_F(AtomicFile, ReadingNothingOrAFolderIsAnError) {
  EXPECT_THROW(ReadFile(folder_ / "none.json"), InputError);
  EXPECT_THROW(ReadFile(folder_), InputError);
}

}  // namespace
}  // namespace ridgeline
