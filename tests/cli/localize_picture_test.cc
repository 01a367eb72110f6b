// SPDX-License-Identifier: Apache-2.0
// Localization from a picture alone, its EXIF and XMP being all that is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/atomic_file.h"
#include "camera/pose.h"
#include "city/crs.h"
#include "cli/program.h"
#include "support/exif_writer.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using Directory = ExifWriter::Directory;
using ::testing::AllOf;
using ::testing::HasSubstr;

const Crs kUtm32{25832, 0};

// A town of two pictures, large enough to be localized: one upright, one from the air.
const fs::path& PictureTown() {
  static const fs::path town = [] {
    const fs::path folder = Scratch("picture town") / "town";
    Ridgeline(
        "synth --quiet --queries 1 --tilted 0 --portrait 1 --drone 1 --size 640x480 "
        "--set town.blocks_east=2 --set town.blocks_north=2 --out " +
        Quoted(folder));
    return folder;
  }();
  return town;
}

nlohmann::json QueryOf(const std::string& id) {
  const auto dataset = nlohmann::json::parse(ReadFile(PictureTown() / "dataset.json"));
  for (const auto& query : dataset["queries"]) {
    if (query["id"] == id) return query;
  }
  ADD_FAILURE() << id;
  return {};
}

Pose TruthOf(const nlohmann::json& query) {
  const auto& truth = query["truth"];
  const std::vector<double> p = truth["position"];
  const std::vector<double> q = truth["cam_from_world_wxyz"];
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), {p[0], p[1], p[2]}};
}

std::string Degrees(double value) { return std::to_string(value); }

// A place 4 m off, to 1e-7 degrees, and the focal length as 35 mm equivalent to a hundredth.
ExifWriter ExifOf(const nlohmann::json& query, bool with_place) {
  const Eigen::Vector3d center = TruthOf(query).center_in_world;
  const Eigen::Vector2d place =
      LatitudeLongitude(kUtm32, center.head<2>() + Eigen::Vector2d(3.0, -2.5)).value();
  ExifWriter exif;
  const double f = query["camera"]["params"][0];
  const double width = query["camera"]["width"];
  const double height = query["camera"]["height"];
  exif.Ratios(Directory::kPhoto, 0x920a, {{static_cast<std::uint32_t>(1e6), 1000000}})
      .Ratios(Directory::kPhoto,
              0xa20e,
              {{static_cast<std::uint32_t>(std::lround(1000.0 * f * 25.4)), 1000}})
      .Short(Directory::kPhoto, 0xa210, 2)
      .Short(Directory::kPhoto, 0xa002, static_cast<std::uint16_t>(std::max(width, height)));
  if (with_place) {
    exif.Text(Directory::kGps, 1, "N")
        .Ratios(Directory::kGps,
                2,
                {{static_cast<std::uint32_t>(std::lround(place.x() * 1e7)), 10000000}})
        .Text(Directory::kGps, 3, "E")
        .Ratios(Directory::kGps,
                4,
                {{static_cast<std::uint32_t>(std::lround(place.y() * 1e7)), 10000000}});
  }
  return exif;
}

// The dataset's picture with EXIF and XMP put in; turned a quarter to the left first if it is to be
// stored on its side.
void WritePhoto(const nlohmann::json& query,
                bool on_its_side,
                const std::string& exif,
                const std::string& xmp,
                const fs::path& file) {
  cv::Mat picture = cv::imread((PictureTown() / query["image"]).string());
  if (on_its_side) cv::rotate(picture, picture, cv::ROTATE_90_COUNTERCLOCKWISE);
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", picture, jpeg);
  WriteFileAtomically(file, JpegWith(std::string(jpeg.begin(), jpeg.end()), exif, xmp));
}

std::string ModelArguments() {
  return " --model " + Quoted(PictureTown() / "city.gml") + " --dtm " +
         Quoted(PictureTown() / "dtm.tif");
}

double ErrorOf(const fs::path& result, const Pose& truth) {
  const auto json = nlohmann::json::parse(ReadFile(result / "pose.json"));
  const std::vector<double> p = json["pose"]["position"];
  return (Eigen::Vector3d(p[0], p[1], p[2]) - truth.center_in_world).head<2>().norm();
}

