// SPDX-License-Identifier: Apache-2.0
#include "replay/ayadi_replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "base/atomic_file.h"
#include "replay/ayadi_pages.h"
#include "support/source_folder.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

PinholeCamera Camera() { return {320, 240, 280.0, 280.0, 160.0, 120.0}; }

class AyadiOnAStreet : public ::testing::Test {
 protected:
  AyadiOnAStreet() : model_(Street()), scene_(model_, nullptr, ProjectionOptions{}) {}

  static CityModel Street() {
    std::vector<testing::House> houses;
    const double eaves[] = {6.0, 9.0, 5.0, 8.0, 11.0, 7.0};
    for (int i = 0; i < 6; ++i) {
      houses.push_back({{i % 2 == 0 ? -12.0 : 13.0, 14.0 + 9.0 * i}, 9.0 + i % 3, 8.0, 0.0, 0.0,
                        eaves[i], eaves[i] + (i % 3 == 0 ? 0.0 : 3.0)});
    }
    return testing::MakeCity(houses);
  }

  // Houses grey before a bright sky; the instruments are off by 7 and 2 degrees.
  AyadiFrame Frame(const std::string& id, double heading_deg) const {
    AyadiFrame frame;
    frame.id = id;
    frame.camera = Camera();
    frame.truth = Pose{CamFromWorld(ViewAngles{heading_deg, 6.0, 1.0}), {0.5, -6.0, 1.6}};
    frame.instruments =
        Pose{CamFromWorld(ViewAngles{heading_deg + 7.0, 4.0, 0.0}), {0.5, -6.0, 1.6}};
    const ViewBuffers view = scene_.Render(frame.camera, *frame.truth);
    frame.picture = cv::Mat(240, 320, CV_8UC3, cv::Scalar(250, 235, 215));
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * 320 + x;
        const Eigen::Vector3d ray = frame.truth->cam_from_world.conjugate() *
                                    frame.camera.RayFromImage({x + 0.5, y + 0.5});
        if (view.surfaces[i] != kNoSurface) {
          const auto shade = static_cast<std::uint8_t>(90 + 12 * (view.surfaces[i] % 5));
          frame.picture.at<cv::Vec3b>(y, x) = {shade, shade, shade};
        } else if (ray.z() < 0.0) {
          frame.picture.at<cv::Vec3b>(y, x) = {60, 65, 60};
        }
      }
    }
    return frame;
  }

  CityModel model_;
  Scene scene_;
};

TEST_F(AyadiOnAStreet, EveryMethodIsBetterThanTheInstruments) {
  const AyadiFrame frame = Frame("a", 3.0);
  for (const AyadiVariant& variant : AyadiVariants()) {
    const AyadiResult result = ReplayFrame(scene_, variant, frame);
    ASSERT_TRUE(result.usable) << variant.name;
    EXPECT_NEAR(result.heading_error_deg[0], 7.0, 1e-6);
    for (std::size_t m = 1; m < kAyadiMethodCount; ++m) {
      EXPECT_LT(result.l1_px[m], 0.5 * result.l1_px[0]) << variant.name << ' ' << kAyadiMethods[m];
      EXPECT_LT(std::abs(result.heading_error_deg[m]), 3.0) << variant.name << kAyadiMethods[m];
      EXPECT_GT(result.evaluations[m], 10);
    }
    // 3D, which makes the skyline anew, is no worse than 2D.
    EXPECT_LE(result.l1_px[3], result.l1_px[1] + 0.5) << variant.name;
  }
}

TEST_F(AyadiOnAStreet, TheRenderedVirtualSkylineGivesNearlyTheSamePose) {
  AyadiVariant variant = AyadiVariants().front();
  variant.options.match.max_evaluations = 40;
  const AyadiFrame frame = Frame("a", 3.0);
  const AyadiResult exact = ReplayFrame(scene_, variant, frame);
  variant.rendered = true;
  const AyadiResult rendered = ReplayFrame(scene_, variant, frame);
  EXPECT_NEAR(rendered.heading_error_deg[3], exact.heading_error_deg[3], 1.0);
}

