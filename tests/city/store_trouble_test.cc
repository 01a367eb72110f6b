// SPDX-License-Identifier: Apache-2.0
// Stores on a full disk, and stores that someone else holds.
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "city/city_text.h"
#include "city/store/city_store.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string Houses(int count) {
  std::string members;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d low = kCorner + Eigen::Vector3d(20.0 * (i % 20), 20.0 * (i / 20), 0.0);
    members += GmlBox("h" + std::to_string(i), low, low + Eigen::Vector3d(10, 10, 6));
  }
  return GmlDocument(members);
}

// A process that may write no file beyond a size stands for a full disk.
TEST(StoreTrouble, FullDiskIsAnErrorAndNoStore) {
  const TestFolder folder;
  const fs::path tile = folder.Write("tile.gml", Houses(400));
  const fs::path store = folder.path() / "city.gpkg";
  for (const rlim_t limit : {50'000, 120'000, 200'000}) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit size{limit, limit};
      ::setrlimit(RLIMIT_FSIZE, &size);
      try {
        CityOptions options;
        options.threads = 1;
        WriteCityStore({tile}, store, options);
      } catch (const InputError& e) {
        const std::string text = e.what();
        ::_exit(text.find("free space") != std::string::npos ? 42 : 43);
      }
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 42) << limit;
    EXPECT_FALSE(fs::exists(store)) << limit;
  }
  // With room again, the next run gets it whole.
  const CityStoreResult result = WriteCityStore({tile}, store, {});
  EXPECT_EQ(result.buildings, 400u);
  EXPECT_EQ(ReadCity({store}, {}).buildings.size(), 400u);
}

TEST(StoreTrouble, LockedStoreIsAnError) {
  const TestFolder folder;
  const fs::path tile = folder.Write("tile.gml", Houses(3));
  const fs::path store = folder.path() / "city.gpkg";
  WriteCityStore({tile}, store, {});
  GDALAllRegister();
  GDALDataset* const holder = GDALDataset::Open(store.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE);
  ASSERT_NE(holder, nullptr);
  holder->ReleaseResultSet(holder->ExecuteSQL("BEGIN EXCLUSIVE", nullptr, nullptr));
  try {
    ReadCity({store}, {});
    ADD_FAILURE() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("city.gpkg: got a "));
  }
  holder->ReleaseResultSet(holder->ExecuteSQL("ROLLBACK", nullptr, nullptr));
  GDALClose(holder);
  EXPECT_EQ(ReadCity({store}, {}).buildings.size(), 3u);
}

}  // namespace
}  // namespace ridgeline::testing