TEST(LocalizePicture, PortraitStoredOnItsSideWithTrueHeading) {
  const auto query = QueryOf("portrait_000");
  const Pose truth = TruthOf(query);
  const double grid = ViewAnglesOf(truth.cam_from_world).heading_deg;
  const double convergence =
      MeridianConvergenceDeg(kUtm32, truth.center_in_world.head<2>()).value();
  const double heading = WrapHeadingDeg(grid + convergence + 6.0);
  ExifWriter exif = ExifOf(query, true);
  exif.Short(Directory::kImage, 0x0112, 6)
      .Text(Directory::kGps, 16, "T")
      .Ratios(Directory::kGps, 17, {{static_cast<std::uint32_t>(std::lround(heading * 100)), 100}});
  const fs::path folder = Scratch("portrait");
  WritePhoto(query, true, exif.Block(), "", folder / "photo.jpg");
  const Outcome outcome = Ridgeline("localize " + Quoted(folder / "photo.jpg") + ModelArguments() +
                                    " --out " + Quoted(folder / "result"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("turned upright as its EXIF says"),
                    HasSubstr("from true north (EXIF)"),
                    HasSubstr("terrain + 1.7 m assumed"),
                    HasSubstr("held level assumed"),
                    HasSubstr("search: within 10 m")));
  // Read wrongly, a picture on its side or a heading is off by far more.
  EXPECT_LT(ErrorOf(folder / "result", truth), 6.0);
  const cv::Mat overlay = cv::imread((folder / "result" / "overlay.png").string());
  EXPECT_GT(overlay.rows, overlay.cols);
}

TEST(LocalizePicture, DroneWithXmp) {
  const auto query = QueryOf("drone_000");
  const Pose truth = TruthOf(query);
  const ViewAngles angles = ViewAnglesOf(truth.cam_from_world);
  const double convergence =
      MeridianConvergenceDeg(kUtm32, truth.center_in_world.head<2>()).value();
  const std::string xmp =
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
      "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
      "xmlns:drone-dji=\"http://www.dji.com/drone-dji/1.0/\" drone-dji:RelativeAltitude=\"+46.00\" "
      "drone-dji:GimbalYawDegree=\"" +
      Degrees(HeadingDifferenceDeg(angles.heading_deg + convergence, 0.0)) +
      "\" drone-dji:GimbalPitchDegree=\"" + Degrees(angles.pitch_deg) +
      "\" drone-dji:GimbalRollDegree=\"+0.00\"/></rdf:RDF></x:xmpmeta>";
  const fs::path folder = Scratch("drone");
  WritePhoto(query, false, ExifOf(query, true).Block(), xmp, folder / "photo.jpg");
  const Outcome outcome = Ridgeline("localize " + Quoted(folder / "photo.jpg") + ModelArguments() +
                                    " --out " + Quoted(folder / "result"));
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("terrain below + 46.0 m above take-off"), HasSubstr("DJI's XMP")));
  // Found, or withheld for want of certainty; never an error.
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.text;
  if (outcome.exit_code == 0) {
    EXPECT_LT(ErrorOf(folder / "result", truth), 12.0);
  }
}

TEST(LocalizePicture, WithoutAPlaceAsksForAPrior) {
  const auto query = QueryOf("street_000");
  const fs::path folder = Scratch("no place");
  WritePhoto(query, false, ExifOf(query, false).Block(), "", folder / "photo.jpg");
  const Outcome outcome = Ridgeline("localize " + Quoted(folder / "photo.jpg") + ModelArguments() +
                                    " --out " + Quoted(folder / "result"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("photo.jpg: position: got none in its EXIF or XMP"),
                    HasSubstr("--prior FILE")));
  EXPECT_FALSE(fs::exists(folder / "result" / "pose.json"));
}

TEST(LocalizePicture, WithoutModelAsksForOne) {
  const Outcome outcome = Ridgeline("localize photo.jpg --dtm dtm.tif");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("--model"));
}

}  // namespace
}  // namespace ridgeline::testing
