// SPDX-License-Identifier: Apache-2.0
// No option is passed over in silence: each of every command changes what comes out, or is refused.
// A new option needs a line here.
#include "base/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/commands.h"
#include "cli/idle_options.h"
#include "cli/in_process.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::json;

// A search of a few poses.
const std::string kQuick =
    " --set search.method=sampler --set search.sampler.name=random --set search.evaluations=8"
    " --set search.refine=false --set score.name=line_energy --set confidence.abstain_below=0";
const std::string kOneBlock = " --set town.blocks_east=1 --set town.blocks_north=1";

// Command lines by words; {in}, {out} and {town} are folders, {place}, {here} and {turned} where
// the first picture of the town looks, was taken, and does not look.
const std::map<std::string, std::string>& Bases() {
  static const std::map<std::string, std::string> bases = {
      {"localize",
       "localize {in}/photo.png --model {town}/city.gml --dtm {town}/dtm.tif --camera "
       "{in}/camera.json --prior {in}/prior.json --out {out}/r" +
           kQuick},
      {"bench", "bench {town}/dataset.json --out {out}/r" + kQuick},
      {"study",
       "study {town}/dataset.json --score line_energy --perturb 1,1,0,2 --classes 4 --out {out}/r"},
      {"merge", "merge {results}/part1 {results}/part2 --out {out}/r"},
      {"compare", "compare {results}/a {results}/b --out {out}/r"},
      {"verify", "verify {results}/a"},
      {"index", "index {town}/city.gml --out {out}/c.gpkg"},
      {"info", "info {town}/city.gml"},
      {"convert", "convert {town}/dataset.json --out {out}/x.kml"},
      {"render", "render --dataset {town}/dataset.json --query street_000 --out {out}/e.svg"},
      {"skyline", "skyline --dataset {town}/dataset.json --out {out}/f"},
      {"track", "track {town}/dataset.json --out {out}/f --set track.start_m=6"},
      {"augment",
       "augment --dataset {town}/dataset.json --query street_000 --building {in}/box.obj --place "
       "{place} --light-azimuth 60 --out {out}/a.png"},
      {"calibrate", "calibrate {in}/boards --board 5x4 --out {out}/c.json"},
      {"synth",
       "synth --out {out}/t --size 64x64 --queries 0 --tilted 0 --portrait 0 --drone 0" +
           kOneBlock},
      {"options", "options"},
      {"completion", "completion bash"}};
  return bases;
}

