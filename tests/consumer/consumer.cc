// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include "camera/pose.h"
#include "localize/localizer_options.h"

int main() {
  ridgeline::LocalizerOptions options;
  options.Validate();
  const Eigen::Vector3d axis =
      ridgeline::CamFromWorld(ridgeline::ViewAngles{90.0, 0.0, 0.0}).conjugate() *
      Eigen::Vector3d::UnitZ();
  std::printf("heading 90 looks along (%.0f, %.0f, %.0f)\n", axis.x(), axis.y(), axis.z());
  return std::abs(axis.x() - 1.0) < 1e-9 ? 0 : 1;
}
