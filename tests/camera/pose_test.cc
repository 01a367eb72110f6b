// SPDX-License-Identifier: Apache-2.0
#include "camera/pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace ridgeline {
namespace {

Eigen::Vector3d RightOf(const Eigen::Quaterniond& q) {
  return q.conjugate() * Eigen::Vector3d::UnitX();
}
Eigen::Vector3d DownOf(const Eigen::Quaterniond& q) {
  return q.conjugate() * Eigen::Vector3d::UnitY();
}
Eigen::Vector3d ForwardOf(const Eigen::Quaterniond& q) {
  return q.conjugate() * Eigen::Vector3d::UnitZ();
}

TEST(ViewAngles, LevelCameraLooksAlongItsHeading) {
  const Eigen::Quaterniond north = CamFromWorld(ViewAngles{0.0, 0.0, 0.0});
  EXPECT_TRUE(ForwardOf(north).isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
  EXPECT_TRUE(RightOf(north).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(DownOf(north).isApprox(Eigen::Vector3d(0, 0, -1), 1e-12));
  const Eigen::Quaterniond east = CamFromWorld(ViewAngles{90.0, 0.0, 0.0});
  EXPECT_TRUE(ForwardOf(east).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(RightOf(east).isApprox(Eigen::Vector3d(0, -1, 0), 1e-12));
}

TEST(ViewAngles, PitchIsUpAndRollIsClockwiseFromBehind) {
  const double s = std::sin(30.0 * M_PI / 180.0);
  const double c = std::cos(30.0 * M_PI / 180.0);
  EXPECT_TRUE(ForwardOf(CamFromWorld(ViewAngles{0.0, 30.0, 0.0}))
                  .isApprox(Eigen::Vector3d(0, c, s), 1e-12));
  // Clockwise from behind: the camera's right side goes down.
  EXPECT_TRUE(
      RightOf(CamFromWorld(ViewAngles{0.0, 0.0, 30.0})).isApprox(Eigen::Vector3d(c, 0, -s), 1e-12));
}

TEST(ViewAngles, RoundTripOverRandomPoses) {
  Random random(1, HashText("ViewAngles"));
  for (int i = 0; i < 1000; ++i) {
    const ViewAngles in{
        random.Uniform(0.0, 360.0), random.Uniform(-89.0, 89.0), random.Uniform(-179.0, 179.0)};
    const ViewAngles out = ViewAnglesOf(CamFromWorld(in));
    EXPECT_NEAR(HeadingDifferenceDeg(out.heading_deg, in.heading_deg), 0.0, 1e-9);
    EXPECT_NEAR(out.pitch_deg, in.pitch_deg, 1e-9);
    EXPECT_NEAR(out.roll_deg, in.roll_deg, 1e-9);
  }
}

TEST(ViewAngles, LookingStraightUpOrDownKeepsTheRotation) {
  for (const double pitch : {90.0, -90.0}) {
    const Eigen::Quaterniond q = CamFromWorld(ViewAngles{40.0, pitch, 25.0});
    const ViewAngles angles = ViewAnglesOf(q);
    EXPECT_EQ(angles.roll_deg, 0.0);
    EXPECT_NEAR(RotationDistanceDeg(CamFromWorld(angles), q), 0.0, 1e-6);
  }
}

TEST(OmegaPhiKappa, LevelIsOmega90AndHeadingIsMinusPhi) {
  for (const double heading : {0.0, 30.0, 75.0, 345.0}) {
    const OmegaPhiKappa angles = OmegaPhiKappaOf(CamFromWorld(ViewAngles{heading, 0.0, 0.0}));
    EXPECT_NEAR(angles.omega_deg, 90.0, 1e-9);
    EXPECT_NEAR(HeadingDifferenceDeg(-angles.phi_deg, heading), 0.0, 1e-9);
    EXPECT_NEAR(angles.kappa_deg, 0.0, 1e-9);
  }
}

TEST(LoeperOmegaPhiKappa, LevelIsOmega90AndHeadingIsMinusKappa) {
  for (const double heading : {0.0, 30.0, 90.0, 200.0, 345.0}) {
    const LoeperOmegaPhiKappa angles =
        LoeperOmegaPhiKappaOf(CamFromWorld(ViewAngles{heading, 0.0, 0.0}));
    EXPECT_NEAR(angles.omega_deg, 90.0, 1e-9);
    EXPECT_NEAR(angles.phi_deg, 0.0, 1e-9);
    EXPECT_NEAR(HeadingDifferenceDeg(-angles.kappa_deg, heading), 0.0, 1e-9);
  }
}

TEST(OmegaPhiKappa, NadirPictureIsAllZero) {
  // An aerial picture looking straight down with the top of the image to the north.
  const OmegaPhiKappa angles = OmegaPhiKappaOf(CamFromWorld(ViewAngles{0.0, -90.0, 0.0}));
  EXPECT_NEAR(angles.omega_deg, 0.0, 1e-6);
  EXPECT_NEAR(angles.phi_deg, 0.0, 1e-6);
  EXPECT_NEAR(angles.kappa_deg, 0.0, 1e-6);
}

TEST(OmegaPhiKappa, RoundTripOverRandomRotations) {
  Random random(2, HashText("OmegaPhiKappa"));
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
            .normalized();
    EXPECT_NEAR(RotationDistanceDeg(CamFromWorld(OmegaPhiKappaOf(q)), q), 0.0, 1e-6);
    EXPECT_NEAR(RotationDistanceDeg(CamFromWorld(LoeperOmegaPhiKappaOf(q)), q), 0.0, 1e-6);
  }
}

// Where two of the angles turn about the same axis.
TEST(OmegaPhiKappa, RoundTripAtTheGimbalLock) {
  for (const double phi : {90.0, -90.0}) {
    const Eigen::Quaterniond q = CamFromWorld(OmegaPhiKappa{20.0, phi, 35.0});
    EXPECT_EQ(OmegaPhiKappaOf(q).omega_deg, 0.0);
    EXPECT_NEAR(RotationDistanceDeg(CamFromWorld(OmegaPhiKappaOf(q)), q), 0.0, 1e-6);
    const Eigen::Quaterniond l = CamFromWorld(LoeperOmegaPhiKappa{20.0, phi, 35.0});
    EXPECT_EQ(LoeperOmegaPhiKappaOf(l).omega_deg, 0.0);
    EXPECT_NEAR(RotationDistanceDeg(CamFromWorld(LoeperOmegaPhiKappaOf(l)), l), 0.0, 1e-6);
  }
}

TEST(Pose, ColmapTranslationGivesTheSamePoint) {
  Pose pose{CamFromWorld(ViewAngles{33.0, -4.0, 2.0}), {10.0, 20.0, 3.0}};
  const Eigen::Vector3d point(14.0, 50.0, 8.0);
  EXPECT_TRUE(pose.CameraFromWorld(point).isApprox(
      pose.cam_from_world * point + pose.ColmapTranslation(), 1e-12));
}

TEST(RotationDistance, IsTheAngleAndIgnoresTheSign) {
  const Eigen::Quaterniond a = CamFromWorld(ViewAngles{10.0, 0.0, 0.0});
  Eigen::Quaterniond b = CamFromWorld(ViewAngles{27.0, 0.0, 0.0});
  EXPECT_NEAR(RotationDistanceDeg(a, b), 17.0, 1e-9);
  b.coeffs() *= -1.0;
  EXPECT_NEAR(RotationDistanceDeg(a, b), 17.0, 1e-9);
}

TEST(Heading, WrapsAtFullCircle) {
  EXPECT_DOUBLE_EQ(WrapHeadingDeg(-10.0), 350.0);
  EXPECT_DOUBLE_EQ(WrapHeadingDeg(720.0), 0.0);
  EXPECT_LT(WrapHeadingDeg(-1e-17), 360.0);
  EXPECT_DOUBLE_EQ(HeadingDifferenceDeg(1.0, 359.0), 2.0);
  EXPECT_DOUBLE_EQ(HeadingDifferenceDeg(359.0, 1.0), -2.0);
}

}  // namespace
}  // namespace ridgeline
