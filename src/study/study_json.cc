// SPDX-License-Identifier: Apache-2.0
#include "study/study_json.h"

#include "base/error.h"
#include "eval/exact_json.h"

namespace ridgeline {
namespace {

using exact::DoubleOf;
using exact::Json;
using exact::Of;

Json FiguresJson(const Reliability& r) {
  return {{"poses", r.poses},
          {"minimum", r.minimum},
          {"minimum_m", Of(r.minimum_m)},
          {"minimum_deg", Of(r.minimum_deg)},
          {"better_share", Of(r.better_share)},
          {"basin_m", Of(r.basin_m)},
          {"basin_deg", Of(r.basin_deg)},
          {"margin_log_ratio", Of(r.margin_log_ratio)},
          {"margin", Of(r.margin)},
          {"rank_correlation", Of(r.rank_correlation)}};
}

Reliability FiguresFrom(const Json& json) {
  Reliability r;
  r.poses = json.at("poses").get<std::uint64_t>();
  r.minimum = json.at("minimum").get<std::size_t>();
  r.minimum_m = DoubleOf(json.at("minimum_m"));
  r.minimum_deg = DoubleOf(json.at("minimum_deg"));
  r.better_share = DoubleOf(json.at("better_share"));
  r.basin_m = DoubleOf(json.at("basin_m"));
  r.basin_deg = DoubleOf(json.at("basin_deg"));
  r.margin_log_ratio = DoubleOf(json.at("margin_log_ratio"));
  r.margin = DoubleOf(json.at("margin"));
  r.rank_correlation = DoubleOf(json.at("rank_correlation"));
  return r;
}

Json BinsJson(const std::vector<ErrorBin>& bins) {
  Json rows = Json::array();
  for (const ErrorBin& bin : bins) {
    rows.push_back({Of(bin.lower),
                    Of(bin.upper),
                    bin.poses,
                    Of(bin.home_share),
                    Of(bin.best_log_ratio),
                    Of(bin.median_log_ratio)});
  }
  return rows;
}

std::vector<ErrorBin> BinsFrom(const Json& json) {
  std::vector<ErrorBin> bins;
  for (const Json& row : json) {
    bins.push_back({DoubleOf(row.at(0)),
                    DoubleOf(row.at(1)),
                    row.at(2).get<int>(),
                    DoubleOf(row.at(3)),
                    DoubleOf(row.at(4)),
                    DoubleOf(row.at(5))});
  }
  return bins;
}

Json SampledJson(const std::vector<SampledPose>& sampled) {
  Json rows = Json::array();
  for (const SampledPose& pose : sampled) {
    rows.push_back({pose.evaluation,
                    pose.after,
                    Of(pose.energy),
                    Of(pose.translation_m),
                    Of(pose.horizontal_m),
                    Of(pose.rotation_deg)});
  }
  return rows;
}

std::vector<SampledPose> SampledFrom(const Json& json) {
  std::vector<SampledPose> sampled;
  for (const Json& row : json) {
    sampled.push_back({row.at(0).get<int>(),
                       row.at(1).get<int>(),
                       DoubleOf(row.at(2)),
                       DoubleOf(row.at(3)),
                       DoubleOf(row.at(4)),
                       DoubleOf(row.at(5))});
  }
  return sampled;
}

}  // namespace

std::string StudyText(const ScoreStudy& study) {
  Json json = {{"prior", Of(study.prior)},
               {"ranges", Of(study.ranges)},
               {"figures", study.figures ? FiguresJson(*study.figures) : Json(nullptr)},
               {"reason", study.reason},
               {"minimum", Of(study.minimum)},
               {"map", Of(study.map)},
               {"heading_deg", Of(study.heading_deg)},
               {"heading_energy", Of(study.heading_energy)},
               {"by_distance", BinsJson(study.by_distance)},
               {"by_angle", BinsJson(study.by_angle)},
               {"sampled", SampledJson(study.sampled)},
               {"explored", nullptr},
               {"visible_edges", study.visible_edges},
               {"picture_lines", study.picture_lines},
               {"seconds", Of(study.seconds)}};
  if (study.explored) {
    json["explored"] = {{"map", Of(study.explored->map)},
                        {"pitch_deg", Of(study.explored->pitch_deg)},
                        {"roll_deg", Of(study.explored->roll_deg)}};
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

ScoreStudy ReadStudy(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    ScoreStudy study;
    study.prior = exact::PriorOf(json.at("prior"));
    study.ranges = exact::RangesOf(json.at("ranges"));
    if (!json.at("figures").is_null()) study.figures = FiguresFrom(json.at("figures"));
    study.reason = json.at("reason").get<std::string>();
    study.minimum = exact::PoseOf(json.at("minimum"));
    study.map = exact::MapOf(json.at("map"));
    study.heading_deg = exact::ListOf<double>(json.at("heading_deg"));
    study.heading_energy = exact::ListOf<double>(json.at("heading_energy"));
    study.by_distance = BinsFrom(json.at("by_distance"));
    study.by_angle = BinsFrom(json.at("by_angle"));
    study.sampled = SampledFrom(json.at("sampled"));
    if (const Json& explored = json.at("explored"); !explored.is_null()) {
      study.explored = ExploredMap{exact::MapOf(explored.at("map")),
                                   exact::ListOf<float>(explored.at("pitch_deg")),
                                   exact::ListOf<float>(explored.at("roll_deg"))};
    }
    study.visible_edges = json.at("visible_edges").get<int>();
    study.picture_lines = json.at("picture_lines").get<int>();
    study.seconds = DoubleOf(json.at("seconds"));
    return study;
  } catch (const Json::exception&) {
    throw InputError(file, "", "no map of a study", "a file that ridgeline wrote; remove it");
  }
}

}  // namespace ridgeline
