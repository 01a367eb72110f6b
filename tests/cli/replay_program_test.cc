// SPDX-License-Identifier: Apache-2.0
// `ridgeline replay` and films of `ridgeline augment` on small made data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::json;

long Lines(const fs::path& file) {
  const std::string text = ReadFile(file);
  return std::count(text.begin(), text.end(), '\n');
}

// A walk of six frames, made once.
const fs::path& Walk() {
  static const fs::path walk = [] {
    const fs::path folder = Scratch("replay walk") / "walk";
    EXPECT_EQ(Ridgeline("synth --quiet --out " + Quoted(folder) +
                        " --walk 6 --size 240x180 --set town.blocks_east=2 --set "
                        "town.blocks_north=2")
                  .exit_code,
              0);
    return folder;
  }();
  return walk;
}

std::string WalkArguments() {
  return " --dataset " + Quoted(Walk() / "dataset.json") + " --sensors " +
         Quoted(Walk() / "sensors.csv") +
         " --set sensors.declination_deg=4 --set sensors.held=landscape";
}

TEST(ReplayLoeper, WritesItsFiguresAndTables) {
  const fs::path out = Scratch("replay loeper") / "r";
  const Outcome run = Ridgeline("replay loeper " + Quoted(Town() / "dataset.json") + " --out " +
                                Quoted(out) +
                                " --side 8,4 --heading 5,10 --iterations 4,12 --quiet");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const std::string html = ReadFile(out / "index.html");
  for (const char* text : {"Fig. 2", "Fig. 3", "Fig. 5", "Table 1", "3.85", "-2.23", "14.02"}) {
    EXPECT_THAT(html, HasSubstr(text));
  }
  // One picture, three methods, four boxes: 12 searches, two numbers of iterations.
  EXPECT_EQ(Lines(out / "results.csv"), 1 + 24);
  EXPECT_LE(Lines(out / "samples.csv"), 1 + 12 * 12);
  EXPECT_GE(Lines(out / "samples.csv"), 1 + 12 * 6);
  EXPECT_EQ(Lines(out / "table1.csv"), 1 + 1 + 24);
  for (const char* file : {"fig2.png", "fig3.png", "fig5_printed.png", "fig5_rotation_evidence.png"}) {
    EXPECT_TRUE(fs::exists(out / file)) << file;
  }
  // The same seed gives the same searches on any number of threads.
  const fs::path again = out.parent_path() / "again";
  ASSERT_EQ(Ridgeline("--threads 1 replay loeper " + Quoted(Town() / "dataset.json") + " --out " +
                      Quoted(again) +
                      " --side 8,4 --heading 5,10 --iterations 4,12 --quiet")
                .exit_code,
            0);
  EXPECT_EQ(ReadFile(out / "samples.csv"), ReadFile(again / "samples.csv"));
  EXPECT_EQ(Ridgeline("replay loeper " + Quoted(Town() / "dataset.json") + " --out " + Quoted(out) +
                      " --iterations 9,3")
                .exit_code,
            2);
}

TEST(ReplayAyadi, AllMethodsInOneRun) {
  const fs::path out = Scratch("replay ayadi") / "r";
  const Outcome run = Ridgeline("replay ayadi" + WalkArguments() + " --known-position --domain 1 --out " +
                                Quoted(out) + " --quiet");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const std::string html = ReadFile(out / "index.html");
  for (const char* text : {"Fig. 8", "Fig. 9", "Fig. 11", "Fig. 12", "Fig. 13", "Table 2", "49.62"}) {
    EXPECT_THAT(html, HasSubstr(text));
  }
  EXPECT_EQ(Lines(out / "frames.csv"), 1 + 2 * 6 * 4);
  EXPECT_EQ(Lines(out / "fig9.csv"), 1 + 25);
  EXPECT_TRUE(fs::exists(out / "stability.csv"));
}

