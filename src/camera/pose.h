// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ridgeline {

// Exterior orientation: x_in_camera = cam_from_world * (x_in_world - center_in_world). "World" is
// any east-north-height frame [m]: the CRS itself, or the local frame (CRS minus an origin).
// Camera axes: x right, y down, z forward.
struct Pose {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  Eigen::Vector3d center_in_world = Eigen::Vector3d::Zero();

  Eigen::Vector3d CameraFromWorld(const Eigen::Vector3d& point_in_world) const {
    return cam_from_world * (point_in_world - center_in_world);
  }
  // COLMAP's translation: x_in_camera = cam_from_world * x_in_world + translation.
  Eigen::Vector3d ColmapTranslation() const { return -(cam_from_world * center_in_world); }
};

// Heading: clockwise from grid north of the optical axis; pitch: up positive; roll: clockwise
// positive seen from behind the camera. All in degrees; a level camera has pitch = roll = 0.
struct ViewAngles {
  double heading_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};

// cam_from_world = Roll(roll) * Pitch(pitch) * Level(heading).
Eigen::Quaterniond CamFromWorld(const ViewAngles& angles);
// Heading in [0, 360), pitch in [-90, 90], roll in (-180, 180]. Looking straight up or down, the
// heading is that of the image's right side minus 90 degrees, and roll is 0.
ViewAngles ViewAnglesOf(const Eigen::Quaterniond& cam_from_world);

// Photogrammetric angles as Pix4D, Metashape, ODM and BINGO write them: world_from_photo =
// Rx(omega) Ry(phi) Rz(kappa), photo axes x right, y up, z backward. All zero: straight down, the
// top of the picture to the north. A level camera of heading h has omega = 90, phi = -h, kappa = 0.
struct OmegaPhiKappa {
  double omega_deg = 0.0;
  double phi_deg = 0.0;
  double kappa_deg = 0.0;
};

Eigen::Quaterniond CamFromWorld(const OmegaPhiKappa& angles);
// phi in [-90, 90], omega and kappa in (-180, 180]; omega = 0 where |phi| = 90.
OmegaPhiKappa OmegaPhiKappaOf(const Eigen::Quaterniond& cam_from_world);

// The angles of Loeper et al., section 4.3, which have the same names and another order:
// world_from_photo = Rz(kappa) Ry(phi) Rx(omega), photo axes as above. omega = 90, phi = 0 is
// level; heading = -kappa.
struct LoeperOmegaPhiKappa {
  double omega_deg = 0.0;
  double phi_deg = 0.0;
  double kappa_deg = 0.0;
};

Eigen::Quaterniond CamFromWorld(const LoeperOmegaPhiKappa& angles);
// phi in [-90, 90], omega and kappa in (-180, 180]; omega = 0 where |phi| = 90.
LoeperOmegaPhiKappa LoeperOmegaPhiKappaOf(const Eigen::Quaterniond& cam_from_world);

// Angle of the relative rotation [deg], in [0, 180].
double RotationDistanceDeg(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

// In [0, 360).
double WrapHeadingDeg(double heading_deg);
// a - b in [-180, 180).
double HeadingDifferenceDeg(double a_deg, double b_deg);

}  // namespace ridgeline
