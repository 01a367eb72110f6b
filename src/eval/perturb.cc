// SPDX-License-Identifier: Apache-2.0
#include "eval/perturb.h"

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {

Perturbation ParsePerturbation(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> values;
  std::string field;
  while (std::getline(stream, field, ',')) {
    std::size_t used = 0;
    double value = -1.0;
    try {
      value = std::stod(field, &used);
    } catch (const std::exception&) {
      used = std::string::npos;
    }
    if (used != field.size() || !std::isfinite(value) || value < 0.0) {
      throw InputError("--perturb", "", "\"" + text + "\"", "numbers >= 0, e.g. 10,10,0,20");
    }
    values.push_back(value);
  }
  if (values.size() != 4 && values.size() != 6) {
    throw InputError("--perturb",
                     "",
                     "\"" + text + "\"",
                     "east,north,height,heading or east,north,height,heading,pitch,roll");
  }
  values.resize(6, 0.0);
  return {values[0], values[1], values[2], values[3], values[4], values[5]};
}

PosePrior DrawPrior(const Pose& truth,
                    const Perturbation& half_ranges,
                    std::uint64_t seed,
                    const std::string& query_id) {
  Random random(seed, HashText(query_id));
  std::array<double, 6> unit{};
  for (double& u : unit) u = random.Uniform(-1.0, 1.0);
  const ViewAngles angles = ViewAnglesOf(truth.cam_from_world);
  const Eigen::Vector3d& center = truth.center_in_world;
  PosePrior prior;
  prior.position_in_world = {center.x() + unit[0] * half_ranges.east_m,
                             center.y() + unit[1] * half_ranges.north_m};
  prior.height_in_world = center.z() + unit[2] * half_ranges.height_m;
  prior.heading_deg = WrapHeadingDeg(angles.heading_deg + unit[3] * half_ranges.heading_deg);
  prior.pitch_deg = angles.pitch_deg + unit[4] * half_ranges.pitch_deg;
  prior.roll_deg = angles.roll_deg + unit[5] * half_ranges.roll_deg;
  return prior;
}

}  // namespace ridgeline
