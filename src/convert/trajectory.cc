// SPDX-License-Identifier: Apache-2.0
#include "convert/trajectory.h"

#include "base/decimals.h"

namespace ridgeline {

std::string TumTrajectory(const Dataset& dataset) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  if (!dataset.crs.empty()) text += "# east, north, height in " + dataset.crs + "\n";
  std::size_t time = 0;
  for (const Query& query : dataset.queries) {
    if (!query.truth) continue;
    const Eigen::Vector3d& p = query.truth->center_in_world;
    const Eigen::Quaterniond q = query.truth->cam_from_world.conjugate();
    text += "# " + query.id + "\n" + std::to_string(time++);
    for (const double number : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += ' ' + ShortestText(number == 0.0 ? 0.0 : number);
    }
    text += '\n';
  }
  return text;
}

}  // namespace ridgeline
