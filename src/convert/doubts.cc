// SPDX-License-Identifier: Apache-2.0
#include "convert/doubts.h"

#include <cmath>
#include <cstddef>

#include "camera/check_pose.h"
#include "camera/pose.h"

namespace ridgeline {
namespace {

// A camera held or hung upside down; a drone that looks straight down has no up.
bool IsUpsideDown(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  return std::abs(angles.roll_deg) > 135.0 && std::abs(angles.pitch_deg) < 80.0;
}

// Angles in radians that were read as degrees are below 3.15 in each of omega, phi and kappa.
bool IsNearlyNadir(const Pose& pose) {
  constexpr double kMostDeg = 5.5;
  return RotationDistanceDeg(pose.cam_from_world, CamFromWorld(OmegaPhiKappa{})) <= kMostDeg;
}

bool IsInDegrees(const Eigen::Vector3d& p) {
  return std::abs(p.x()) <= 180.0 && std::abs(p.y()) <= 90.0 && !p.head<2>().isZero();
}

// Pictures with something in common.
class Tally {
 public:
  void Add(const Query& query) {
    if (count_++ == 0) first_ = query.id;
  }
  std::size_t count() const { return count_; }

  // "3 of 20 poses (the first: IMG_1)".
  std::string Text(std::size_t all) const {
    return std::to_string(count_) + " of " + std::to_string(all) + " poses (the first: " + first_ +
           ")";
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

}  // namespace

std::vector<std::string> DoubtsOf(const Dataset& dataset, const Eigen::Vector3d& origin) {
  constexpr double kSamePlaceM = 1e-6;
  Tally upside_down;
  Tally at_origin;
  Tally not_turned;
  Tally in_degrees;
  Tally in_one_place;
  Tally nadir;
  const Pose* first = nullptr;
  std::size_t all = 0;
  for (const Query& query : dataset.queries) {
    if (!query.truth) continue;
    ++all;
    const Pose& pose = *query.truth;
    if (first == nullptr) first = &pose;
    const Eigen::Vector3d place = pose.center_in_world - origin;
    if (IsUpsideDown(pose)) upside_down.Add(query);
    if (IsNearlyNadir(pose)) nadir.Add(query);
    if (place.norm() < kSamePlaceM) at_origin.Add(query);
    if (RotationDistanceDeg(pose.cam_from_world, Eigen::Quaterniond::Identity()) == 0.0) {
      not_turned.Add(query);
    }
    if (origin.isZero() && IsInDegrees(pose.center_in_world)) in_degrees.Add(query);
    if ((pose.center_in_world - first->center_in_world).norm() < kSamePlaceM) {
      in_one_place.Add(query);
    }
  }
  std::vector<std::string> doubts;
  if (upside_down.count() > 0) {
    doubts.push_back(upside_down.Text(all) +
                     " are upside down: are the angles of another order, or the camera axes others "
                     "(y up and z backward)?");
  }
  if (at_origin.count() > 0) {
    doubts.push_back(at_origin.Text(all) + " stand at 0, 0, 0: were they ever written?");
  }
  if (not_turned.count() > 0) {
    doubts.push_back(not_turned.Text(all) +
                     " have the rotation 1, 0, 0, 0, a camera that looks straight up: were they "
                     "ever written?");
  }
  if (in_degrees.count() > 0) {
    doubts.push_back(in_degrees.Text(all) +
                     " stand where no projected system has its numbers: are they degrees of "
                     "longitude and latitude, or relative to an origin (--origin)?");
  }
  if (all > 0 && nadir.count() == all) {
    doubts.push_back("all " + std::to_string(all) +
                     " poses look straight down with the picture's top to the north, to 5 degrees: "
                     "are their angles in radians, where degrees are expected?");
  }
  if (all > 1 && in_one_place.count() == all && at_origin.count() == 0) {
    doubts.push_back("all " + std::to_string(all) + " poses stand in one place");
  }
  return doubts;
}

void CheckPoses(const Dataset& dataset) {
  for (const Query& query : dataset.queries) {
    const std::string field = "picture " + query.image.generic_string() + ": position";
    if (query.truth) CheckPlace(query.truth->center_in_world, dataset.file.string(), field);
    if (query.prior) {
      const Eigen::Vector2d& place = query.prior->position_in_world;
      CheckPlace({place.x(), place.y(), query.prior->height_in_world.value_or(0.0)},
                 dataset.file.string(),
                 field);
    }
  }
}

}  // namespace ridgeline