TEST_F(AyadiOnAStreet, SizesFallWithThePrecision) {
  const Skyline skyline = ReplayFrame(scene_, AyadiVariants().front(), Frame("a", 3.0)).skyline;
  std::size_t last = 100000;
  for (const double precision : {0.0, 1.0, 2.0, 5.0}) {
    const SimplifiedSkyline s = Simplified(skyline, precision);
    EXPECT_EQ(s.points, skyline.size());
    EXPECT_LE(s.simplified, s.without_outliers);
    EXPECT_LE(s.simplified, last);
    if (precision == 0.0) {
      EXPECT_EQ(s.simplified, s.points);
    }
    last = s.simplified;
  }
  EXPECT_LT(last, 60u);  // a few dozen
}

TEST_F(AyadiOnAStreet, TheDomainIsLeastNearTheTruth) {
  const AyadiVariant variant = AyadiVariants().back();
  AyadiFrame frame = Frame("a", 3.0);
  const AyadiResult result = ReplayFrame(scene_, variant, frame);
  const AyadiDomain domain = ExploreDomain(scene_, variant, frame, result.skyline, 3.0, 1.5, 2);
  ASSERT_EQ(domain.cells, 5);
  const auto least = std::min_element(domain.distance_px.begin(), domain.distance_px.end());
  const auto cell = static_cast<int>(least - domain.distance_px.begin());
  // The true position is the middle.
  EXPECT_LE(std::abs(cell % 5 - 2), 1);
  EXPECT_LE(std::abs(cell / 5 - 2), 1);
}

TEST_F(AyadiOnAStreet, ThePageHasItsFiguresAndThePapersTable) {
  std::vector<AyadiFrame> frames = {Frame("a", 3.0), Frame("b", 5.0)};
  std::vector<AyadiRun> runs;
  AyadiTemporal temporal;
  for (const AyadiVariant& variant : AyadiVariants()) {
    AyadiRun run{variant, {}};
    for (const AyadiFrame& frame : frames) run.frames.push_back(ReplayFrame(scene_, variant, frame));
    runs.push_back(std::move(run));
  }
  for (const AyadiFrame& frame : frames) temporal.poses.push_back(frame.truth);
  const TexturedMesh tower = TexturedFrom(TowerBefore(*frames[0].truth, 60.0, 0.0));
  ReplayPage page("Replay", {});
  AddAyadiResults(runs, page);
  AddAyadiSizes(runs, page);
  AddAyadiStability(runs, frames, temporal, tower, page);
  AddAyadiFrame(scene_, runs[0].variant, frames[0], runs[0].frames[0], &tower, page);
  const fs::path folder =
      fs::temp_directory_path() / ("ridgeline_ayadi_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  page.WriteTo(folder);
  const std::string html = ReadFile(folder / "index.html");
  for (const char* text : {"49.62", "Fig. 11", "Fig. 12", "Fig. 13", "Table 2", "hovering"}) {
    EXPECT_NE(html.find(text), std::string::npos) << text;
  }
  for (const char* file : {"table1.csv", "table2.csv", "frames.csv", "stability.csv",
                           "fig8_printed.png", "fig10_printed.png", "fig13_printed.png"}) {
    EXPECT_TRUE(fs::exists(folder / file)) << file;
  }
  const std::string csv = ReadFile(folder / "frames.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2 * 4);
  fs::remove_all(folder);
}

TEST(AyadiVariants, AsPrintedIsTheShippedConfiguration) {
  SkylineTrackOptions shipped;
  OptionsFromJson(ReadFile(fs::path(kSourceFolder) / "configs/skyline_paper.json"),
                  "skyline_paper.json",
                  [&](OptionVisitor& v) {
                    shipped.Visit(v);
                  });
  SkylineTrackOptions printed = AyadiVariants().front().options;
  EXPECT_EQ(OptionsToJson([&](OptionVisitor& v) { printed.Visit(v); }),
            OptionsToJson([&](OptionVisitor& v) { shipped.Visit(v); }));
}

}  // namespace
}  // namespace ridgeline
