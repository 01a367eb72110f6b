// SPDX-License-Identifier: Apache-2.0
#include "eval/pose_json.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/decimals.h"
#include "camera/local_frame.h"
#include "city/crs.h"
#include "eval/binomial.h"
#include "eval/distinct_modes.h"

namespace ridgeline {
namespace {

using Json = nlohmann::ordered_json;

// To 0.1 mm and 1e-9 of an angle or quaternion: what is written is what can be meant.
double Metres(double value) { return RoundedTo(value, 4); }
double Fine(double value) { return RoundedTo(value, 9); }

Json JsonOf(const Eigen::Vector3d& v) { return {Metres(v.x()), Metres(v.y()), Metres(v.z())}; }

Json JsonOf(const Pose& pose, const CityModel& model) {
  const Eigen::Quaterniond& q = pose.cam_from_world;
  const ViewAngles view = ViewAnglesOf(q);
  const OmegaPhiKappa photo = OmegaPhiKappaOf(q);
  const LoeperOmegaPhiKappa loeper = LoeperOmegaPhiKappaOf(q);
  const Pose relative = LocalFrame{model.origin_in_world}.FromWorld(pose);
  Json json;
  json["position"] = JsonOf(pose.center_in_world);
  json["cam_from_world_wxyz"] = {Fine(q.w()), Fine(q.x()), Fine(q.y()), Fine(q.z())};
  json["heading_deg"] = Fine(view.heading_deg);
  json["pitch_deg"] = Fine(view.pitch_deg);
  json["roll_deg"] = Fine(view.roll_deg);
  json["omega_phi_kappa_deg"] = {Fine(photo.omega_deg), Fine(photo.phi_deg), Fine(photo.kappa_deg)};
  json["loeper_omega_phi_kappa_deg"] = {
      Fine(loeper.omega_deg), Fine(loeper.phi_deg), Fine(loeper.kappa_deg)};
  json["colmap"] = {{"origin", JsonOf(model.origin_in_world)},
                    {"translation", JsonOf(relative.ColmapTranslation())}};
  if (model.crs.horizontal_epsg != 0) {
    const auto place = LatitudeLongitude(model.crs, pose.center_in_world.head<2>());
    if (place) {
      json["wgs84"] = {{"latitude_deg", Fine(place->x())}, {"longitude_deg", Fine(place->y())}};
    }
  }
  return json;
}

Json JsonOf(const std::vector<Assumption>& assumptions) {
  Json json = Json::array();
  for (const Assumption& assumption : assumptions) {
    json.push_back(
        {{"what", assumption.what}, {"value", assumption.value}, {"source", assumption.source}});
  }
  return json;
}

// Semi-axes of the 95 % ellipse and the direction of the longer one.
Json EllipseJson(const PoseSpread& spread) {
  constexpr double kChiSquare95 = 5.991464547107979;  // two degrees of freedom
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread.position_covariance);
  const Eigen::Vector2d longest = solver.eigenvectors().col(1);
  const double direction =
      std::fmod(WrapHeadingDeg(std::atan2(longest.x(), longest.y()) * 180.0 / M_PI), 180.0);
  return {{"semi_major_m", Metres(std::sqrt(kChiSquare95 * solver.eigenvalues()(1)))},
          {"semi_minor_m", Metres(std::sqrt(kChiSquare95 * solver.eigenvalues()(0)))},
          {"major_axis_deg", Metres(direction)},
          {"heading_plus_minus_deg", Metres(kNormal95 * spread.heading_sigma_deg)}};
}

// Rows of east, north, height [m], heading, pitch, roll [deg].
Json JsonOf(const Eigen::Matrix<double, 6, 6>& covariance) {
  Json rows = Json::array();
  for (int i = 0; i < 6; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 6; ++j) row.push_back(Fine(covariance(i, j)));
    rows.push_back(row);
  }
  return rows;
}

