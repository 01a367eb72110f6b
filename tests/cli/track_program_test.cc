// SPDX-License-Identifier: Apache-2.0
// `ridgeline track` on a drive, and on drives with something wrong: each has a defined result with a
// reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Json = nlohmann::json;
using Row = std::map<std::string, std::string>;

// Fields in quotes may hold commas.
std::vector<std::string> FieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::vector<Row> ReadCsv(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = FieldsOf(line);
    if (names.empty()) {
      names = fields;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = fields.at(i);
    rows.push_back(row);
  }
  return rows;
}

double Number(const Row& row, const std::string& name) {
  return row.at(name).empty() ? NAN : std::atof(row.at(name).c_str());
}

// A drive of eight frames in a small town, made once, with a start 8 m off and any heading.
const fs::path& Drive() {
  static const fs::path drive = [] {
    const fs::path folder = Scratch("track drive") / "drive";
    EXPECT_EQ(Ridgeline("synth --quiet --out " + Quoted(folder) +
                        " --drive 8 --seed 4 --size 480x270 --set town.blocks_east=2"
                        " --set town.blocks_north=2")
                  .exit_code,
              0);
    std::ifstream in(folder / "dataset.json");
    Json dataset = Json::parse(in);
    const Json place = dataset["queries"][0]["truth"]["position"];
    dataset["queries"][0]["prior"] = {
        {"position", {place[0].get<double>() + 5.0, place[1].get<double>() - 6.0}}};
    std::ofstream(folder / "dataset.json") << dataset.dump(1);
    return folder;
  }();
  return drive;
}

// A copy to break.
fs::path CopyOf(const std::string& name) {
  const fs::path copy = Scratch(name) / "drive";
  fs::copy(Drive(), copy, fs::copy_options::recursive);
  return copy;
}

std::string Frame(int i) { return "images/frame_000" + std::to_string(i) + ".jpg"; }

struct Tracked {
  int exit_code = 0;
  std::vector<Row> rows;
  Json summary;
};

Tracked Track(const fs::path& drive, const std::string& options) {
  const fs::path out = drive.parent_path() / "out";
  Tracked tracked;
  tracked.exit_code = Ridgeline("track --quiet " + Quoted(drive / "dataset.json") + " --out " +
                                Quoted(out) + " --set track.start_m=12 " + options)
                          .exit_code;
  tracked.rows = ReadCsv(out / "frames.csv");
  std::ifstream summary(out / "summary.json");
  tracked.summary = Json::parse(summary);
  return tracked;
}

std::string Odometry(const fs::path& drive) {
  return "--odometry " + Quoted(drive / "odometry.csv");
}

// No frame that claims to be tracked with confidence is far off.
void ExpectNoConfidentLie(const Tracked& tracked) {
  for (const Row& row : tracked.rows) {
    if (Number(row, "confidence") >= 0.9 && !row.at("error_m").empty()) {
      EXPECT_LT(Number(row, "error_m"), 5.0) << row.at("id");
    }
  }
}