// The words that are added to the base for an option, or "-words" that are taken away.
const std::map<std::string, std::map<std::string, std::string>>& Cases() {
  static const std::map<std::string, std::map<std::string, std::string>> cases = {
      {"localize",
       {{"image", "--=localize {in}/flipped.png"},
        {"--dataset", "--dataset {town}/dataset.json"},
        {"--query", "--query street_000"},
        {"--model", "--model {in}/none.gml"},
        {"--dtm", "--dtm {in}/none.tif"},
        {"--crs", "--crs EPSG:25833"},
        {"--camera", "--camera {in}/longer.json"},
        {"--prior", "--prior {in}/moved.json"},
        {"--declination", "--declination 3"},
        {"--lines", "--lines {in}/lines.txt"},
        {"--sensors", "--sensors {in}/none.csv"},
        {"--out", "--out {out}/other"},
        {"--report", "--report {out}/r.html"},
        {"--seed", "--seed 2"},
        {"--config", "--config {in}/config.json"},
        {"--set", "--set search.heading_deg=5"}}},
      {"bench",
       {{"dataset", "--=bench {in}/none.json"},
        {"--out", "--out {out}/other"},
        {"--perturb", "--perturb 1,1,0,2"},
        {"--protocol", "--protocol known-tilt"},
        {"--world", "--world {town}/dataset.json"},
        {"--sensors", "--sensors {in}/none.csv"},
        {"--no-report", "--no-report"},
        {"--query", "--query none"},
        {"--set-name", "--set-name none"},
        {"--shard", "--shard 2/2"},
        {"--seed", "--seed 2"},
        {"--seeds", "--seeds 2"},
        {"--score-only", "--score-only {in}/poses.csv"},
        {"--report", "--report {out}/b.html"},
        {"--map", "--map {out}/m.geojson"},
        {"--overlays", "--overlays {out}/overlays"},
        {"--config", "--config {in}/config.json"},
        {"--set", "--set search.heading_deg=5"}}},
      {"study",
       {{"dataset", "--=study {in}/none.json"},
        {"--score", "--score skyline_l1"},
        {"--query", "--query none"},
        {"--set-name", "--set-name none"},
        {"--shard", "--shard 2/2"},
        {"--out", "--out {out}/other"},
        {"--report", "--report {out}/s.html"},
        {"--perturb", "--perturb 1,1,0,4"},
        {"--protocol", "--protocol known-tilt"},
        {"--seed", "--seed 2"},
        {"--classes", "--classes 5"},
        {"--vary", "--vary focal=0,5"},
        {"--explore", "--explore"},
        {"--config", "--config {in}/config.json"},
        {"--set", "--set search.map.heading_step_deg=2"}}},
      {"merge",
       {{"folders", "--=merge {results}/a {results}/part2"},
        {"--out", "--out {out}/other"},
        {"--report", "--report {out}/m.html"},
        {"--no-report", "--no-report"}}},
      {"compare",
       {{"results", "--=compare {results}/b {results}/a"},
        {"--name", "--name one,two"},
        {"--out", "--out {out}/other"},
        {"--dataset", "--dataset {in}/none.json"}}},
      {"verify", {{"folder", "--=verify {in}"}, {"--rerun", "--rerun 1"}}},
      {"index",
       {{"tiles", "--=index {in}/none.gml"},
        {"--out", "--out {out}/other.gpkg"},
        {"--model-crs", "--model-crs nonsense"},
        {"--project-to", "--project-to nonsense"},
        {"--height-offset", "--height-offset 1e6"},
        {"--lod", "--lod 9"}}},
      {"info",
       {{"files", "{town}/dtm.tif"},
        {"--model-crs", "--model-crs EPSG:25833"},
        {"--project-to", "--project-to EPSG:25833"},
        {"--height-offset", "--height-offset 1"},
        {"--lod", "--lod 1"}}},
      {"convert",
       {{"inputs", "{in}/poses.csv"},
        {"--out", "--out {out}/other.kml"},
        {"--from", "--from opk"},
        {"--to", "--to geojson"},
        {"--crs", "--crs EPSG:25833"},
        {"--origin", "--origin 1,2,3"},
        {"--camera", "--camera {in}/longer.json"},
        {"--images", "--images {in}"},
        {"--model", "--model {town}/city.gml"},
        {"--dtm", "--dtm {town}/dtm.tif"},
        {"--name", "--name other"}}},
      {"render",
       {{"--dataset", "--dataset {in}/none.json"},
        {"--query", "--query none"},
        {"--at", "--at prior"},
        {"--model", "--model {in}/none.gml"},
        {"--dtm", "--dtm {in}/none.tif"},
        {"--crs", "--crs EPSG:25833"},
        {"--image", "--image {in}/flipped.png"},
        {"--camera", "--camera {in}/longer.json"},
        {"--pose", "--pose {here},{turned},0,0"},
        {"--out", "--out {out}/other.svg"},
        {"--shaded", "--shaded {out}/shaded.png"},
        {"--depth", "--depth {out}/depth.png"},
        {"--ids", "--ids {out}/ids.png"},
        {"--no-legend", "--no-legend"}}},
      {"skyline",
       {{"--dataset", "--dataset {in}/none.json"},
        {"--frames", "--frames {town}/images"},
        {"--model", "--model {in}/none.gml"},
        {"--crs", "--crs EPSG:25833"},
        {"--dtm", "--dtm {in}/none.tif"},
        {"--camera", "--camera {in}/longer.json"},
        {"--sensors", "--sensors {in}/none.csv"},
        {"--out", "--out {out}/other"},
        {"--video", "--video v.mp4"},
        {"--report", "--report {out}/k.html"},
        {"--overlays", "--overlays"},
        {"--columns", "--columns"},
        {"--skylines", "--skylines {in}"},
        {"--config", "--config {in}/none.json"},
        {"--set", "--set match.rounds=none"}}},
      {"track",
       {{"input", "--=track {in}/none.json"},
        {"--odometry", "--odometry {in}/none.csv"},
        {"--sensors", "--sensors {in}/none.csv"},
        {"--prior", "--prior {in}/moved.json"},
        {"--model", "--model {in}/none.gml"},
        {"--dtm", "--dtm {in}/none.tif"},
        {"--crs", "--crs EPSG:25833"},
        {"--camera", "--camera {in}/longer.json"},
        {"--out", "--out {out}/other"},
        {"--report", "--report {out}/k.html"},
        {"--film", "--film {out}/f.mp4"},
        {"--nmea", "--nmea {out}/n.txt"},
        {"--json-lines", "--json-lines {out}/j.txt"},
        {"--follow", "--follow"},
        {"--idle", "--follow --idle 0"},
        {"--seed", "--seed 2"},
        {"--config", "--config {in}/none.json"},
        {"--set", "--set track.start_m=3"}}},
      {"augment",
       {{"--dataset", "--dataset {in}/none.json"},
        {"--query", "--query none"},
        {"--at", "--at prior"},
        {"--model", "--model {in}/none.gml"},
        {"--dtm", "--dtm {in}/none.tif"},
        {"--crs", "--crs EPSG:25833"},
        {"--image", "--image {in}/flipped.png"},
        {"--camera", "--camera {in}/longer.json"},
        {"--pose", "--pose {here},{turned},0,0"},
        {"--building", "--building {in}/none.obj"},
        {"--place", "--place 0"},
        {"--heading", "--heading 30"},
        {"--scale", "--scale 0.5"},
        {"--light-azimuth", "--light-azimuth 90"},
        {"--light-elevation", "--light-elevation 80"},
        {"--opacity", "--opacity 0.5"},
        {"--y-up", "--y-up"},
        {"--sun", "--sun noon"},
        {"--shadows", "--shadows --light-elevation 12"},
        {"--samples", "--samples 4"},
        {"--reveal", "--reveal 2"},
        {"--foreground", "--foreground {in}/none.png"},
        {"--impact", "--impact {out}/impact.csv"},
        {"--film", "--film {out}/film.mp4"},
        {"--frames", "--frames {town}/images"},
        {"--poses", "--poses {in}/none.csv"},
        {"--sensors", "--sensors {in}/none.csv"},
        {"--stability", "--stability {out}/stability.csv"},
        {"--set", "--set sensors.held=portrait"},
        {"--out", "--out {out}/other.png"}}},
      {"calibrate",
       {{"frames", "--=calibrate {town}/images"},
        {"--board", "--board 6x5"},
        {"--lens", "--lens pinhole"},
        {"--views", "--views 5"},
        {"--every", "--every 2"},
        {"--out", "--out {out}/other.json"}}},
      {"synth",
       {{"--out", "--out {out}/other"},
        {"--seed", "--seed 2"},
        {"--queries", "--queries 1"},
        {"--tilted", "--tilted 1"},
        {"--portrait", "--portrait 1"},
        {"--drone", "--drone 1"},
        {"--walk", "--walk 2"},
        {"--drive", "--drive 2"},
        {"--flight", "--flight 2"},
        {"--layout", "--layout egenioussbench"},
        {"--size", "--size 12by9"},
        {"--buildings", "--buildings 40"},
        {"--set", "--set town.block_m=70"},
        {"--overwrite", "--overwrite --out {in}"}}},
      {"options",
       {{"--config", "--config {in}/config.json"},
        {"--set", "--set search.heading_deg=5"},
        {"--ranges", "--ranges"}}},
      {"completion", {{"what", "--=completion zsh"}, {"--out", "--out {out}"}}}};
  return cases;
}

