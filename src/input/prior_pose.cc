// SPDX-License-Identifier: Apache-2.0
#include "input/prior_pose.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/error.h"
#include "city/crs.h"

namespace ridgeline {

std::optional<Pose> PoseOfPrior(const PosePrior& prior,
                                const HeightGrid* terrain,
                                const Eigen::Vector3d& origin_in_world,
                                double camera_height_m) {
  std::optional<double> height = prior.height_in_world;
  if (!height && terrain != nullptr) {
    const std::optional<double> ground =
        terrain->HeightAt(prior.position_in_world - origin_in_world.head<2>());
    if (ground) height = origin_in_world.z() + *ground + camera_height_m;
  }
  if (!height) return std::nullopt;
  Pose pose;
  pose.center_in_world = {prior.position_in_world.x(), prior.position_in_world.y(), *height};
  pose.cam_from_world = CamFromWorld(ViewAngles{prior.heading_deg.value_or(0.0),
                                                prior.pitch_deg.value_or(0.0),
                                                prior.roll_deg.value_or(0.0)});
  return pose;
}

namespace {

// "0.523599 deg as written; ..." for a heading that a person would hardly write in degrees: small,
// and with more decimals than a direction has.
std::optional<std::string> RadiansText(double heading_deg) {
  const double turn = heading_deg > 180.0 ? heading_deg - 360.0 : heading_deg;
  const double thousandths = turn * 1000.0;
  const bool few_decimals = std::abs(thousandths - std::round(thousandths)) < 1e-6;
  if (few_decimals || std::abs(turn) > 2.0 * std::numbers::pi) return std::nullopt;
  char text[120];
  std::snprintf(text,
                sizeof text,
                "%.6g deg as written; if that is radians, write %.1f",
                turn,
                WrapHeadingDeg(turn * 180.0 / std::numbers::pi));
  return text;
}

}  // namespace

std::vector<Assumption> AssumptionsOf(const PosePrior& prior,
                                      double camera_height_m,
                                      const std::string& source) {
  std::vector<Assumption> assumptions;
  if (!prior.height_in_world) {
    char text[64];
    std::snprintf(text, sizeof text, "terrain + %.1f m assumed", camera_height_m);
    assumptions.push_back({"height", text, source});
  }
  if (!prior.heading_deg) {
    assumptions.push_back({"heading", "not given; all directions are searched", source});
  } else if (const auto doubt = RadiansText(*prior.heading_deg)) {
    assumptions.push_back({"heading", *doubt, source});
  }
  if (!prior.pitch_deg && !prior.roll_deg) {
    assumptions.push_back({"pitch, roll", "not given; held level assumed", source});
  } else if (!prior.pitch_deg) {
    assumptions.push_back({"pitch", "not given; level assumed", source});
  } else if (!prior.roll_deg) {
    assumptions.push_back({"roll", "not given; upright assumed", source});
  }
  return assumptions;
}

bool IsInDegrees(const PosePrior& prior) {
  const Eigen::Vector2d& p = prior.position_in_world;
  return p.cwiseAbs().maxCoeff() <= 180.0 && p.cwiseAbs().minCoeff() <= 90.0 && !p.isZero();
}

void CheckPosition(const PosePrior& prior, const Crs& crs, const std::string& source) {
  if (!IsInDegrees(prior) || crs.horizontal_epsg == 0) return;
  const Eigen::Vector2d& p = prior.position_in_world;
  char found[80];
  std::snprintf(
      found, sizeof found, "%.6f, %.6f, a latitude and a longitude as it seems", p.x(), p.y());
  std::string meant;
  if (const auto place = EastNorth(crs, p.x(), p.y()); place && std::abs(p.x()) <= 90.0) {
    char text[80];
    std::snprintf(text, sizeof text, " (such as %.2f, %.2f)", place->x(), place->y());
    meant = text;
  }
  throw InputError(
      source, "position", found, "easting, northing in " + CrsName(crs) + " [m]" + meant);
}

}  // namespace ridgeline
