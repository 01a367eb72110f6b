// SPDX-License-Identifier: Apache-2.0
// Nothing that is finished is lost: kills, resumed work, shards and their merge give the bytes of
// undisturbed work, times apart.
#include "cli/kept_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/atomic_file.h"
#include "base/random.h"
#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::json;

// Work of one kind on the town of one picture.
struct Work {
  std::string command;  // without --out
  std::string report;   // words that make a report in {out}
};

std::string Dataset() { return Quoted(Town() / "dataset.json"); }

Work Bench() {
  return {"bench " + Dataset() +
              " --protocol known-tilt --seeds 5 --set search.map.spacing_m=4 --set "
              "search.map.heading_step_deg=6",
          ""};
}

Work Study() {
  return {"study " + Dataset() +
              " --perturb 3,3,0,6 --score evidence,line_energy --classes 4,8 --vary focal=0,5 "
              "--explore",
          "--report"};
}

std::string With(const Work& work, const fs::path& out, const std::string& more = "") {
  std::string words = work.command + " --quiet --out " + Quoted(out) + " " + more;
  if (!work.report.empty()) words += " --report " + Quoted(out / "report.html");
  return words;
}

class KeptResults : public ::testing::TestWithParam<Work (*)()> {
 protected:
  void SetUp() override {
    work_ = GetParam()();
    folder_ = Scratch(std::string("kept ") +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name());
    const Outcome outcome = Ridgeline(With(work_, folder_ / "whole"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  }

  Work work_;
  fs::path folder_;
};

TEST_P(KeptResults, KillsAtAnyMomentChangeNothing) {
  const fs::path out = folder_ / "killed";
  fs::create_directories(out);
  Random random(7, HashText(work_.command));
  constexpr int kKills = 5;
  for (int kill = 0; kill < kKills; ++kill) {
    StartAndKill(With(work_, out, "--resume"), 60 + static_cast<int>(random.Below(900)));
  }
  const Outcome outcome = Ridgeline(With(work_, out, "--resume"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(Differences(Timeless(folder_ / "whole"), Timeless(out)), "");
}

// What was kept stands for what was computed to the last byte, reports and times included.
TEST_P(KeptResults, ResumedFinishedWorkIsTheSameToTheByte) {
  const fs::path out = folder_ / "whole";
  const auto before = Bytes(out);
  ASSERT_TRUE(before.contains("report.html"));
  for (const auto& entry : fs::directory_iterator(out)) {
    if (entry.is_regular_file() && entry.path().filename() != "provenance.json") {
      fs::remove(entry.path());
    }
  }
  const Outcome outcome = Ridgeline(With(work_, out, "--resume"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(Differences(before, Bytes(out)), "");
}

TEST_P(KeptResults, ATornPieceIsMadeAgain) {
  const fs::path out = folder_ / "whole";
  const auto before = Timeless(out);
  const fs::path piece = fs::directory_iterator(out / "runs")->path();
  const std::string text = ReadFile(piece);
  WriteFileAtomically(piece, text.substr(0, text.size() / 2));
  const Outcome outcome = Ridgeline(With(work_, out, "--resume"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(Differences(before, Timeless(out)), "");
}

TEST_P(KeptResults, ShardsMergeToTheWhole) {
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const std::string name(shard, 1);
    const Outcome outcome =
        Ridgeline(With({work_.command, ""}, folder_ / name, std::string("--shard ") + shard));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  }
  const std::string parts = Quoted(folder_ / "1") + " " + Quoted(folder_ / "3");
  const fs::path merged = folder_ / "merged";
  const Outcome missing = Ridgeline("merge " + parts + " --out " + Quoted(merged));
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.text, HasSubstr("no folder of shard 2/3"));
  EXPECT_FALSE(fs::exists(merged));
  const Outcome outcome =
      Ridgeline("merge " + parts + " " + Quoted(folder_ / "2") + " --out " + Quoted(merged));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(Differences(Timeless(folder_ / "whole"), Timeless(merged)), "");
}

TEST_P(KeptResults, AnUnfinishedShardIsNamed) {
  const fs::path part = folder_ / "part";
  ASSERT_EQ(Ridgeline(With({work_.command, ""}, part, "--shard 1/1")).exit_code, 0);
  fs::remove(fs::directory_iterator(part / "runs")->path());
  const Outcome outcome =
      Ridgeline("merge " + Quoted(part) + " --out " + Quoted(folder_ / "merged"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("of shard 1/1, expected all of them: go on with --resume"));
}

TEST_P(KeptResults, OtherWorkIsNotMixedIn) {
  const fs::path out = folder_ / "whole";
  const auto before = Bytes(out);
  EXPECT_THAT(Ridgeline(With(work_, out)).text, HasSubstr("which holds results"));
  EXPECT_THAT(Ridgeline(With(work_, out, "--resume --seed 9")).text,
              HasSubstr("got results made with 1, expected 9 as asked for now"));
  EXPECT_THAT(Ridgeline(With(work_, out, "--resume --set projection.max_distance_m=300")).text,
              HasSubstr("options.projection.max_distance_m"));
  EXPECT_THAT(Ridgeline(With(work_, out, "--resume --shard 1/2")).text,
              HasSubstr("got results of the whole, expected shard 1/2"));
  EXPECT_EQ(Differences(before, Bytes(out)), "");
}

INSTANTIATE_TEST_SUITE_P(Works,
                         KeptResults,
                         ::testing::Values(&Bench, &Study),
                         [](const auto& param_info) {
                           return param_info.index == 0 ? "Bench" : "Study";
                         });

TEST(Keeping, NeedsAFolder) {
  for (const char* option : {"--resume", "--shard 1/2"}) {
    EXPECT_THAT(Ridgeline("bench " + Dataset() + " " + option).text, HasSubstr("no --out"));
    EXPECT_THAT(Ridgeline("study " + Dataset() + " " + option).text, HasSubstr("no --out"));
  }
  EXPECT_THAT(Ridgeline("bench " + Dataset() + " --shard 3/2 --out x").text,
              HasSubstr("a part of a number, such as 2/3"));
}

TEST(Verify, SaysWhatChanged) {
  const fs::path folder = Scratch("verify");
  fs::copy(Town(), folder / "town", fs::copy_options::recursive);
  const std::string dataset = Quoted(folder / "town/dataset.json");
  const fs::path out = folder / "results";
  const Outcome made = Ridgeline(
      "bench " + dataset +
      " --no-report --protocol known-tilt --seeds 2 --set search.map.spacing_m=4 --out " +
      Quoted(out));
  ASSERT_EQ(made.exit_code, 0) << made.text;
  const Outcome same = Ridgeline("verify " + Quoted(out) + " --rerun 2");
  EXPECT_EQ(same.exit_code, 0) << same.text;
  EXPECT_THAT(same.text, HasSubstr("as the results say"));
  std::string table = ReadFile(out / "results.csv");
  WriteFileAtomically(out / "results.csv", table + "x");
  EXPECT_THAT(Ridgeline("verify " + Quoted(out)).text,
              HasSubstr("results.csv is not what runs/ gives"));
  WriteFileAtomically(folder / "town/city.gml", ReadFile(folder / "town/city.gml") + "\n");
  const Outcome changed = Ridgeline("verify " + Quoted(out));
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_THAT(changed.text, HasSubstr("city.gml has SHA-256"));
}

TEST(Compare, AnotherSystemsPosesTakePart) {
  const fs::path folder = Scratch("compare");
  const std::string search = "bench " + Dataset() +
                             " --no-report --protocol known-tilt --seeds 2 --set "
                             "search.map.spacing_m=4 --out ";
  ASSERT_EQ(Ridgeline(search + Quoted(folder / "ours")).exit_code, 0);
  const Json query = Json::parse(ReadFile(Town() / "dataset.json"))["queries"][0];
  const Json truth = query["truth"];
  std::string row = query["id"].get<std::string>();
  for (const Json& value : truth["position"]) row += "," + value.dump();
  for (const Json& value : truth["cam_from_world_wxyz"]) row += "," + value.dump();
  WriteFileAtomically(folder / "poses.csv", "query,e,n,h,qw,qx,qy,qz\n" + row + "\n");
  const Outcome scored = Ridgeline("bench " + Dataset() + " --score-only " +
                                   Quoted(folder / "poses.csv") + " --report " +
                                   Quoted(folder / "theirs.html") + " --out " +
                                   Quoted(folder / "theirs"));
  ASSERT_EQ(scored.exit_code, 0) << scored.text;
  EXPECT_TRUE(fs::exists(folder / "theirs.html"));
  // A real energy at the truth; no confidence and no time, which nobody said.
  const std::string table = ReadFile(folder / "theirs/results.csv");
  const std::string line = table.substr(table.find('\n') + 1);
  EXPECT_THAT(line, ::testing::StartsWith("street_000,1,ok,0."));
  EXPECT_THAT(line, HasSubstr(",,"));
  EXPECT_THAT(line, ::testing::EndsWith(",,\n"));
  const Json summary = Json::parse(ReadFile(folder / "theirs/summary.json"));
  EXPECT_TRUE(summary["seconds_per_query"].is_null());
  EXPECT_TRUE(summary["confidence_0.9"].is_null());
  EXPECT_EQ(summary["recall"]["0.5m_1deg"], 1.0);

  const fs::path out = folder / "comparison";
  const Outcome compared = Ridgeline("compare " + Quoted(folder / "theirs") + " " +
                                     Quoted(folder / "ours") + " --out " + Quoted(out));
  ASSERT_EQ(compared.exit_code, 0) << compared.text;
  const Json comparison = Json::parse(ReadFile(out / "compare.json"))[0];
  EXPECT_EQ(comparison["pairs"], 2);  // the one pose beside both seeds
  EXPECT_EQ(comparison["unpaired"].size(), 0);
  EXPECT_EQ(comparison["figures"][0]["of_first"], 1.0);
  const std::string pairs = ReadFile(out / "pairs.csv");
  EXPECT_EQ(std::count(pairs.begin(), pairs.end(), '\n'), 3);
  EXPECT_THAT(ReadFile(out / "compare.html"), HasSubstr("against theirs"));
}

}  // namespace
}  // namespace ridgeline::testing