// Options that do not touch results: by contract the same on any number of threads, or about what
// is said of the work; tested as such elsewhere (program_test.cc).
const std::set<std::string> kNotOfResults = {
    "--help", "--help-all", "--version", "--quiet", "--json", "--threads", "doctor --quick",
    "version --verbose", "bench --resume", "study --resume"};

// Results of bench: the same with two searches, and one of them in two parts; made once.
const fs::path& Results() {
  static const fs::path results = [] {
    const fs::path folder = Scratch("options results");
    const std::string bench =
        "bench --no-report " + Quoted(Town() / "dataset.json") + " --seeds 2" + kQuick + " --out ";
    Ridgeline(bench + Quoted(folder / "a"));
    Ridgeline(bench + Quoted(folder / "b") + " --set search.evaluations=16");
    Ridgeline(bench + Quoted(folder / "part1") + " --shard 1/2");
    Ridgeline(bench + Quoted(folder / "part2") + " --shard 2/2");
    return folder;
  }();
  return results;
}

class Options : public ::testing::Test {
 protected:
  Options() {
    const Json dataset = Json::parse(ReadFile(Town() / "dataset.json"));
    const Json query = dataset["queries"][0];
    const std::vector<double> p = query["truth"]["position"];
    const double heading = query["prior"]["heading_deg"].get<double>() * std::numbers::pi / 180.0;
    place_ = std::to_string(p[0] + 12.0 * std::sin(heading)) + "," +
             std::to_string(p[1] + 12.0 * std::cos(heading));
    here_ = std::to_string(p[0]) + "," + std::to_string(p[1]) + "," + std::to_string(p[2]);
    turned_ = std::to_string(query["prior"]["heading_deg"].get<double>() + 10.0);
    const cv::Mat photo = cv::imread((Town() / query["image"]).string());
    cv::Mat flipped;
    cv::flip(photo, flipped, 1);
    cv::imwrite((in_ / "photo.png").string(), photo);
    cv::imwrite((in_ / "flipped.png").string(), flipped);
    Json camera = query["camera"];
    Write("camera.json", camera.dump());
    camera["params"][0] = camera["params"][0].get<double>() * 1.2;
    Write("longer.json", camera.dump());
    Json prior = query["prior"];
    prior["position"] = {p[0], p[1]};
    Write("prior.json", prior.dump());
    prior["position"] = {p[0] + 2.0, p[1]};
    Write("moved.json", prior.dump());
    Write("lines.txt",
          "10 200 300 190\n40 20 45 220\n100 30 101 200\n160 40 300 90\n20 80 200 70\n");
    // Of both kinds of search, and of the study.
    Write("config.json",
          R"({"search": {"heading_deg": 7, "map": {"heading_step_deg": 2}},
              "confidence": {"floor_m": 0.7}})");
    Write("poses.csv", "query,e,n,h,qw,qx,qy,qz\nstreet_000,1,2,3,1,0,0,0\n");
    WriteBoards();
    Write("box.obj",
          "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 9\nv 4 0 9\nv 4 4 9\nv 0 4 9\n"
          "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  }

  // Eight views of a checkerboard of 5 x 4 inner corners.
  void WriteBoards() const {
    constexpr int kSquarePx = 30;
    cv::Mat board(7 * kSquarePx, 8 * kSquarePx, CV_8U, cv::Scalar(240));
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 6; ++column) {
        if ((row + column) % 2 == 1) continue;
        board(cv::Rect((column + 1) * kSquarePx, (row + 1) * kSquarePx, kSquarePx, kSquarePx)) = 20;
      }
    }
    fs::create_directories(in_ / "boards");
    const float w = static_cast<float>(board.cols), h = static_cast<float>(board.rows);
    const std::vector<cv::Point2f> flat = {{0, 0}, {w, 0}, {w, h}, {0, h}};
    for (int i = 0; i < 8; ++i) {
      const float a = 12.0f * static_cast<float>(i % 4), b = 9.0f * static_cast<float>(i / 2);
      const std::vector<cv::Point2f> seen = {
          {20 + a, 30 + b}, {280 - b, 20 + a}, {290 - a, 220 - 0.5f * b}, {15 + b, 215 - a}};
      cv::Mat picture;
      cv::warpPerspective(board,
                          picture,
                          cv::getPerspectiveTransform(flat, seen),
                          cv::Size(320, 240),
                          cv::INTER_AREA,
                          cv::BORDER_CONSTANT,
                          cv::Scalar(200));
      cv::imwrite((in_ / "boards" / (std::to_string(i) + ".png")).string(), picture);
    }
  }

  void Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(in_ / name, text);
  }

  // The words of a line, with the folders put in after it is cut at its blanks.
  std::vector<std::string> WordsOf(const std::string& line) const {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word; words.push_back(word)) {
      for (const auto& [name, value] : {std::pair<std::string, std::string>{"{in}", in_.string()},
                                        {"{out}", out_.string()},
                                        {"{town}", Town().string()},
                                        {"{results}", Results().string()},
                                        {"{place}", place_},
                                        {"{here}", here_},
                                        {"{turned}", turned_}}) {
        const std::size_t at = word.find(name);
        if (at != std::string::npos) word.replace(at, name.size(), value);
      }
    }
    return words;
  }

  // Everything that comes out and does not depend on the clock.
  std::string Observe(const std::vector<std::string>& words) const {
    fs::remove_all(out_);
    fs::create_directories(out_);
    const Outcome outcome = RunHere(words);
    EXPECT_NE(outcome.exit_code, 1) << outcome.text;
    std::string seen = std::to_string(outcome.exit_code) + "\n";
    const std::string& command = words.front();
    const bool text_is_result = command == "info" || command == "options" ||
                                command == "completion" || command == "verify";
    if (text_is_result || outcome.exit_code == 2) seen += outcome.text;
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out_)) {
      if (!entry.is_regular_file()) continue;
      files[fs::relative(entry.path(), out_).string()] = Timeless(entry.path());
    }
    for (const auto& [name, content] : files) seen += name + "\n" + content + "\n";
    return seen;
  }

  // The content of a file, or nothing where it may hold times.
  static std::string Timeless(const fs::path& file) {
    const std::string name = file.filename();
    if (name == "report.json") {
      Json json = Json::parse(ReadFile(file));
      json.erase("seconds");
      return json.dump();
    }
    static const std::set<std::string> timed = {
        "summary.json", "results.csv", "frames.csv", "figures.csv", "summary.csv"};
    static const std::set<std::string> kinds = {".html", ".mp4", ".gpkg"};
    if (file.parent_path().filename() == "runs") return "";
    if (timed.contains(name) || kinds.contains(file.extension())) return "";
    return ReadFile(file);
  }

  // A base with an option's words: those given in place of the base's own of that option.
  std::vector<std::string> With(const std::string& base,
                                const std::string& option,
                                const std::string& change) const {
    std::vector<std::string> words = WordsOf(base);
    if (change.starts_with("--=")) {  // another positional word
      const std::vector<std::string> head = WordsOf(change.substr(3));
      std::copy(head.begin(), head.end(), words.begin());
      return words;
    }
    const bool repeats = option == "--set" || option[0] != '-';
    const auto at = std::find(words.begin(), words.end(), option);
    if (!repeats && at != words.end()) words.erase(at, at + 2);
    const std::vector<std::string> more = WordsOf(change);
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  const fs::path in_ = Scratch("options in");
  const fs::path out_ = Scratch("options out");
  std::string place_;   // east,north of a spot 12 m before the camera
  std::string here_;    // east,north,height of the camera
  std::string turned_;  // heading 10 deg to its right
};

