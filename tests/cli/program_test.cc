// SPDX-License-Identifier: Apache-2.0
// The program as a user meets it: run as a process, by its exit codes and its words.
#include "cli/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "camera/pose.h"
#include "city/crs.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Program, WithoutACommandShowsItsHelp) {
  const Outcome outcome = Ridgeline("");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.text, Ridgeline("--help").text);
}

TEST(Program, MistypedCommandNamesTheNearest) {
  const Outcome outcome = Ridgeline("bensh");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("bench"));
}

TEST(Program, MistypedOptionNamesTheNearest) {
  const Outcome outcome = Ridgeline("synth --out x --sede 3");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.text,
            "error: no option \"--sede\"; did you mean \"--seed\"?\nSee ridgeline synth --help\n");
}

// The parser of arguments would make both of them the largest number there is.
TEST(Program, SeedsBelowZeroAndBeyondAreRefused) {
  for (const char* command : {"localize", "track", "study", "replay loeper"}) {
    for (const char* seed : {"-1", "99999999999999999999", "1.5"}) {
      const Outcome outcome = Ridgeline(std::string(command) + " x --seed " + seed);
      EXPECT_EQ(outcome.exit_code, 2) << command;
      EXPECT_THAT(outcome.text, HasSubstr("expected a whole number from 0 on")) << command << seed;
    }
  }
}

// A file's words are shown, not obeyed.
TEST(Program, FilesDoNotSpeakToTheTerminal) {
  const fs::path folder = Scratch("escape");
  std::ofstream(folder / "p.json")
      << R"({"type":"CityJSON","version":"2.0","vertices":[],)"
         R"("CityObjects":{"\u001b[31m":{"type":"Building"}}})";
  const std::string text = Ridgeline("info " + Quoted(folder / "p.json")).text;
  EXPECT_THAT(text,
              AllOf(HasSubstr("buildings without geometry dropped ( [31m)"), Not(HasSubstr("\x1b"))));
}

TEST(Program, HelpOfEveryCommandFitsAScreenAndHasAnExample) {
  std::istringstream help(Ridgeline("--help").text);
  std::string line;
  bool in_commands = false;
  int commands = 0;
  while (std::getline(help, line)) {
    if (line == "Subcommands:") {
      in_commands = true;
      continue;
    }
    if (!in_commands || line.size() < 3 || line[2] == ' ') continue;
    if (line.empty() || line[0] != ' ') break;
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    const Outcome outcome = Ridgeline(name + " --help");
    EXPECT_EQ(outcome.exit_code, 0) << name;
    const std::size_t example = outcome.text.find("Example:\n");
    ASSERT_NE(example, std::string::npos) << name;
    EXPECT_THAT(outcome.text.substr(example), HasSubstr("ridgeline " + name)) << name;
    EXPECT_LE(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 50) << name;
    ++commands;
  }
  EXPECT_GE(commands, 8);
}

TEST(Program, JsonIsJsonAndNothingElse) {
  const auto json = nlohmann::json::parse(Ridgeline("version --json").text, nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_TRUE(json.contains("ridgeline"));
}

TEST(Program, NamesItsLibrariesWithVersionsAndLicences) {
  const auto json =
      nlohmann::json::parse(Ridgeline("version --verbose --json").text, nullptr, false);
  ASSERT_TRUE(json.contains("libraries"));
  std::size_t with_version = 0;
  for (const auto& library : json["libraries"]) {
    EXPECT_NE(library["licence"], "") << library;
    if (library["version"] != "") ++with_version;
  }
  EXPECT_GE(with_version, 11u);
  EXPECT_THAT(Ridgeline("version --verbose").text, HasSubstr("gdal 3"));
}

TEST(Program, WritesNoColoursIntoAPipe) {
  EXPECT_THAT(Ridgeline("bensh").text, Not(HasSubstr("\033[")));
}

TEST(Synth, MakesADatasetAndRefusesToOverwriteIt) {
  EXPECT_TRUE(fs::exists(Town() / "dataset.json"));
  const Outcome again = Ridgeline("synth --out " + Quoted(Town()));
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.text, AllOf(HasSubstr("exists"), HasSubstr("--overwrite")));
}

TEST(Synth, NamesTheNearestKey) {
  const Outcome outcome = Ridgeline("synth --out x --set town.block=70");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("town.block_m"));
}

TEST(Synth, RefusesSizesThatAreNone) {
  EXPECT_THAT(Ridgeline("synth --out x --size 12by9").text, HasSubstr("WIDTHxHEIGHT"));
}