Json JsonOf(const Localization& localization, const CityModel& model) {
  const Goodness& goodness = localization.goodness;
  Json json = {{"posterior_mass", Fine(localization.posterior_mass)},
               {"explained", Fine(goodness.explained())},
               {"observed_nat", Fine(goodness.observed)},
               {"information_nat", Fine(goodness.information())},
               {"expected_nat", Fine(goodness.expected)},
               {"chance_nat", Fine(goodness.chance)}};
  json["above_background_nat"] = nullptr;
  if (localization.above_background) {
    json["above_background_nat"] = Fine(*localization.above_background);
  }
  json["buildings"] = Json::array();
  for (const BuildingFit& fit : goodness.buildings) {
    json["buildings"].push_back({{"id", model.buildings[fit.building].id},
                                 {"explained", Fine(fit.explained())},
                                 {"information_nat", Fine(fit.information())},
                                 {"roof_shift_m", Fine(fit.roof_shift_m)},
                                 {"roof_gain_nat", Fine(fit.roof_gain)}});
  }
  return json;
}

}  // namespace

std::string StatusOf(const Localization& localization) {
  if (!localization.pose) return "abstained";
  return localization.status == LocalizationStatus::kDoubtful ? "doubtful" : "ok";
}

std::string PoseJson(const std::string& picture,
                     const Localization& localization,
                     const CityModel& model,
                     const std::vector<Assumption>& assumptions) {
  Json json;
  json["picture"] = picture;
  json["status"] = StatusOf(localization);
  json["outcome"] = NameOf(localization.status);
  if (!localization.reason.empty()) json["reason"] = localization.reason;
  json["crs"] = CrsName(model.crs);
  if (localization.pose) json["pose"] = JsonOf(*localization.pose, model);
  if (localization.focal_px) json["focal_length_px"] = Fine(*localization.focal_px);
  json["energy"] = Fine(localization.energy);
  json["confidence"] = Fine(localization.confidence);
  if (!localization.modes.empty()) json["region_95"] = EllipseJson(localization.spread);
  if (!localization.modes.empty()) json["covariance"] = JsonOf(localization.spread.covariance);
  json["protection_level"] = nullptr;
  if (localization.protection) {
    json["protection_level"] = {{"position_m", Metres(localization.protection->position_m)},
                                {"heading_deg", Metres(localization.protection->heading_deg)}};
  }
  json["doubts"] = localization.doubts;
  if (localization.goodness.is_known()) {
    json["goodness"] = JsonOf(localization, model);
  }
  json["modes"] = Json::array();
  for (const PoseMode& mode : DistinctModes(localization.modes)) {
    const ViewAngles view = ViewAnglesOf(mode.pose.cam_from_world);
    json["modes"].push_back({{"position", JsonOf(mode.pose.center_in_world)},
                             {"heading_deg", Fine(view.heading_deg)},
                             {"pitch_deg", Fine(view.pitch_deg)},
                             {"roll_deg", Fine(view.roll_deg)},
                             {"energy", Fine(mode.energy)}});
  }
  json["assumptions"] = JsonOf(assumptions);
  json["notes"] = localization.notes;
  json["warnings"] = localization.warnings;
  return json.dump(1) + "\n";
}

std::string RunJson(const Localization& localization,
                    std::uint64_t seed,
                    const std::string& version,
                    const std::string& options_json,
                    const std::vector<Assumption>& assumptions,
                    const std::vector<HashedFile>& inputs,
                    const std::string& folder) {
  Json json;
  json["version"] = version;
  json["seed"] = seed;
  json["evaluations"] = localization.evaluations;
  for (const StageTime& time : localization.times) json["seconds"][time.name] = time.seconds;
  json["assumptions"] = JsonOf(assumptions);
  json["options"] = Json::parse(options_json);
  json["folder"] = folder;
  json["inputs"] = Json::array();
  for (const HashedFile& input : inputs) {
    json["inputs"].push_back(
        {{"role", input.role}, {"path", input.path}, {"sha256", input.sha256}});
  }
  return json.dump(1) + "\n";
}

}  // namespace ridgeline
