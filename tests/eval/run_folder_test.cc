// SPDX-License-Identifier: Apache-2.0
#include "eval/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/run_json.h"
#include "eval/sha256.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RunFolderTest : public ::testing::Test {
 protected:
  RunFolderTest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    work_.version = "ridgeline 1";
    work_.command = "bench";
    work_.folder = "/somewhere";
    work_.arguments = R"({"dataset": "d.json"})";
    work_.task = R"({"queries": ["a"], "seeds": 2, "options": {"search": {"east_m": 10.0}}})";
    work_.inputs = {{"dataset", "d.json", Sha256Of("d")}};
  }
  ~RunFolderTest() override { fs::remove_all(folder_); }

  std::string Message(const Provenance& work, bool resume) const {
    try {
      const RunFolder folder(folder_, work, resume);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  // One piece.
  void Fill() const {
    const RunFolder folder(folder_, work_, false);
    folder.Begin();
    folder.Keep("000000_a.json", R"({"x":1})");
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("run_folder_" + std::to_string(::getpid()));
  Provenance work_;
};

TEST_F(RunFolderTest, KeepsPiecesForTheNextStart) {
  {
    const RunFolder folder(folder_, work_, false);
    folder.Begin();
    EXPECT_EQ(folder.found(), 0u);
    EXPECT_EQ(folder.Find("000000_a.json"), std::nullopt);
    folder.Keep("000000_a.json", R"({"x":1})");
  }
  EXPECT_THAT(Message(work_, false), HasSubstr("which holds results"));
  const RunFolder folder(folder_, work_, true);
  EXPECT_EQ(folder.found(), 1u);
  EXPECT_EQ(folder.Find("000000_a.json"), R"({"x":1})");
}

TEST_F(RunFolderTest, RefusesOtherWorkAndSaysWhatDiffers) {
  Fill();
  Provenance other = work_;
  other.task = R"({"queries": ["a"], "seeds": 2, "options": {"search": {"east_m": 20.0}}})";
  EXPECT_THAT(Message(other, true),
              HasSubstr("options.search.east_m: got results made with 10.0, expected 20.0"));
  other = work_;
  other.version = "ridgeline 2";
  EXPECT_THAT(Message(other, true), HasSubstr("version: got results made with \"ridgeline 1\""));
  other = work_;
  other.inputs[0].sha256 = Sha256Of("another");
  EXPECT_THAT(Message(other, true), HasSubstr("dataset d.json (SHA-256 "));
  other = work_;
  other.shard = Shard{1, 2};
  EXPECT_THAT(Message(other, true), HasSubstr("results of the whole"));
  // Where the files lie does not matter.
  other = work_;
  other.folder = "/elsewhere";
  other.inputs[0].path = "/elsewhere/d.json";
  EXPECT_EQ(Message(other, true), "");
}

// Work that failed before its first piece leaves nothing that a second try would stumble over.
TEST_F(RunFolderTest, LeavesNothingWithoutAPiece) {
  {
    const RunFolder folder(folder_, work_, false);
    folder.Begin();
    EXPECT_TRUE(fs::exists(folder_ / "provenance.json"));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  EXPECT_EQ(Message(work_, false), "");
}

TEST_F(RunFolderTest, OneProcessAtATime) {
  const RunFolder folder(folder_, work_, false);
  EXPECT_THAT(Message(work_, true), HasSubstr("to which another process writes"));
}

TEST_F(RunFolderTest, TornPiecesAreNoneAndForeignOnesAreNamed) {
  const RunFolder folder(folder_, work_, false);
  folder.Begin();
  folder.Keep("a.json", R"({"x":1})");
  const std::string whole = ReadFile(folder_ / "runs/a.json");
  for (const std::size_t length : {std::size_t{0}, whole.size() / 2, whole.size() - 2}) {
    WriteFileAtomically(folder_ / "runs/a.json", whole.substr(0, length));
    EXPECT_EQ(folder.Find("a.json"), std::nullopt) << length;
  }
  WriteFileAtomically(folder_ / "runs/a.json", R"({"fingerprint":"other","piece":{"x":1}})");
  EXPECT_THROW(folder.Find("a.json"), InputError);
}

TEST_F(RunFolderTest, RemovesWhatKilledProcessesLeft) {
  Fill();
  WriteFileAtomically(folder_ / ".results.part-1-1.csv", "x");
  WriteFileAtomically(folder_ / "runs/.a.part-1-2.json", "x");
  { const RunFolder folder(folder_, work_, true); }
  EXPECT_FALSE(fs::exists(folder_ / ".results.part-1-1.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "runs/.a.part-1-2.json"));
}

TEST(PieceName, IsUniqueByItsPlaceAndFitsAFileSystem) {
  EXPECT_EQ(PieceName(17, "street/5 ä_1"), "000017_street_5____1.json");
  EXPECT_NE(PieceName(1, "a b"), PieceName(2, "a_b"));
  EXPECT_LT(PieceName(3, std::string(1000, 'x')).size(), 100u);
}

TEST(Provenance, IsReadBack) {
  Provenance work;
  work.version = "v";
  work.command = "study";
  work.folder = "/f";
  work.arguments = R"({"a":1})";
  work.task = R"({"b":[2]})";
  work.inputs = {{"model", "m.gml", Sha256Of("m")}};
  work.shard = Shard{2, 3};
  const fs::path file =
      fs::path(::testing::TempDir()) / ("provenance_" + std::to_string(::getpid()) + ".json");
  WriteFileAtomically(file, ProvenanceJson(work));
  const Provenance read = ReadProvenance(file);
  EXPECT_EQ(FingerprintOf(read), FingerprintOf(work));
  EXPECT_EQ(read.shard, work.shard);
  EXPECT_EQ(read.inputs[0].path, "m.gml");
  WriteFileAtomically(file, "{}");
  EXPECT_THROW(ReadProvenance(file), InputError);
  fs::remove(file);
}

// FIPS 180-4's examples.
TEST(Sha256, KnownValues) {
  EXPECT_EQ(Sha256Of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const fs::path file = fs::path(::testing::TempDir()) / ("sha_" + std::to_string(::getpid()));
  WriteFileAtomically(file, std::string(1000000, 'a'));
  EXPECT_EQ(Sha256OfFile(file),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  fs::remove(file);
  EXPECT_THROW(Sha256OfFile(file), InputError);
  EXPECT_THROW(Sha256OfFile("/dev/zero"), InputError);  // no end
}

TEST(Shard, PartsCoverEveryPieceOnce) {
  for (std::size_t piece = 0; piece < 20; ++piece) {
    int takers = 0;
    for (int i = 1; i <= 3; ++i) takers += Shard{i, 3}.Takes(piece) ? 1 : 0;
    EXPECT_EQ(takers, 1);
  }
  EXPECT_EQ(ParseShard("2/3"), (Shard{2, 3}));
  for (const char* bad : {"", "2", "0/3", "4/3", "a/3", "1/0", "1/3x", "-1/3", "1 /3"}) {
    EXPECT_THROW(ParseShard(bad), InputError) << bad;
  }
}

TEST(RunText, ReadsBackToTheLastBit) {
  Query query;
  query.id = "q, \"1\"";
  query.truth = Pose{CamFromWorld(ViewAngles{10.0, 1.0, 0.5}), {690000.1, 5335000.2, 500.3}};
  BenchRun run;
  run.query = 4;
  run.prior.position_in_world = {690001.123456789, 5335000.0};
  run.prior.pitch_deg = 0.1;
  run.ranges.east_m = 1.0 / 3.0;
  Localization& found = run.localization;
  found.status = LocalizationStatus::kDoubtful;
  found.doubts = {"a doubt"};
  found.pose = Pose{CamFromWorld(ViewAngles{10.1, 1.0, 0.5}), {690000.7, 5335000.2, 500.3}};
  found.focal_px = 1000.0 / 3.0;
  found.above_background = -0.7;
  found.energy = 1e-300;
  found.confidence = 0.1 + 0.2;
  found.goodness.buildings = {{3, 1.0 / 7.0, 2.0, -1.0, 100.0, 0.5, 0.0}};
  found.goodness.observed = 1.0 / 7.0;
  found.spread.position_covariance << 1.0, 0.1, 0.1, 2.0;
  found.spread.covariance(2, 3) = -1.0 / 3.0;
  found.protection = ProtectionLevel{1.5, 2.5};
  found.modes = {{*found.pose, 1e-300}};
  found.map.columns = 3;
  found.map.rows = 1;
  found.map.energies = {0.1f, std::numeric_limits<float>::quiet_NaN(), 1.0f / 3.0f};
  found.map.headings_deg = {0.0f, -0.0f, std::numeric_limits<float>::infinity()};
  found.evaluations = 123456789012345;
  found.times = {{"search", 0.123}};
  run.record = RecordOf(query, 7, found, 1.25);
  const std::string text = RunText(run);
  const BenchRun read = ReadRun(text, query, 4, "file");
  EXPECT_EQ(RunText(read), text);
  EXPECT_EQ(read.localization.pose->center_in_world, found.pose->center_in_world);
  EXPECT_EQ(read.localization.map.energies[2], 1.0f / 3.0f);
  EXPECT_TRUE(std::isnan(read.localization.map.energies[1]));
  EXPECT_EQ(read.record.error->translation_m, run.record.error->translation_m);
  EXPECT_EQ(read.record.seconds, 1.25);
  EXPECT_EQ(WithoutTimes(text).find("0.123"), std::string::npos);
  query.id = "another";
  EXPECT_THROW(ReadRun(text, query, 4, "file"), InputError);
  EXPECT_THROW(ReadRun("{}", query, 4, "file"), InputError);
}

}  // namespace
}  // namespace ridgeline
