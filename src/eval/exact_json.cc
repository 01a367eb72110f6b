// SPDX-License-Identifier: Apache-2.0
#include "eval/exact_json.h"

#include "base/options.h"

namespace ridgeline::exact {

Json Of(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.cam_from_world;
  return {{"position", Of(pose.center_in_world)},
          {"cam_from_world_wxyz", {Of(q.w()), Of(q.x()), Of(q.y()), Of(q.z())}}};
}

Pose PoseOf(const Json& json) {
  const std::vector<double> q = ListOf<double>(json.at("cam_from_world_wxyz"));
  return {Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3)),
          MatrixOf<Eigen::Vector3d>(json.at("position"))};
}

Json Of(const PosePrior& prior) {
  return {{"position", Of(prior.position_in_world)},
          {"height", Of(prior.height_in_world)},
          {"heading_deg", Of(prior.heading_deg)},
          {"pitch_deg", Of(prior.pitch_deg)},
          {"roll_deg", Of(prior.roll_deg)}};
}

PosePrior PriorOf(const Json& json) {
  return {MatrixOf<Eigen::Vector2d>(json.at("position")),
          OptionalOf(json.at("height")),
          OptionalOf(json.at("heading_deg")),
          OptionalOf(json.at("pitch_deg")),
          OptionalOf(json.at("roll_deg"))};
}

Json Of(const PoseSpaceOptions& ranges) {
  PoseSpaceOptions copy = ranges;
  return Json::parse(OptionsToJson([&](OptionVisitor& v) { copy.Visit(v); }));
}

PoseSpaceOptions RangesOf(const Json& json) {
  PoseSpaceOptions ranges;
  OptionsFromJson(json.dump(), "ranges", [&](OptionVisitor& v) { ranges.Visit(v); });
  return ranges;
}

Json Of(const EnergyMap& map) {
  return {{"first", Of(map.first)},
          {"spacing_m", Of(map.spacing_m)},
          {"columns", map.columns},
          {"rows", map.rows},
          {"energies", Of(map.energies)},
          {"headings_deg", Of(map.headings_deg)}};
}

EnergyMap MapOf(const Json& json) {
  return {MatrixOf<Eigen::Vector2d>(json.at("first")),
          DoubleOf(json.at("spacing_m")),
          json.at("columns").get<int>(),
          json.at("rows").get<int>(),
          ListOf<float>(json.at("energies")),
          ListOf<float>(json.at("headings_deg"))};
}

}  // namespace ridgeline::exact
