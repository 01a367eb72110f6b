// SPDX-License-Identifier: Apache-2.0
#include "camera/pose.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"

namespace ridgeline {
namespace {

Eigen::Matrix3d RotationX(double rad) {
  return Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitX()).toRotationMatrix();
}
Eigen::Matrix3d RotationY(double rad) {
  return Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
}
Eigen::Matrix3d RotationZ(double rad) {
  return Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

// Below this cosine of the pitch (about 0.06 arc seconds from the vertical) heading and roll turn
// about the same axis.
constexpr double kGimbalCosine = 3e-7;

// Photo axes are x right, y up, z backward; the camera's x right, y down, z forward.
Eigen::Quaterniond CamFromWorldOfPhoto(const Eigen::Matrix3d& world_from_photo) {
  const Eigen::Matrix3d cam_from_photo = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return Eigen::Quaterniond(cam_from_photo * world_from_photo.transpose()).normalized();
}

Eigen::Matrix3d WorldFromPhoto(const Eigen::Quaterniond& cam_from_world) {
  const Eigen::Matrix3d cam_from_photo = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return cam_from_world.normalized().toRotationMatrix().transpose() * cam_from_photo;
}

}  // namespace

Eigen::Quaterniond CamFromWorld(const ViewAngles& angles) {
  const double h = angles.heading_deg * kRadPerDeg;
  // Rows: right, down and forward of a level camera in east, north, height.
  Eigen::Matrix3d level;
  level << std::cos(h), -std::sin(h), 0.0, 0.0, 0.0, -1.0, std::sin(h), std::cos(h), 0.0;
  return Eigen::Quaterniond(RotationZ(-angles.roll_deg * kRadPerDeg) *
                            RotationX(-angles.pitch_deg * kRadPerDeg) * level)
      .normalized();
}

ViewAngles ViewAnglesOf(const Eigen::Quaterniond& cam_from_world) {
  const Eigen::Matrix3d r = cam_from_world.normalized().toRotationMatrix();
  const Eigen::Vector3d right = r.row(0);
  const Eigen::Vector3d down = r.row(1);
  const Eigen::Vector3d forward = r.row(2);
  const double horizontal = std::hypot(forward.x(), forward.y());
  ViewAngles angles;
  angles.pitch_deg = std::atan2(forward.z(), horizontal) / kRadPerDeg;
  if (horizontal < kGimbalCosine) {
    angles.heading_deg = WrapHeadingDeg(std::atan2(-right.y(), right.x()) / kRadPerDeg);
    return angles;
  }
  angles.heading_deg = WrapHeadingDeg(std::atan2(forward.x(), forward.y()) / kRadPerDeg);
  angles.roll_deg = std::atan2(-right.z(), -down.z()) / kRadPerDeg;
  return angles;
}

Eigen::Quaterniond CamFromWorld(const OmegaPhiKappa& angles) {
  return CamFromWorldOfPhoto(RotationX(angles.omega_deg * kRadPerDeg) *
                             RotationY(angles.phi_deg * kRadPerDeg) *
                             RotationZ(angles.kappa_deg * kRadPerDeg));
}

OmegaPhiKappa OmegaPhiKappaOf(const Eigen::Quaterniond& cam_from_world) {
  const Eigen::Matrix3d r = WorldFromPhoto(cam_from_world);
  const double cos_phi = std::hypot(r(0, 0), r(0, 1));
  OmegaPhiKappa angles;
  angles.phi_deg = std::atan2(r(0, 2), cos_phi) / kRadPerDeg;
  if (cos_phi < kGimbalCosine) {
    angles.kappa_deg = std::atan2(r(1, 0), r(1, 1)) / kRadPerDeg;
    return angles;
  }
  angles.omega_deg = std::atan2(-r(1, 2), r(2, 2)) / kRadPerDeg;
  angles.kappa_deg = std::atan2(-r(0, 1), r(0, 0)) / kRadPerDeg;
  return angles;
}

Eigen::Quaterniond CamFromWorld(const LoeperOmegaPhiKappa& angles) {
  return CamFromWorldOfPhoto(RotationZ(angles.kappa_deg * kRadPerDeg) *
                             RotationY(angles.phi_deg * kRadPerDeg) *
                             RotationX(angles.omega_deg * kRadPerDeg));
}

LoeperOmegaPhiKappa LoeperOmegaPhiKappaOf(const Eigen::Quaterniond& cam_from_world) {
  const Eigen::Matrix3d r = WorldFromPhoto(cam_from_world);
  const double cos_phi = std::hypot(r(2, 1), r(2, 2));
  LoeperOmegaPhiKappa angles;
  angles.phi_deg = std::atan2(-r(2, 0), cos_phi) / kRadPerDeg;
  if (cos_phi < kGimbalCosine) {
    angles.kappa_deg = std::atan2(-r(0, 1), r(1, 1)) / kRadPerDeg;
    return angles;
  }
  angles.omega_deg = std::atan2(r(2, 1), r(2, 2)) / kRadPerDeg;
  angles.kappa_deg = std::atan2(r(1, 0), r(0, 0)) / kRadPerDeg;
  return angles;
}

double RotationDistanceDeg(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond relative = a.conjugate() * b;
  return 2.0 * std::atan2(relative.vec().norm(), std::abs(relative.w())) / kRadPerDeg;
}

double WrapHeadingDeg(double heading_deg) {
  const double wrapped = heading_deg - 360.0 * std::floor(heading_deg / 360.0);
  return wrapped < 360.0 ? wrapped : 0.0;
}

double HeadingDifferenceDeg(double a_deg, double b_deg) {
  return WrapHeadingDeg(a_deg - b_deg + 180.0) - 180.0;
}

}  // namespace ridgeline
