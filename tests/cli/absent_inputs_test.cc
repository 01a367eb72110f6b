// SPDX-License-Identifier: Apache-2.0
// Inputs that may be absent, absent together: every combination through every command. What can be
// done is done, what cannot is one clear refusal; nothing crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "city/crs.h"
#include "cli/in_process.h"
#include "support/exif_writer.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Directory = ExifWriter::Directory;
using Json = nlohmann::ordered_json;

// What an input has.
struct Present {
  bool height, heading, tilt, camera, dtm, crs, prior, altitude;
};

std::string NameOf(const Present& p) {
  std::string name;
  const std::pair<bool, const char*> parts[] = {{p.height, "height"},
                                                {p.heading, "heading"},
                                                {p.tilt, "tilt"},
                                                {p.camera, "camera"},
                                                {p.dtm, "dtm"},
                                                {p.crs, "crs"},
                                                {p.prior, "prior"},
                                                {p.altitude, "EXIF altitude"}};
  for (const auto& [present, what] : parts) {
    if (present) name += (name.empty() ? "" : ", ") + std::string(what);
  }
  return "with " + (name.empty() ? "nothing" : name);
}

// The town's query in a folder of its own, with pictures that tell their place and a model that
// does not tell its system.
class AbsentInputs : public ::testing::Test {
 protected:
  AbsentInputs() {
    dataset_ = Json::parse(ReadFile(Town() / "dataset.json"));
    query_ = dataset_["queries"][0];
    const std::string model = ReadFile(Town() / "city.gml");
    WriteFileAtomically(folder_ / "city.gml", model);
    WriteFileAtomically(folder_ / "nameless.gml",
                        std::regex_replace(model, std::regex(" srsName=\"[^\"]*\""), ""));
    fs::copy_file(Town() / "dtm.tif", folder_ / "dtm.tif");
    WriteFileAtomically(folder_ / "box.obj",
                        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 9\nv 4 0 9\nv 4 4 9\nv 0 4 9\n"
                        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    for (const bool altitude : {false, true}) WritePhoto(altitude);
  }

  static const char* PhotoName(bool altitude) { return altitude ? "high.jpg" : "plain.jpg"; }

  void WritePhoto(bool altitude) const {
    const std::vector<double> p = query_["truth"]["position"];
    const Eigen::Vector2d place = LatitudeLongitude({25832, 0}, {p[0] + 1.0, p[1]}).value();
    const double f = query_["camera"]["params"][0];
    const double width = query_["camera"]["width"];
    const auto whole = [](double value) { return static_cast<std::uint32_t>(std::lround(value)); };
    ExifWriter exif;
    exif.Ratios(Directory::kPhoto, 0x920a, {{1000000, 1000000}})
        .Ratios(Directory::kPhoto, 0xa20e, {{whole(1000.0 * f * 25.4), 1000}})
        .Short(Directory::kPhoto, 0xa210, 2)
        .Short(Directory::kPhoto, 0xa002, static_cast<std::uint16_t>(width))
        .Text(Directory::kGps, 1, "N")
        .Ratios(Directory::kGps, 2, {{whole(place.x() * 1e7), 10000000}})
        .Text(Directory::kGps, 3, "E")
        .Ratios(Directory::kGps, 4, {{whole(place.y() * 1e7), 10000000}});
    if (altitude) {
      exif.Byte(Directory::kGps, 5, 0).Ratios(Directory::kGps, 6, {{whole(p[2] * 100), 100}});
    }
    std::vector<uchar> jpeg;
    cv::imencode(".jpg", cv::imread((Town() / query_["image"]).string()), jpeg);
    WriteFileAtomically(folder_ / PhotoName(altitude),
                        JpegWith(std::string(jpeg.begin(), jpeg.end()), exif.Block(), ""));
  }

  // dataset.json of what is present; the path as a word.
  std::string Write(const Present& present) const {
    Json query = query_;
    query["image"] = PhotoName(present.altitude);
    if (!present.camera) query.erase("camera");
    if (!present.prior) query.erase("prior");
    if (present.prior) {
      const std::vector<double> p = query_["truth"]["position"];
      Json prior = {{"position", {p[0] + 1.0, p[1]}}};
      if (present.height) prior["position"].push_back(p[2]);
      if (present.heading) prior["heading_deg"] = query_["prior"]["heading_deg"];
      if (present.tilt) prior["pitch_deg"] = prior["roll_deg"] = 0.0;
      query["prior"] = prior;
    }
    Json dataset = {{"name", "absent"}, {"model", {present.crs ? "city.gml" : "nameless.gml"}}};
    if (present.crs) dataset["crs"] = "EPSG:25832";
    if (present.dtm) dataset["dtm"] = "dtm.tif";
    dataset["queries"] = Json::array({query});
    WriteFileAtomically(folder_ / "dataset.json", dataset.dump());
    return (folder_ / "dataset.json").string();
  }

  // A search of a few poses: what matters is that it is made.
  static void AddQuickSearch(std::vector<std::string>& words) {
    for (const char* set : {"search.method=sampler",
                            "search.sampler.name=random",
                            "search.evaluations=4",
                            "search.refine=false",
                            "score.name=line_energy"}) {
      words.insert(words.end(), {"--set", set});
    }
  }

  std::vector<std::string> Words(const std::string& command, const std::string& dataset) const {
    const std::string id = query_["id"];
    if (command == "localize") {
      std::vector<std::string> words = {"localize", "--dataset", dataset, "--query", id};
      AddQuickSearch(words);
      return words;
    }
    if (command == "bench") {
      std::vector<std::string> words = {"bench", dataset};
      AddQuickSearch(words);
      return words;
    }
    if (command == "skyline") {
      fs::remove_all(folder_ / "frames");
      return {"skyline", "--dataset", dataset, "--out", (folder_ / "frames").string()};
    }
    if (command == "study") {
      return {"study", dataset, "--score", "line_energy", "--perturb", "1,1,0,2", "--classes", "4"};
    }
    std::vector<std::string> words = {
        command, "--dataset", dataset, "--query", id, "--at", "prior"};
    const std::string picture = (folder_ / (command + ".png")).string();
    words.insert(words.end(), {"--out", picture});
    if (command == "augment") {
      const std::vector<double> p = query_["truth"]["position"];
      words.insert(
          words.end(),
          {"--building",
           (folder_ / "box.obj").string(),
           "--place",
           std::to_string(p[0]) + "," + std::to_string(p[1]) + "," + std::to_string(p[2])});
    }
    return words;
  }

  void Check(const std::string& command, const Present& present, bool refused) const {
    const Outcome outcome = RunHere(Words(command, Write(present)));
    const std::string what = command + " " + NameOf(present) + ": " + outcome.text;
    if (refused) {
      EXPECT_EQ(outcome.exit_code, 2) << what;
      EXPECT_THAT(outcome.text, HasSubstr("--crs")) << what;
    } else {
      EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << what;
    }
  }

  const fs::path folder_ = Scratch("absent inputs");
  Json dataset_;
  Json query_;
};

// Latitude and longitude cannot be placed in a model that names no system: the one combination that
// nothing can be made of.
bool CannotBePlaced(const Present& p) { return !p.prior && !p.crs; }

TEST_F(AbsentInputs, AtThePriorEveryCombinationIsDoneOrRefused) {
  for (int bits = 0; bits < 256; ++bits) {
    const auto has = [bits](int k) { return (bits >> k & 1) != 0; };
    const Present present{has(0), has(1), has(2), has(3), has(4), has(5), has(6), has(7)};
    // Parts of a prior that is absent, and EXIF beside a prior, are the same again.
    if (!present.prior && (present.height || present.heading || present.tilt)) continue;
    if (present.prior && present.altitude) continue;
    for (const char* command : {"localize", "bench", "render", "augment", "skyline"}) {
      Check(command, present, CannotBePlaced(present));
    }
  }
}

TEST_F(AbsentInputs, AStudyDrawsItsPriors) {
  for (int bits = 0; bits < 8; ++bits) {
    const bool camera = (bits & 1) != 0;
    const bool dtm = (bits & 2) != 0;
    const bool crs = (bits & 4) != 0;
    Check("study", {false, false, false, camera, dtm, crs, false, false}, false);
  }
}

// The ground of the model is taken for the terrain, and said so, in the results too.
TEST_F(AbsentInputs, WithoutTerrainTheModelsGroundIsTaken) {
  const std::string dataset = Write({false, true, true, true, false, true, true, false});
  std::vector<std::string> words = Words("localize", dataset);
  words.insert(words.end(), {"--out", (folder_ / "result").string()});
  const Outcome outcome = RunHere(words);
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.text;
  for (const char* file : {"pose.json", "report.json"}) {
    const Json json = Json::parse(ReadFile(folder_ / "result" / file));
    std::vector<std::string> what;
    for (const Json& assumption : json["assumptions"]) what.push_back(assumption["what"]);
    EXPECT_THAT(what, ::testing::ElementsAre("height", "search", "terrain")) << file;
  }
}

}  // namespace
}  // namespace ridgeline::testing
