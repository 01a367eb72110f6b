// SPDX-License-Identifier: Apache-2.0
// What is quick under a few tilts, against what holds for any rotation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "score/cue_table.h"
#include "score/evidence_score.h"
#include "score/facade_table.h"
#include "score/score_options.h"
#include "score/tilted_rays.h"
#include "support/house_before_camera.h"

namespace ridgeline {
namespace {

using testing::kCamera;

constexpr double kRadPerDeg = M_PI / 180.0;

Eigen::Matrix3f RotationOf(const ViewAngles& angles) {
  return CamFromWorld(angles).toRotationMatrix().cast<float>();
}

class Draw {
 public:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  ViewAngles Tilt() { return {0.0, Between(-40.0, 40.0), Between(-30.0, 30.0)}; }
  // With numbers that grow from cell to cell.
  SurfacePanorama Panorama() {
    SurfacePanorama panorama;
    panorama.step = Between(0.4, 2.0) * kRadPerDeg;
    panorama.first_azimuth = Between(-M_PI, M_PI);
    panorama.first_elevation = Between(-1.2, -0.2);
    const double width = Between(0.0, 1.0) < 0.5 ? 2.0 * M_PI : Between(0.5, 3.0);
    panorama.columns = static_cast<int>(std::ceil(width / panorama.step)) + 1;
    panorama.rows = static_cast<int>(1.5 / panorama.step);
    panorama.surfaces.resize(static_cast<std::size_t>(panorama.columns) * panorama.rows);
    for (std::size_t i = 0; i < panorama.surfaces.size(); ++i) {
      panorama.surfaces[i] = static_cast<std::uint32_t>(i);
    }
    return panorama;
  }

 private:
  std::mt19937 random_{5};
};

bool IsBetweenCells(float place) { return std::abs(place - std::round(place)) < 5e-3f; }

TEST(TiltedRays, CellsAreThoseOfTheGeneralWay) {
  Draw draw;
  int inside = 0;
  int compared = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Eigen::Vector3f> rays;
    for (int i = 0; i < 13; ++i) {
      rays.emplace_back(draw.Between(-0.8, 0.8), draw.Between(-0.6, 0.6), 1.0);
    }
    std::vector<ViewAngles> tilts{draw.Tilt(), draw.Tilt()};
    const std::vector<Eigen::Matrix3f> rotations{RotationOf(tilts[0]), RotationOf(tilts[1])};
    const TiltedRays tilted(rays, rotations);
    ViewAngles angles = tilts[static_cast<std::size_t>(round % 2)];
    angles.heading_deg = draw.Between(-400.0, 400.0);
    const Eigen::Matrix3f rotation = RotationOf(angles);
    const auto turned = tilted.Find(rotation);
    ASSERT_TRUE(turned);
    EXPECT_EQ(turned->tilt, static_cast<std::size_t>(round % 2));
    EXPECT_NEAR(HeadingDifferenceDeg(turned->heading / kRadPerDeg, angles.heading_deg), 0.0, 1e-3);

    const SurfacePanorama panorama = draw.Panorama();
    tilted.ForCells(panorama, *turned, [&](std::size_t i, const simd::Int4& cells) {
      for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::Vector3f& ray = rays[std::min(4 * i + k, rays.size() - 1)];
        const simd::Vec3x4 in_world = simd::Splat(Eigen::Vector3f(rotation.transpose() * ray));
        const SurfacePanorama::Places places = panorama.PlacesOf(in_world);
        if (IsBetweenCells(places.column[0]) || IsBetweenCells(places.row[0])) continue;
        ++compared;
        inside += cells[k] >= 0;
        EXPECT_EQ(cells[k], panorama.CellsAt(places)[0])
            << places.column[0] << ", " << places.row[0] << " of " << panorama.columns << " x "
            << panorama.rows;
      }
    });
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(compared - inside, 300);
}

TEST(TiltedRays, AnotherTiltIsNotFound) {
  const ViewAngles tilt{0.0, 5.0, -2.0};
  const std::vector<Eigen::Vector3f> rays{{0.0f, 0.0f, 1.0f}};
  const std::vector<Eigen::Matrix3f> rotations{RotationOf(tilt)};
  const TiltedRays tilted(rays, rotations);
  EXPECT_FALSE(tilted.Find(RotationOf({30.0, 5.01, -2.0})));
  EXPECT_FALSE(tilted.Find(RotationOf({30.0, 5.0, -1.99})));
  EXPECT_TRUE(tilted.Find(RotationOf({30.0, 5.0, -2.0})));
}

// One surface, everywhere.
class OneSurface {
 public:
  // @param azimuth_deg  Of its normal.
  OneSurface(double azimuth_deg, double rise) {
    Surface surface;
    const double a = azimuth_deg * kRadPerDeg;
    surface.normal =
        Eigen::Vector3d(std::sin(a), std::cos(a), rise).normalized().cast<float>();
    model.surfaces = {surface};
    view.surfaces.first_azimuth = -M_PI;
    view.surfaces.first_elevation = -1.5;
    view.surfaces.step = 0.1;
    view.surfaces.columns = 64;
    view.surfaces.rows = 31;
    view.surfaces.surfaces.assign(std::size_t{64} * 31, 0u);
    view.groups = GroupsOf(view.surfaces, model);
  }
  CityModel model;
  PositionView view;
};

std::vector<LineSegment> RandomLines(Draw& draw) {
  std::vector<LineSegment> segments;
  for (int i = 0; i < 30; ++i) {
    const auto point = [&] {
      return Eigen::Vector2f(draw.Between(0.0, kCamera.width), draw.Between(0.0, kCamera.height));
    };
    segments.push_back({point(), point(), 1.0f});
  }
  return segments;
}

TEST(FacadeTable, RoundsTheAzimuthOfAWallByHalfADegreeAtMost) {
  Draw draw;
  for (int round = 0; round < 60; ++round) {
    const std::vector<LineSegment> segments = RandomLines(draw);
    const auto directions =
        std::make_shared<FacadeDirections>(segments, kCamera, FacadeDirectionOptions{});
    ViewAngles angles = draw.Tilt();
    const std::vector<Eigen::Matrix3f> tilts{RotationOf(angles)};
    const FacadeTable table(directions, tilts);
    angles.heading_deg = draw.Between(0.0, 360.0);
    const Eigen::Matrix3f rotation = RotationOf(angles);
    const double azimuth = draw.Between(0.0, 360.0);
    float lowest = 1e9f;
    float highest = -1e9f;
    for (double off = -0.5; off <= 0.5; off += 0.025) {
      const OneSurface wall(azimuth + off, 0.0);
      const float ratio = directions->LogRatio(wall.view.surfaces, wall.model, rotation);
      lowest = std::min(lowest, ratio);
      highest = std::max(highest, ratio);
    }
    const OneSurface wall(azimuth, 0.0);
    const float quick =
        table.LogRatio(wall.view, wall.model, rotation, table.Find(rotation).value());
    EXPECT_GE(quick, lowest - 1e-3f);
    EXPECT_LE(quick, highest + 1e-3f);
  }
}

TEST(FacadeTable, SlopesAreNotRoundedAndFlatOnesSayNothing) {
  Draw draw;
  for (const double rise : {0.05, 0.5, 1.5, 100.0}) {
    const auto directions =
        std::make_shared<FacadeDirections>(RandomLines(draw), kCamera, FacadeDirectionOptions{});
    ViewAngles angles = draw.Tilt();
    const std::vector<Eigen::Matrix3f> tilts{RotationOf(angles)};
    const FacadeTable table(directions, tilts);
    angles.heading_deg = draw.Between(0.0, 360.0);
    const Eigen::Matrix3f rotation = RotationOf(angles);
    const OneSurface roof(draw.Between(0.0, 360.0), rise);
    const float ratio = directions->LogRatio(roof.view.surfaces, roof.model, rotation);
    EXPECT_NEAR(
        table.LogRatio(roof.view, roof.model, rotation, table.Find(rotation).value()), ratio, 1e-4);
    EXPECT_EQ(ratio == 0.0f, rise == 100.0) << rise;
  }
}

class EvidenceForTilts : public ::testing::Test, protected testing::HouseBeforeCamera {
 protected:
  static constexpr ViewAngles kTilt{0.0, 5.0, 0.0};