// Lines of odometry.csv, each changed by `change` (fields by the header's order).
template <typename Change>
void EditOdometry(const fs::path& drive, Change change) {
  std::ifstream in(drive / "odometry.csv");
  std::string text, line;
  bool header = true;
  while (std::getline(in, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> fields = FieldsOf(line);
    if (!header) change(fields);
    header = false;
    for (std::size_t i = 0; i < fields.size(); ++i) text += (i > 0 ? "," : "") + fields[i];
    text += '\n';
  }
  in.close();
  std::ofstream(drive / "odometry.csv") << text;
}

TEST(Track, FollowsADriveAndWritesWhatOtherProgramsRead) {
  const fs::path drive = CopyOf("track good");
  const fs::path folder = drive.parent_path();
  const Tracked tracked =
      Track(drive,
            Odometry(drive) + " --nmea " + Quoted(folder / "n.txt") + " --json-lines " +
                Quoted(folder / "j.txt") + " --report " + Quoted(folder / "r.html") + " --film " +
                Quoted(folder / "f.mp4"));
  EXPECT_EQ(tracked.exit_code, 0);
  ASSERT_EQ(tracked.rows.size(), 8u);
  EXPECT_EQ(tracked.rows.back().at("state"), "tracking");
  EXPECT_LT(Number(tracked.rows.back(), "error_m"), 1.0);
  EXPECT_GT(Number(tracked.rows.back(), "confidence"), 0.8);  // of which track.tracking_from speaks
  for (const Row& row : tracked.rows) EXPECT_LT(Number(row, "smoothed_error_m"), 1.5);
  for (const char* name : {"out/poses.tum", "out/smoothed.tum", "out/colmap/images.txt",
                           "out/track.geojson", "out/track.kml", "out/map.png", "r.html", "f.mp4"}) {
    EXPECT_GT(fs::file_size(folder / name), 100u) << name;
  }
  std::ifstream nmea(folder / "n.txt"), lines(folder / "j.txt");
  std::string line;
  std::getline(nmea, line);
  EXPECT_THAT(line, HasSubstr("$GPGGA,"));
  int count = 0;
  for (; std::getline(lines, line); ++count) EXPECT_TRUE(Json::parse(line).contains("state"));
  EXPECT_EQ(count, 8);
}

TEST(Track, MissingPicturesAreBridgedByOdometry) {
  const fs::path drive = CopyOf("track missing");
  fs::remove(drive / Frame(4));
  fs::resize_file(drive / Frame(5), 20);
  const Tracked tracked = Track(drive, Odometry(drive));
  for (const int i : {4, 5}) {
    EXPECT_THAT(tracked.rows[i].at("reason"), HasSubstr("missing"));
    EXPECT_EQ(tracked.rows[i].at("look"), "none");
    EXPECT_LT(Number(tracked.rows[i], "error_m"), 2.0);
  }
  EXPECT_LT(Number(tracked.rows.back(), "error_m"), 1.0);
}

TEST(Track, ATunnelGrowsTheUncertaintyUntilItIsOver) {
  const fs::path drive = CopyOf("track tunnel");
  for (const int i : {4, 5, 6}) {
    cv::imwrite((drive / Frame(i)).string(), cv::Mat(270, 480, CV_8UC3, cv::Scalar(8, 8, 8)));
  }
  const Tracked tracked = Track(drive, Odometry(drive));
  EXPECT_THAT(tracked.rows[5].at("reason"), HasSubstr("lines"));
  EXPECT_GT(Number(tracked.rows[6], "sigma_north_m"), Number(tracked.rows[3], "sigma_north_m"));
  EXPECT_LT(Number(tracked.rows[6], "error_m"), 2.0);
  ExpectNoConfidentLie(tracked);
}

// Eight frames are too few to find the axes and the scale (OdometryCheck has its own test): then it
// is not believed.
TEST(Track, OdometryOfAVehicleInFeetIsNotBelieved) {
  const fs::path drive = CopyOf("track body");
  EditOdometry(drive, [](std::vector<std::string>& f) {
    // id,time_s,dx,dy,dz,qw,qx,qy,qz,...: x forward, y left, z up.
    const auto number = [&](int i, double factor) {
      return std::to_string(factor * std::atof(f[static_cast<std::size_t>(i)].c_str()));
    };
    const double feet = 1.0 / 0.3048;
    const std::vector<std::string> moved = {number(4, feet), number(2, -feet), number(3, -feet)};
    const std::vector<std::string> turned = {number(8, 1.0), number(6, -1.0), number(7, -1.0)};
    for (std::size_t k = 0; k < 3; ++k) {
      f[2 + k] = moved[k];
      f[6 + k] = turned[k];
    }
  });
  const Tracked tracked = Track(drive, Odometry(drive));
  EXPECT_LT(Number(tracked.rows.back(), "confidence"), 0.5);
  ExpectNoConfidentLie(tracked);
}

TEST(Track, TimeStampsThatJumpAreSaid) {
  const fs::path drive = CopyOf("track time");
  EditOdometry(drive, [](std::vector<std::string>& f) {
    if (f[0] >= "frame_0005") f[1] = std::to_string(std::atof(f[1].c_str()) + 100.0);
  });
  const Tracked tracked = Track(drive, Odometry(drive));
  EXPECT_THAT(tracked.rows[5].at("reason"), HasSubstr("time stamp jumps by 100"));
  ExpectNoConfidentLie(tracked);
}

TEST(Track, ACutIsSaidAndThePlaceSoughtAgain) {
  const fs::path drive = CopyOf("track cut");
  // Another scene altogether from the fifth frame on: the picture upside down.
  for (int i = 5; i < 8; ++i) {
    const std::string file = (drive / Frame(i)).string();
    cv::Mat picture = cv::imread(file);
    cv::rotate(picture, picture, cv::ROTATE_180);
    cv::imwrite(file, picture);
  }
  const Tracked tracked = Track(drive, "--sensors " + Quoted(drive / "sensors.csv"));
  EXPECT_NE(tracked.rows[5].at("state"), "tracking");
  EXPECT_FALSE(tracked.rows[5].at("reason").empty());
  ExpectNoConfidentLie(tracked);
}

TEST(Track, ACameraThatZoomsIsNotBelieved) {
  const fs::path drive = CopyOf("track zoom");
  for (int i = 4; i < 8; ++i) {
    const std::string file = (drive / Frame(i)).string();
    const cv::Mat picture = cv::imread(file);
    cv::Mat zoomed;
    cv::resize(picture(cv::Rect(96, 54, 288, 162)), zoomed, picture.size(), 0, 0, cv::INTER_CUBIC);
    cv::imwrite(file, zoomed);
  }
  const Tracked tracked = Track(drive, Odometry(drive));
  ExpectNoConfidentLie(tracked);
  EXPECT_NE(tracked.rows.back().at("state"), "tracking");
  EXPECT_FALSE(tracked.rows.back().at("reason").empty());
}

TEST(Track, APictureOfAnotherSizeIsLeftOutWithAReason) {
  const fs::path drive = CopyOf("track size");
  cv::imwrite((drive / Frame(4)).string(), cv::Mat(200, 300, CV_8UC3, cv::Scalar(90, 90, 90)));
  const Tracked tracked = Track(drive, Odometry(drive));
  EXPECT_THAT(tracked.rows[4].at("reason"), HasSubstr("300 x 200 px"));
  EXPECT_LT(Number(tracked.rows.back(), "error_m"), 1.0);
}

TEST(Track, OdometryThatFitsNoFrameIsRefused) {
  const fs::path drive = CopyOf("track odometry");
  EditOdometry(drive, [](std::vector<std::string>& f) { f[0] = "other_" + f[0]; });
  // By order it would fit: one row less than the frames. One more missing, and it does not.
  std::ifstream in(drive / "odometry.csv");
  std::stringstream all;
  all << in.rdbuf();
  std::string text = all.str();
  text.resize(text.rfind('\n', text.size() - 2) + 1);
  std::ofstream(drive / "odometry.csv") << text;
  const Outcome result = Ridgeline("track --quiet " + Quoted(drive / "dataset.json") + " --out " +
                                  Quoted(drive.parent_path() / "o") + " " + Odometry(drive));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.text, HasSubstr("no motion between any two frames"));
}