TEST(Synth, LeavesNothingBehindWhenInterrupted) {
  const fs::path folder = Scratch("interrupt");
  const std::string out = (folder / "town").string();
  const pid_t child = ::fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(98);
    ::execl(RIDGELINE_PROGRAM,
            "ridgeline",
            "synth",
            "--queries",
            "200",
            "--out",
            out.c_str(),
            static_cast<char*>(nullptr));
    ::_exit(99);
  }
  // Until its temporary folder is there.
  for (int i = 0; i < 200 && fs::is_empty(folder); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_FALSE(fs::is_empty(folder));
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Render, WritesWhatWasAskedFor) {
  const fs::path folder = Scratch("render");
  const Outcome outcome = Ridgeline("render --json --dataset " + Quoted(Town() / "dataset.json") +
                                    " --query street_000 --out " + Quoted(folder / "edges.svg") +
                                    " --depth " + Quoted(folder / "depth.png"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(fs::exists(folder / "edges.svg"));
  EXPECT_TRUE(fs::exists(folder / "depth.png"));
}

TEST(Render, MistypedQueryNamesTheNearest) {
  const Outcome outcome = Ridgeline("render --dataset " + Quoted(Town() / "dataset.json") +
                                    " --query stret_000 --out x.png");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("street_000"));
}

// A dataset in the next zone than its model: the same lines at the same places.
TEST(Render, TakesADatasetInAnotherSystemThanItsModel) {
  const fs::path folder = Scratch("render crs");
  auto dataset = nlohmann::json::parse(std::ifstream(Town() / "dataset.json"));
  auto& query = dataset["queries"][0];
  const std::vector<double> p = query["truth"]["position"];
  const std::vector<double> q = query["truth"]["cam_from_world_wxyz"];
  const Crs zone32{25832, 0};
  const Crs zone33{25833, 0};
  const Eigen::Vector2d place = LatitudeLongitude(zone32, {p[0], p[1]}).value();
  const Eigen::Vector2d there = EastNorth(zone33, place.x(), place.y()).value();
  ViewAngles angles = ViewAnglesOf(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  angles.heading_deg += MeridianConvergenceDeg(zone32, {p[0], p[1]}).value() -
                        MeridianConvergenceDeg(zone33, there).value();
  const Eigen::Quaterniond turned = CamFromWorld(angles);
  query["truth"] = {{"position", {there.x(), there.y(), p[2]}},
                    {"cam_from_world_wxyz", {turned.w(), turned.x(), turned.y(), turned.z()}}};
  query["image"] = (Town() / query["image"]).string();
  dataset["model"] = {(Town() / "city.gml").string()};
  dataset["crs"] = "EPSG:25833";
  dataset.erase("dtm");
  std::ofstream(folder / "dataset.json") << dataset;
  const std::string rest = " --query street_000 --depth ";
  ASSERT_EQ(Ridgeline("render --dataset " + Quoted(Town() / "dataset.json") + rest +
                      Quoted(folder / "here.png"))
                .exit_code,
            0);
  ASSERT_EQ(Ridgeline("render --dataset " + Quoted(folder / "dataset.json") + rest +
                      Quoted(folder / "there.png"))
                .exit_code,
            0);
  const cv::Mat here = cv::imread((folder / "here.png").string(), cv::IMREAD_UNCHANGED);
  const cv::Mat other = cv::imread((folder / "there.png").string(), cv::IMREAD_UNCHANGED);
  cv::Mat difference;
  cv::absdiff(here, other, difference);
  // Buildings alike: the scales of the zones differ by 1 in 1000, 3 cm at 30 m. The ground is not
  // drawn without a terrain model, so that the upper half is compared.
  const cv::Mat upper = difference.rowRange(0, difference.rows / 3);
  EXPECT_LT(cv::countNonZero(upper > 30), upper.total() / 50);
  EXPECT_GT(cv::countNonZero(other.rowRange(0, other.rows / 2)), 100);
}

TEST(Render, SaysWhatAPoseIs) {
  const Outcome outcome = Ridgeline("render --dataset " + Quoted(Town() / "dataset.json") +
                                    " --query street_000 --pose 1,2,3 --out x.png");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("east,north,height,heading,pitch,roll"));
}

TEST(Skyline, ReportsFramesWithoutAModelToo) {
  const fs::path folder = Scratch("skyline report");
  const Outcome outcome =
      Ridgeline("skyline --quiet --frames " + Quoted(Town() / "images") + " --out " +
                Quoted(folder / "out") + " --report " + Quoted(folder / "skyline.html"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_GT(fs::file_size(folder / "skyline.html"), 10000u);
  // Folders are made: another one, and that of the frames, which comes last.
  for (const fs::path& report : {folder / "new" / "x.html", folder / "frames" / "x.html"}) {
    fs::remove_all(folder / "frames");
    const Outcome made = Ridgeline("skyline --quiet --frames " + Quoted(Town() / "images") +
                                   " --out " + Quoted(folder / "frames") + " --report " +
                                   Quoted(report));
    EXPECT_EQ(made.exit_code, 0) << made.text;
    EXPECT_TRUE(fs::exists(report)) << report;
  }
  std::ofstream(folder / "file") << "no folder";
  EXPECT_EQ(Ridgeline("skyline --frames " + Quoted(Town() / "images") + " --out " +
                      Quoted(folder / "other") + " --report " + Quoted(folder / "file" / "x.html"))
                .exit_code,
            2);
  EXPECT_FALSE(fs::exists(folder / "other"));
}

// A study of the town's picture on a small box.
std::string StudyOfTown(const std::string& more) {
  return "study " + Quoted(Town() / "dataset.json") +
         " --perturb 2,2,0,4 --classes 5,10 --set search.map.heading_step_deg=2 " + more;
}

TEST(Study, WritesTablesPicturesMapsAndAReport) {
  const fs::path folder = Scratch("study");
  const Outcome outcome = Ridgeline(
      StudyOfTown("--quiet --json --score skyline_l1,sky --explore --vary focal=0,5 --out " +
                  Quoted(folder / "out") + " --report " + Quoted(folder / "study.html")));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const auto json = nlohmann::json::parse(outcome.text, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << outcome.text;
  EXPECT_EQ(json["scores"].size(), 2u);
  EXPECT_EQ(json["scores"][1]["score"], "sky");
  for (const char* file : {"summary.csv",
                           "figures.csv",
                           "headings.csv",
                           "profiles.csv",
                           "sampled.csv",
                           "sensitivity.csv",
                           "sensitivity_summary.csv",
                           "sensitivity_focal.png",
                           "score_against_error_sky.png",
                           "score_against_error_sky.svg",
                           "maps/street_000_sky.csv",
                           "maps/street_000_sky.png",
                           "maps/street_000_skyline_l1.tif",
                           "explored/street_000_skyline_l1.png"}) {
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  }
  EXPECT_GT(fs::file_size(folder / "study.html"), 10000u);
}

TEST(Study, NamesTheNearestScoreAndCircumstance) {
  const Outcome score = Ridgeline(StudyOfTown("--score skylin_l1"));
  EXPECT_EQ(score.exit_code, 2);
  EXPECT_THAT(score.text, AllOf(HasSubstr("--score"), HasSubstr("skyline_l1")));
  const Outcome vary = Ridgeline(StudyOfTown("--vary focul"));
  EXPECT_EQ(vary.exit_code, 2);
  EXPECT_THAT(vary.text, AllOf(HasSubstr("--vary"), HasSubstr("focal")));
}

TEST(Study, NeedsATruthAndAPlaceToWrite) {
  const fs::path folder = Scratch("study bad");
  auto dataset = nlohmann::json::parse(std::ifstream(Town() / "dataset.json"));
  for (auto& query : dataset["queries"]) query.erase("truth");
  std::ofstream(Town() / "no_truth.json") << dataset;
  const Outcome truth = Ridgeline("study " + Quoted(Town() / "no_truth.json"));
  EXPECT_EQ(truth.exit_code, 2);
  EXPECT_THAT(truth.text, HasSubstr("no query with a truth"));
  std::ofstream(folder / "file") << "not a folder";
  const Outcome out = Ridgeline(StudyOfTown("--out " + Quoted(folder / "file")));
  EXPECT_EQ(out.exit_code, 2);
  EXPECT_THAT(out.text, HasSubstr("--out"));
  const Outcome report = Ridgeline(StudyOfTown("--report " + Quoted(folder / "file" / "x.html")));
  EXPECT_EQ(report.exit_code, 2);
}

TEST(Completion, ShellsAcceptTheScripts) {
  const fs::path folder = Scratch("completion");
  EXPECT_EQ(Ridgeline("completion bash > " + Quoted(folder / "bash")).exit_code, 0);
  EXPECT_EQ(std::system(("bash -n " + Quoted(folder / "bash")).c_str()), 0);
  const std::string ask =
      "bash -c 'source \"$0\"; COMP_WORDS=(ridgeline render --at \"\"); "
      "COMP_CWORD=3; _ridgeline; echo ${COMPREPLY[@]}' " +
      Quoted(folder / "bash") + " > " + Quoted(folder / "reply");
  EXPECT_EQ(std::system(ask.c_str()), 0);
  std::ifstream reply(folder / "reply");
  std::string words;
  std::getline(reply, words);
  EXPECT_THAT(words, AllOf(HasSubstr("truth"), HasSubstr("prior")));
}

TEST(Completion, WritesAManPagePerCommand) {
  const fs::path folder = Scratch("man");
  EXPECT_EQ(Ridgeline("completion man --out " + Quoted(folder)).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "ridgeline.1"));
  EXPECT_TRUE(fs::exists(folder / "ridgeline-synth.1"));
}

TEST(Doctor, ChecksTheSetUp) {
  const Outcome outcome = Ridgeline("doctor --quick --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_FALSE(nlohmann::json::parse(outcome.text, nullptr, false).is_discarded());
}

}  // namespace
}  // namespace ridgeline::testing
