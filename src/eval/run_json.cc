// SPDX-License-Identifier: Apache-2.0
#include "eval/run_json.h"

#include <array>

#include "base/error.h"
#include "eval/exact_json.h"

namespace ridgeline {
namespace {

using exact::DoubleOf;
using exact::Json;
using exact::Of;

constexpr std::array kStatuses = {LocalizationStatus::kOk,
                                  LocalizationStatus::kTooFewLines,
                                  LocalizationStatus::kNoVisibleModel,
                                  LocalizationStatus::kAmbiguous,
                                  LocalizationStatus::kNotExplained,
                                  LocalizationStatus::kUnprotected,
                                  LocalizationStatus::kDoubtful};

LocalizationStatus StatusNamed(const std::string& name) {
  for (const LocalizationStatus status : kStatuses) {
    if (name == NameOf(status)) return status;
  }
  throw InputError("", "status", "\"" + name + "\"", "a status of a localization");
}

Json GoodnessJson(const Goodness& goodness) {
  Json buildings = Json::array();
  for (const BuildingFit& fit : goodness.buildings) {
    buildings.push_back({fit.building,
                         Of(fit.observed),
                         Of(fit.expected),
                         Of(fit.chance),
                         Of(fit.length_px),
                         Of(fit.roof_shift_m),
                         Of(fit.roof_gain)});
  }
  return {{"observed", Of(goodness.observed)},
          {"expected", Of(goodness.expected)},
          {"chance", Of(goodness.chance)},
          {"buildings", buildings}};
}

Goodness GoodnessFrom(const Json& json) {
  Goodness goodness;
  goodness.observed = DoubleOf(json.at("observed"));
  goodness.expected = DoubleOf(json.at("expected"));
  goodness.chance = DoubleOf(json.at("chance"));
  for (const Json& row : json.at("buildings")) {
    goodness.buildings.push_back({row.at(0).get<std::uint32_t>(),
                                  DoubleOf(row.at(1)),
                                  DoubleOf(row.at(2)),
                                  DoubleOf(row.at(3)),
                                  DoubleOf(row.at(4)),
                                  DoubleOf(row.at(5)),
                                  DoubleOf(row.at(6))});
  }
  return goodness;
}

Json LocalizationJson(const Localization& found) {
  Json json = {{"status", NameOf(found.status)},
               {"reason", found.reason},
               {"doubts", found.doubts},
               {"pose", found.pose ? Of(*found.pose) : Json(nullptr)},
               {"focal_px", Of(found.focal_px)},
               {"energy", Of(found.energy)},
               {"confidence", Of(found.confidence)},
               {"posterior_mass", Of(found.posterior_mass)},
               {"above_background", Of(found.above_background)},
               {"goodness", GoodnessJson(found.goodness)},
               {"position_covariance", Of(found.spread.position_covariance)},
               {"heading_sigma_deg", Of(found.spread.heading_sigma_deg)},
               {"covariance", Of(found.spread.covariance)},
               {"protection", nullptr},
               {"modes", Json::array()},
               {"map", Of(found.map)},
               {"evaluations", found.evaluations},
               {"times", Json::array()},
               {"notes", found.notes},
               {"warnings", found.warnings}};
  if (found.protection) {
    json["protection"] = {Of(found.protection->position_m), Of(found.protection->heading_deg)};
  }
  for (const PoseMode& mode : found.modes) {
    json["modes"].push_back({{"pose", Of(mode.pose)}, {"energy", Of(mode.energy)}});
  }
  for (const StageTime& time : found.times) json["times"].push_back({time.name, Of(time.seconds)});
  return json;
}

Localization LocalizationFrom(const Json& json) {
  using Texts = std::vector<std::string>;
  Localization found;
  found.status = StatusNamed(json.at("status").get<std::string>());
  found.reason = json.at("reason").get<std::string>();
  found.doubts = json.at("doubts").get<Texts>();
  if (!json.at("pose").is_null()) found.pose = exact::PoseOf(json.at("pose"));
  found.focal_px = exact::OptionalOf(json.at("focal_px"));
  found.energy = DoubleOf(json.at("energy"));
  found.confidence = DoubleOf(json.at("confidence"));
  found.posterior_mass = DoubleOf(json.at("posterior_mass"));
  found.above_background = exact::OptionalOf(json.at("above_background"));
  found.goodness = GoodnessFrom(json.at("goodness"));
  found.spread.position_covariance =
      exact::MatrixOf<Eigen::Matrix2d>(json.at("position_covariance"));
  found.spread.heading_sigma_deg = DoubleOf(json.at("heading_sigma_deg"));
  found.spread.covariance =
      exact::MatrixOf<Eigen::Matrix<double, 6, 6>>(json.at("covariance"));
  if (const Json& level = json.at("protection"); !level.is_null()) {
    found.protection = ProtectionLevel{DoubleOf(level.at(0)), DoubleOf(level.at(1))};
  }
  for (const Json& mode : json.at("modes")) {
    found.modes.push_back({exact::PoseOf(mode.at("pose")), DoubleOf(mode.at("energy"))});
  }
  found.map = exact::MapOf(json.at("map"));
  found.evaluations = json.at("evaluations").get<std::uint64_t>();
  for (const Json& time : json.at("times")) {
    found.times.push_back({time.at(0).get<std::string>(), DoubleOf(time.at(1))});
  }
  found.notes = json.at("notes").get<Texts>();
  found.warnings = json.at("warnings").get<Texts>();
  return found;
}

}  // namespace

std::string RunText(const BenchRun& run) {
  return Json({{"query", run.record.query},
               {"seed", run.record.seed},
               {"seconds", Of(run.record.seconds)},
               {"prior", Of(run.prior)},
               {"ranges", Of(run.ranges)},
               {"localization", LocalizationJson(run.localization)}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

BenchRun ReadRun(const std::string& text,
                 const Query& query,
                 std::size_t index,
                 const std::string& file) {
  try {
    const Json json = Json::parse(text);
    if (json.at("query") != query.id) {
      throw InputError(
          file, "query", json.at("query").dump(), "\"" + query.id + "\", whose place this is");
    }
    BenchRun run;
    run.query = index;
    run.prior = exact::PriorOf(json.at("prior"));
    run.ranges = exact::RangesOf(json.at("ranges"));
    run.localization = LocalizationFrom(json.at("localization"));
    run.record = RecordOf(
        query, json.at("seed").get<int>(), run.localization, DoubleOf(json.at("seconds")));
    return run;
  } catch (const std::exception& e) {
    if (dynamic_cast<const InputError*>(&e) != nullptr) throw;
    throw InputError(file, "", "no run of a query", "a file that ridgeline wrote; remove it");
  }
}

std::string WithoutTimes(const std::string& run_text) {
  Json json = Json::parse(run_text);
  json.erase("seconds");
  json.at("localization").erase("times");
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ridgeline
