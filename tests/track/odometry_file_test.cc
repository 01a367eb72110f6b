// SPDX-License-Identifier: Apache-2.0
#include "track/odometry_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/random.h"
#include "track/odometry_check.h"
#include "track/pose_vector.h"
#include "track/track_errors.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;

Odometry Read(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("ridgeline_odometry_" + std::to_string(::getpid()) + ".txt");
  WriteFileAtomically(path, text);
  try {
    const Odometry odometry = ReadOdometry(path);
    std::filesystem::remove(path);
    return odometry;
  } catch (...) {
    std::filesystem::remove(path);
    throw;
  }
}

std::string ErrorOf(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A way with turns, as world poses.
std::vector<Pose> Way() {
  std::vector<Pose> way;
  Pose pose;
  pose.cam_from_world = CamFromWorld(ViewAngles{30.0, 2.0, -1.0});
  pose.center_in_world = {100.0, 200.0, 5.0};
  for (int i = 0; i < 6; ++i) {
    way.push_back(pose);
    Motion motion;
    motion.step_in_before = {0.1 * i, -0.02, 3.0 + 0.2 * i};
    motion.now_from_before = CamFromWorld(ViewAngles{30.0 + 4.0 * i, 2.0, -1.0}) *
                             CamFromWorld(ViewAngles{30.0, 2.0, -1.0}).conjugate();
    pose = Moved(pose, motion);
  }
  return way;
}

void ExpectSame(const Motion& a, const Motion& b, double within_m = 1e-4) {
  EXPECT_LT((a.step_in_before - b.step_in_before).norm(), within_m);
  EXPECT_LT(RotationDistanceDeg(a.now_from_before, b.now_from_before), 0.01);
}

std::string TumOf(const std::vector<Pose>& way) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Eigen::Quaterniond q = way[i].cam_from_world.conjugate();
    const Eigen::Vector3d& p = way[i].center_in_world;
    char line[200];
    std::snprintf(line, sizeof line, "%zu %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", i, p.x(), p.y(),
                  p.z(), q.x(), q.y(), q.z(), q.w());
    text += line;
  }
  return text;
}

TEST(OdometryFile, TumGivesTheMotionsByTimeAndBetweenRows) {
  const std::vector<Pose> way = Way();
  const Odometry odometry = Read(TumOf(way));
  EXPECT_EQ(odometry.format, "TUM");
  const std::vector<FrameKey> keys = {{"a", 0.0}, {"b", 1.0}, {"c", 3.0}, {"d", 3.5}, {"e", 9.0}};
  const std::vector<FrameMotion> motions = MotionsOf(odometry, keys);
  EXPECT_FALSE(motions[0].motion);
  ExpectSame(*motions[1].motion, MotionBetween(way[0], way[1]));
  ExpectSame(*motions[2].motion, MotionBetween(way[1], way[3]));
  EXPECT_NEAR(motions[3].motion->step_in_before.norm(),
              0.5 * MotionBetween(way[3], way[4]).step_in_before.norm(),
              1e-3);
  EXPECT_FALSE(motions[4].motion);
  EXPECT_THAT(motions[4].missing, HasSubstr("no pose of this frame"));
  EXPECT_GT(motions[2].motion->sigma_m, motions[1].motion->sigma_m);
}

TEST(OdometryFile, KittiGoesByOrder) {
  const std::vector<Pose> way = Way();
  std::string text;
  for (const Pose& pose : way) {
    const Eigen::Matrix3d r = pose.cam_from_world.toRotationMatrix().transpose();
    for (int row = 0; row < 3; ++row) {
      char part[120];
      std::snprintf(part, sizeof part, "%.9f %.9f %.9f %.9f ", r(row, 0), r(row, 1), r(row, 2),
                    pose.center_in_world(row));
      text += part;
    }
    text += '\n';
  }
  const Odometry odometry = Read(text);
  EXPECT_EQ(odometry.format, "KITTI");
  std::vector<FrameKey> keys(way.size());
  const std::vector<FrameMotion> motions = MotionsOf(odometry, keys);
  for (std::size_t i = 1; i < way.size(); ++i) {
    ExpectSame(*motions[i].motion, MotionBetween(way[i - 1], way[i]));
  }
}

TEST(OdometryFile, CsvGoesByIdOverFramesThatAreMissing) {
  const std::vector<Pose> way = Way();
  std::string text = "id,dx_m,dy_m,dz_m,qw,qx,qy,qz,sigma_m,sigma_deg\n";
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Motion m = MotionBetween(way[i - 1], way[i]);
    const Eigen::Quaterniond q = m.now_from_before.conjugate();
    char line[240];
    std::snprintf(line, sizeof line, "f%zu,%.7f,%.7f,%.7f,%.9f,%.9f,%.9f,%.9f,0.3,0.4\n", i,
                  m.step_in_before.x(), m.step_in_before.y(), m.step_in_before.z(), q.w(), q.x(),
                  q.y(), q.z());
    text += line;
  }
  const Odometry odometry = Read(text);
  EXPECT_EQ(odometry.format, "CSV");
  const std::vector<FrameKey> keys = {{"f0", {}}, {"f1", {}}, {"f4", {}}};
  const std::vector<FrameMotion> motions = MotionsOf(odometry, keys);
  ExpectSame(*motions[1].motion, MotionBetween(way[0], way[1]));
  ExpectSame(*motions[2].motion, MotionBetween(way[1], way[4]));
  EXPECT_NEAR(motions[1].motion->sigma_m, 0.3, 1e-9);
  EXPECT_NEAR(motions[2].motion->sigma_m, 0.3 * std::sqrt(3.0), 1e-9);
}