TEST_F(Options, EachChangesWhatComesOutOrIsRefused) {
  for (const auto& [command, options] : Cases()) {
    const std::string& base = Bases().at(command);
    const std::string before = Observe(WordsOf(base));
    EXPECT_FALSE(before.starts_with("2\n")) << command << ": " << before;
    for (const auto& [option, change] : options) {
      EXPECT_NE(Observe(With(base, option, change)), before) << command << " " << option;
    }
  }
}

TEST_F(Options, EachHasACase) {
  Context context;
  const auto app = MakeProgram(context);
  for (const CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; })) {
    for (const CLI::Option* option : command->get_options()) {
      const std::string name =
          option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front();
      const std::string both = command->get_name() + " " + name;
      if (kNotOfResults.contains(name) || kNotOfResults.contains(both)) continue;
      const auto of_command = Cases().find(command->get_name());
      EXPECT_TRUE(of_command != Cases().end() && of_command->second.contains(name)) << both;
    }
  }
}

// Keys of alternatives that are not chosen are refused, with what would choose them.
TEST(IdleOptions, AreRefusedWithWhatWouldMakeThemWork) {
  const auto message = [](const std::vector<std::string>& assignments) -> std::string {
    LocalizerOptions options;
    for (const std::string& assignment : assignments) {
      SetOption(assignment, [&](OptionVisitor& v) { options.Visit(v); });
    }
    try {
      RefuseIdleOptions(assignments, options);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message({"search.sampler.tpe.candidates=3"}),
            "--set: search.sampler.tpe.candidates: got an option without effect, since "
            "search.method is map, expected search.method=sampler");
  EXPECT_THAT(message({"search.method=sampler", "search.sampler.tpe.candidates=3"}),
              HasSubstr("search.sampler.name=tpe or"));
  EXPECT_EQ(
      message(
          {"search.method=sampler", "search.sampler.name=tpe", "search.sampler.tpe.candidates=3"}),
      "");
  EXPECT_THAT(message({"search.method=sampler", "search.map.spacing_m=1"}), HasSubstr("is sampler"));
  EXPECT_EQ(message({"search.method=sampler", "search.map.modes=3"}), "");
  EXPECT_THAT(message({"score.gradient.sigma_width=0.002"}), HasSubstr("score.name=gradient"));
  EXPECT_EQ(message({"search.east_m=5", "score.name=gradient"}), "");
}

}  // namespace
}  // namespace ridgeline::testing