TEST(Track, TakesPicturesAsTheyAppear) {
  const fs::path drive = CopyOf("track follow");
  const fs::path folder = drive.parent_path();
  std::ifstream in(drive / "dataset.json");
  const Json dataset = Json::parse(in);
  std::ofstream(folder / "camera.json") << dataset["queries"][0]["camera"].dump();
  std::ofstream(folder / "prior.json") << dataset["queries"][0]["prior"].dump();
  const std::string common = " --model " + Quoted(drive / "city.gml") + " --dtm " +
                             Quoted(drive / "dtm.tif") + " --camera " +
                             Quoted(folder / "camera.json") + " --prior " +
                             Quoted(folder / "prior.json") +
                             " --set track.start_m=12 --json-lines " + Quoted(folder / "lines.txt");
  ASSERT_EQ(Ridgeline("track --quiet " + Quoted(drive / "images") + common + " --follow --idle 0.5 " +
                      Odometry(drive))
                .exit_code,
            0);
  std::ifstream lines(folder / "lines.txt");
  std::string line;
  int count = 0;
  Json last;
  for (; std::getline(lines, line); ++count) last = Json::parse(line);
  EXPECT_EQ(count, 8);
  const Json truth = dataset["queries"][7]["truth"]["position"];
  EXPECT_NEAR(last["position"][0].get<double>(), truth[0].get<double>(), 1.0);
  EXPECT_NEAR(last["position"][1].get<double>(), truth[1].get<double>(), 1.0);
}

}  // namespace
}  // namespace ridgeline::testing