TEST(OdometryFile, ErrorsNameTheLine) {
  EXPECT_THAT(ErrorOf("1 2 3\n"), HasSubstr("line 1: got 3 words"));
  EXPECT_THAT(ErrorOf("0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n"), HasSubstr("times that rise"));
  EXPECT_THAT(ErrorOf("0 0 0 0 1 1 1 1\n"), HasSubstr("a unit quaternion"));
  EXPECT_THAT(ErrorOf("0 0 0 x 0 0 0 1\n"), HasSubstr("\"x\""));
  EXPECT_THAT(ErrorOf("1 0 0 0 0 2 0 0 0 0 1 0\n"), HasSubstr("no rotation"));
  EXPECT_THAT(ErrorOf("id,dx_m\n"), HasSubstr("no column dy_m"));
  EXPECT_THAT(ErrorOf("id,dx_mm\n"), HasSubstr("such as dx_m"));
  EXPECT_THAT(ErrorOf("# nothing\n"), HasSubstr("no rows"));
}

TEST(OdometryCheck, FindsTheAxesAndTheScale) {
  // Odometry of a vehicle (x forward, y left, z up) in feet.
  Eigen::Matrix3d body_from_camera;
  body_from_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const std::vector<Pose> way = Way();
  OdometryCheck check;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) {
      Motion m = MotionBetween(way[i - 1], way[i]);
      m.step_in_before = body_from_camera * m.step_in_before / 0.3048;
      m.now_from_before = Eigen::Quaterniond(
          body_from_camera * m.now_from_before.toRotationMatrix() * body_from_camera.transpose());
      check.Add(m);
    }
    check.Add(way[i]);
  }
  const auto finding = check.Find();
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->axes, OdometryAxes::kBody);
  EXPECT_NEAR(finding->scale, 0.3048, 0.01);
}

TEST(OdometryCheck, HasNothingToSayOfGoodOdometry) {
  const std::vector<Pose> way = Way();
  OdometryCheck check;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) check.Add(MotionBetween(way[i - 1], way[i]));
    check.Add(way[i]);
  }
  EXPECT_FALSE(check.Find());
}

TEST(OdometryCheck, DoesNotBelieveWhatPicturesSayAtRandom) {
  // A long straight way of which the pictures give one pose in three; the others are found anywhere
  // within 20 m, along the same street.
  int findings = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed, 1);
    OdometryCheck check;
    Pose before;
    for (int i = 0; i < 12; ++i) {
      PoseVector v;
      v << 0.0, 4.0 * i, 2.0, 0.0, 0.0, 0.0;
      const Pose now = PoseOf(v);
      if (i > 0) check.Add(MotionBetween(before, now));
      before = now;
      if (i % 3 != 0) v(1) += random.Uniform(-20.0, 20.0);
      check.Add(PoseOf(v));
      findings += check.Find() ? 1 : 0;
    }
  }
  EXPECT_LE(findings, 2);
}

TEST(Motion, ComposesAsPosesDo) {
  const std::vector<Pose> way = Way();
  const Motion both =
      Composed(MotionBetween(way[0], way[1]), MotionBetween(way[1], way[3]));
  ExpectSame(both, MotionBetween(way[0], way[3]), 1e-9);
}

TEST(TrackErrors, AreThoseOfTheSlamLiterature) {
  const std::vector<Pose> way = Way();
  std::vector<std::optional<Pose>> truths(way.begin(), way.end());
  std::vector<std::optional<Pose>> poses = truths;
  for (auto& pose : poses) pose->center_in_world.x() += 2.0;  // a constant offset
  poses[5].reset();
  const TrackErrors errors = ErrorsOf(poses, truths);
  EXPECT_EQ(errors.frames, 6u);
  EXPECT_EQ(errors.posed, 5u);
  EXPECT_NEAR(errors.ate_rmse_m, 2.0, 1e-9);
  EXPECT_NEAR(errors.rpe_rmse_m, 0.0, 1e-9);
  EXPECT_EQ(errors.steps, 4u);
  EXPECT_EQ(errors.within_1m, 0.0);
  EXPECT_NEAR(errors.within_3m, 5.0 / 6.0, 1e-9);
}

}  // namespace
}  // namespace ridgeline