  std::vector<float> Values(const EvidenceScore& score, const ViewAngles& angles) const {
    const Pose pose{CamFromWorld(angles), {0.0, 0.0, 1.7}};
    const PositionView view = ViewFrom(scene_,
                                       pose.center_in_world,
                                       RangeOf(kCamera, angles, {180.0, 0.0, 0.0}, 0.5 * kRadPerDeg),
                                       score.parts());
    const auto workspace = score.NewWorkspace();
    const auto values = score.Cues(view, pose, *workspace);
    return {values.begin(), values.end()};
  }

  const ScoreOptions options_;
  const PictureEvidence picture_{Photo(), kCamera, {}, options_.evidence, 1};
  const EvidenceScore general_{{picture_, scene_, options_.evidence.cues}, options_.weights};
  const std::vector<Eigen::Matrix3f> tilts_{RotationOf(kTilt)};
  const std::unique_ptr<Score> owned_ = general_.ForTilts(tilts_);
  const EvidenceScore& quick_ = dynamic_cast<const EvidenceScore&>(*owned_);
};

TEST_F(EvidenceForTilts, IsNearlyTheSameUnderTheTilts) {
  Draw draw;
  for (int i = 0; i < 60; ++i) {
    const ViewAngles angles{draw.Between(-180.0, 180.0), kTilt.pitch_deg, kTilt.roll_deg};
    const std::vector<float> general = Values(general_, angles);
    const std::vector<float> quick = Values(quick_, angles);
    ASSERT_EQ(quick.size(), general.size());
    // A cell on the border of two surfaces may change sides.
    for (std::size_t k = 0; k < quick.size(); ++k) {
      const std::string name = general_.cue_names()[k];
      EXPECT_NEAR(quick[k] * options_.weights.at(name), general[k] * options_.weights.at(name), 0.5)
          << name << " at " << angles.heading_deg;
    }
  }
}

TEST_F(EvidenceForTilts, IsTheSameUnderAnyOther) {
  Draw draw;
  for (int i = 0; i < 20; ++i) {
    const ViewAngles angles{draw.Between(-180.0, 180.0), kTilt.pitch_deg + 0.5, 1.0};
    EXPECT_EQ(Values(quick_, angles), Values(general_, angles));
  }
}

}  // namespace
}  // namespace ridgeline