TEST(AugmentFilm, IsAFilmWithFiguresOfItsSteadiness) {
  const Json dataset = Json::parse(ReadFile(Walk() / "dataset.json"));
  const std::vector<double> p = dataset["queries"][0]["truth"]["position"];
  const std::string place = std::to_string(p[0]) + "," + std::to_string(p[1] + 40.0);
  const fs::path folder = Scratch("augment film");
  const Outcome run = Ridgeline(
      "augment --json" + WalkArguments() + " --building " + Quoted(Walk() / "tower.obj") +
      " --place " + place + " --film " + Quoted(folder / "f.mp4") + " --stability " +
      Quoted(folder / "s.csv") + " --quiet 2>/dev/null");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const Json json = Json::parse(run.text);
  EXPECT_EQ(json["frames"], 6);
  EXPECT_EQ(json["with_pose"], 6);
  cv::VideoCapture film((folder / "f.mp4").string());
  ASSERT_TRUE(film.isOpened());
  EXPECT_EQ(film.get(cv::CAP_PROP_FRAME_WIDTH), 240);
  EXPECT_EQ(Lines(folder / "s.csv"), 3);
  // True poses make no error.
  const Outcome exact = Ridgeline("augment --json --dataset " + Quoted(Walk() / "dataset.json") +
                                  " --building " + Quoted(Walk() / "tower.obj") + " --place " + place +
                                  " --film " + Quoted(folder / "g.mp4") + " --quiet 2>/dev/null");
  ASSERT_EQ(exact.exit_code, 0) << exact.text;
  EXPECT_NEAR(Json::parse(exact.text)["drawn"]["mean_error_px"].get<double>(), 0.0, 1e-6);
}

// Skylines that this program found are as good as those of another.
TEST(SkylineByFile, GivesThePosesOfTheSkylinesGiven) {
  const fs::path folder = Scratch("skyline by file");
  const std::string options = " --set start=sensors --quiet";
  ASSERT_EQ(Ridgeline("skyline" + WalkArguments() + " --columns --out " + Quoted(folder / "a") + options)
                .exit_code % 3,
            0);
  const Outcome given = Ridgeline("skyline" + WalkArguments() + " --set extractor=file --skylines " +
                                  Quoted(folder / "a") + " --columns --out " + Quoted(folder / "b") +
                                  options);
  ASSERT_EQ(given.exit_code % 3, 0) << given.text;
  EXPECT_EQ(ReadFile(folder / "a/frame_0002_skyline.csv").substr(0, 400),
            ReadFile(folder / "b/frame_0002_skyline.csv").substr(0, 400));
  const Outcome none = Ridgeline("skyline" + WalkArguments() + " --set extractor=file --out " +
                                 Quoted(folder / "c") + options);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.text, HasSubstr("--skylines"));
}

// The instruments' priors, in place of the dataset's.
TEST(SensorPriors, OfLocalizeAndBench) {
  const std::string quick =
      " --set search.method=sampler --set search.sampler.name=random --set search.evaluations=8 --set "
      "search.refine=false --set score.name=line_energy --set confidence.abstain_below=0 --quiet";
  const fs::path folder = Scratch("sensor priors");
  const Outcome bench = Ridgeline(
      "bench " + Quoted(Walk() / "dataset.json") + " --sensors " + Quoted(Walk() / "sensors.csv") +
      " --set sensors.declination_deg=4 --set sensors.held=landscape --set "
      "sensors.attitude=gyroscope --no-report --out " +
      Quoted(folder / "b") + quick);
  ASSERT_EQ(bench.exit_code, 0) << bench.text;
  EXPECT_EQ(Lines(folder / "b/results.csv"), 7);
  const Outcome one = Ridgeline("localize --dataset " + Quoted(Walk() / "dataset.json") +
                                " --query frame_0003 --sensors " + Quoted(Walk() / "sensors.csv") +
                                " --set sensors.height_source=barometer --out " + Quoted(folder / "l") +
                                quick);
  ASSERT_EQ(one.exit_code % 3, 0) << one.text;
  EXPECT_THAT(ReadFile(folder / "l/pose.json"), HasSubstr("by instruments"));
  // Nor does this score judge its best pose in absolute terms.
  EXPECT_THAT(ReadFile(folder / "l/pose.json"), HasSubstr("compares poses with one another only"));
  // Options of instruments that are not there.
  EXPECT_EQ(Ridgeline("bench " + Quoted(Walk() / "dataset.json") +
                      " --protocol paper --set sensors.held=landscape" + quick)
                .exit_code,
            2);
}

}  // namespace
}  // namespace ridgeline::testing
