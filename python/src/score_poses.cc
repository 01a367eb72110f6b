// SPDX-License-Identifier: Apache-2.0
#include "score_poses.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <tuple>

#include "base/parallel.h"

namespace ridgeline::python {
namespace {

std::tuple<double, double, double> KeyOf(const Pose& pose) {
  const Eigen::Vector3d& c = pose.center_in_world;
  return {c.z(), c.y(), c.x()};
}

// The directions that the poses of a place can see.
PanoramaRange RangeOver(std::span<const Pose> poses, const PinholeCamera& camera, double step) {
  const ViewAngles center = ViewAnglesOf(poses[poses.size() / 2].cam_from_world);
  ViewAngles half;
  for (const Pose& pose : poses) {
    const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
    half.heading_deg = std::max(
        half.heading_deg, std::abs(HeadingDifferenceDeg(angles.heading_deg, center.heading_deg)));
    half.pitch_deg = std::max(half.pitch_deg, std::abs(angles.pitch_deg - center.pitch_deg));
    half.roll_deg = std::max(half.roll_deg,
                             std::abs(HeadingDifferenceDeg(angles.roll_deg, center.roll_deg)));
  }
  return RangeOf(camera, center, half, step);
}

}  // namespace

PoseGroups GroupsOf(std::span<const Pose> poses) {
  PoseGroups groups;
  groups.order.resize(poses.size());
  std::iota(groups.order.begin(), groups.order.end(), std::size_t{0});
  const auto before = [&](std::size_t a, std::size_t b) { return KeyOf(poses[a]) < KeyOf(poses[b]); };
  if (!std::is_sorted(groups.order.begin(), groups.order.end(), before)) {
    std::stable_sort(groups.order.begin(), groups.order.end(), before);
  }
  groups.poses.reserve(poses.size());
  for (const std::size_t i : groups.order) {
    if (groups.poses.empty() || KeyOf(groups.poses.back()) != KeyOf(poses[i])) {
      groups.places.push_back({groups.poses.size(), 0});
    }
    ++groups.places.back().count;
    groups.poses.push_back(poses[i]);
  }
  return groups;
}

void ForEachPlace(const Score& score,
                  const Scene& scene,
                  const PinholeCamera& camera,
                  double surface_step_deg,
                  const PoseGroups& groups,
                  int threads,
                  const JudgePlace& judge) {
  const double step = surface_step_deg * std::numbers::pi / 180.0;
  ParallelFor(groups.places.size(), threads, [&](std::size_t p) {
    const PlaceGroup& place = groups.places[p];
    const std::span<const Pose> poses(groups.poses.data() + place.first, place.count);
    const std::span<const std::size_t> indices(groups.order.data() + place.first, place.count);
    const std::unique_ptr<Score::Workspace> workspace = score.NewWorkspace();
    const PositionView view = ViewFrom(scene,
                                       poses.front().center_in_world,
                                       RangeOver(poses, camera, step),
                                       score.parts());
    judge(view, poses, indices, *workspace);
  });
}

}  // namespace ridgeline::python
