// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "base/options.h"
#include "camera/pose.h"
#include "camera/pose_prior.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "projection/scene.h"

namespace ridgeline {

// Half-ranges of the search around the prior; 0: the parameter is fixed.
struct PoseSpaceOptions {
  double east_m = 10.0;
  double north_m = 10.0;
  double height_m = 0.0;
  double heading_deg = 20.0;
  // As far as hands hold cameras: the picture's own vertical lines say where in it (gravity.h).
  double pitch_deg = 20.0;
  double roll_deg = 12.0;
  // How far a prior's pitch and roll are usually off [deg]: the scale of a Cauchy distribution.
  double tilt_scale_deg = 8.0;
  // Height of the camera above the terrain where the prior has no height [m], and how far it may
  // be off then at least: one standard deviation.
  double camera_height_m = kCameraHeightM;
  double camera_height_range_m = 0.5;
  // Whether poses in a building's footprint and off the DTM are skipped.
  bool free_space = true;

  bool operator==(const PoseSpaceOptions&) const = default;
  void Visit(OptionVisitor& v) {
    v.Field("east_m", east_m, Closed(0.0, 1000.0));
    v.Field("north_m", north_m, Closed(0.0, 1000.0));
    v.Field("height_m", height_m, Closed(0.0, 1000.0));
    v.Field("heading_deg", heading_deg, Closed(0.0, 180.0));
    v.Field("pitch_deg", pitch_deg, Closed(0.0, 90.0));
    v.Field("roll_deg", roll_deg, Closed(0.0, 180.0));
    v.Field("tilt_scale_deg", tilt_scale_deg, Positive());
    v.Field("camera_height_m", camera_height_m, LeftOpen(0.0, 1000.0));
    v.Field("camera_height_range_m", camera_height_range_m, Closed(0.0, 1000.0));
    v.Field("free_space", free_space);
  }
};

// The poses that a prior and the terrain allow, as offsets from the prior. Heights follow the prior
// where it has one, else the terrain.
class PoseSpace {
 public:
  // Offsets from the prior: metres and degrees.
  struct Offset {
    double east_m = 0.0;
    double north_m = 0.0;
    double height_m = 0.0;
    double heading_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
  };

  // `scene`, `dtm` and `footprints` must outlive the space; `dtm` may be null if the prior has a
  // height. A prior without heading opens the whole circle. Throws InputError for a prior that is not
  // finite, that has neither height nor DTM, or that the DTM does not cover.
  PoseSpace(const PosePrior& prior,
            const PoseSpaceOptions& options,
            const Scene& scene,
            const HeightGrid* dtm,
            const Footprints& footprints);

  // The same freedom around another place and heading, as an offset; heights follow the prior's, or
  // the terrain, plus that of the offset.
  PoseSpace MovedTo(const Offset& offset) const;

  bool IsInBuilding(const Eigen::Vector3d& position) const;

  const PoseSpaceOptions& ranges() const { return ranges_; }
  const ViewAngles& center_angles() const { return angles_; }
  const Eigen::Vector2d& center() const { return center_; }  // local [m]

  // Projection centre (local) at an offset; nullopt: not admissible.
  std::optional<Eigen::Vector3d> PositionAt(double east_m, double north_m, double height_m) const;
  // The height offset of the place there that is as high above the ground as the prior; nullopt:
  // the DTM does not cover it. Without a DTM the ground is level.
  std::optional<double> SameHeightAboveGround(double east_m, double north_m) const;
  ViewAngles AnglesAt(const Offset& offset) const;
  // Log of the prior's density at an offset against that at the prior.
  double LogPrior(const Offset& offset) const;
  // Pose in the local frame; nullopt: not admissible.
  std::optional<Pose> PoseAt(const Offset& offset) const;

 private:
  PoseSpaceOptions ranges_;
  const Scene* scene_;
  const HeightGrid* dtm_;
  const Footprints* footprints_;
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();
  std::optional<double> height_;  // local; absent: terrain + camera height
  ViewAngles angles_;
};

// Of two offsets: the distance of the places [m], and the norm of the differences of the angles [deg].
double DistanceM(const PoseSpace::Offset& a, const PoseSpace::Offset& b);
double AngleDeg(const PoseSpace::Offset& a, const PoseSpace::Offset& b);

}  // namespace ridgeline
