// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/atomic_file.h"
#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

// A coarse search: what is found does not matter here.
const char* const kCoarse = " --set search.map.spacing_m=4 --set search.map.heading_step_deg=6 ";

std::string Bench(const std::string& arguments) {
  return "bench " + Quoted(Town() / "dataset.json") + kCoarse + arguments;
}

TEST(BenchProgram, EveryTableNamesItsProtocol) {
  const fs::path out = Scratch("bench protocol") / "out";
  const Outcome outcome = Ridgeline(Bench("--protocol known-tilt --out " + Quoted(out)));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("protocol known-tilt: position ±10 m, true height"));
  const Json summary = Json::parse(ReadFile(out / "summary.json"));
  EXPECT_EQ(summary["protocol"], "known-tilt");
  EXPECT_TRUE(summary["recall"].is_object());
  EXPECT_TRUE(summary["egenioussbench"].is_object() || summary["abstained"] == 1.0);
  EXPECT_THAT(ReadFile(out / "report.html"), HasSubstr("known-tilt"));
}

TEST(BenchProgram, NoRightAnswerNoRecall) {
  const fs::path out = Scratch("bench outside") / "out";
  for (const std::string& protocol :
       {std::string("outside"), "elsewhere --world " + Quoted(Town() / "dataset.json")}) {
    const Outcome outcome =
        Ridgeline(Bench("--no-report --protocol " + protocol + " --out " +
                        Quoted(out / protocol.substr(0, 7))));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("recall is not defined"));
    const Json summary =
        Json::parse(ReadFile(out / protocol.substr(0, 7) / "summary.json"));
    EXPECT_TRUE(summary["recall"].is_null());
    const Json wrong = summary["confidence_0.9"]["wrong"];
    EXPECT_GE(wrong["share"], 0.0);
    EXPECT_LT(wrong["ci95"][0], wrong["ci95"][1]);
    EXPECT_FALSE(fs::exists(out / protocol.substr(0, 7) / "report.html"));
  }
}

TEST(BenchProgram, ElsewhereNeedsAPlaceAndTheOthersHaveNone) {
  EXPECT_THAT(Ridgeline(Bench("--protocol elsewhere")).text,
              HasSubstr("--world: got nothing, expected the dataset.json of the place"));
  EXPECT_THAT(Ridgeline(Bench("--protocol phone --world x.json")).text,
              HasSubstr("--world: got x.json, expected --protocol elsewhere"));
  EXPECT_THAT(Ridgeline(Bench("--protocol fone")).text, HasSubstr("nearest: \"phone\""));
}

TEST(StudyProgram, HasNoUseForBoxesWithoutTheTruth) {
  EXPECT_THAT(Ridgeline("study " + Quoted(Town() / "dataset.json") + " --protocol outside").text,
              HasSubstr("--protocol: got \"outside\", expected one whose box holds the truth"));
}

TEST(EgenioussProgram, FromDownloadToSubmission) {
  const fs::path folder = Scratch("egeniouss");
  const Outcome made = Ridgeline(
      "synth --quiet --layout egenioussbench --queries 3 --size 320x240 --set "
      "town.blocks_east=2 --set town.blocks_north=2 --out " +
      Quoted(folder / "bench"));
  ASSERT_EQ(made.exit_code, 0) << made.text;
  const fs::path dataset = folder / "val.json";
  const Outcome read =
      Ridgeline("convert " + Quoted(folder / "bench/query_images/val") + " --dtm " +
                Quoted(folder / "bench/dtm.tif") + " --out " + Quoted(dataset));
  ASSERT_EQ(read.exit_code, 0) << read.text;
  const Outcome run =
      Ridgeline("bench " + Quoted(dataset) + kCoarse +
                "--no-report --set search.height_m=1 --out " + Quoted(folder / "results"));
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const Json summary = Json::parse(ReadFile(folder / "results/summary.json"));
  const fs::path submission = folder / "submission.csv";
  const Outcome written =
      Ridgeline("convert " + Quoted(dataset) + " " + Quoted(folder / "results/results.csv") +
                " --to egeniouss --out " + Quoted(submission));
  const int answered =
      summary["egenioussbench"].is_null() ? 0 : summary["egenioussbench"]["poses"].get<int>();
  if (answered == 0) {
    EXPECT_THAT(written.text, HasSubstr("no pose"));
    return;
  }
  ASSERT_EQ(written.exit_code, 0) << written.text;
  const std::string poses = ReadFile(submission);
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 1 + answered);
  EXPECT_THAT(poses, HasSubstr("\nportrait_00"));
}

}  // namespace
}  // namespace ridgeline::testing
