// SPDX-License-Identifier: Apache-2.0
#include "report/bench_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "camera/local_frame.h"
#include "city/crs.h"
#include "eval/distinct_modes.h"
#include "input/prior_pose.h"
#include "report/hillshade.h"
#include "report/overlay_layers.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The ground shown around the search box [m]; a fifth of it around a map beyond that.
constexpr double kMapMarginM = 15.0;
// The longest side of a photo in a report [px].
constexpr int kPhotoSidePx = 1400;

std::string Text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Percent(double share) { return Text("%.0f %%", 100.0 * share); }

constexpr Rgb kMisfitColor{255, 30, 30};

// Buildings that have something to say and say the opposite, or whose roofs are off: those that the
// doubts name (localize/belief.cc).
std::vector<std::uint32_t> MisfitsOf(const Goodness& goodness) {
  constexpr double kTellingNat = 4.0;
  constexpr double kMisfit = 0.25;
  std::vector<std::uint32_t> buildings;
  for (const BuildingFit& fit : goodness.buildings) {
    const bool contradicts = fit.information() > kTellingNat && fit.explained() < kMisfit;
    if (contradicts || fit.roof_gain > kTellingNat) buildings.push_back(fit.building);
  }
  return buildings;
}

ReportPose PoseOf(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  return {pose.center_in_world, angles.heading_deg, angles.pitch_deg, angles.roll_deg};
}

Pose LocalOf(const Pose& pose, const Localizer& localizer) {
  return LocalFrame{localizer.scene().model().origin_in_world}.FromWorld(pose);
}

// The prior of a run; off the terrain, where nothing is searched, at the height of the model's
// origin.
Pose PriorPoseOf(const BenchRun& run, const Localizer& localizer) {
  const Vector3d& origin = localizer.scene().model().origin_in_world;
  const double camera_height_m = run.ranges.camera_height_m;
  const auto pose = PoseOfPrior(run.prior, localizer.dtm(), origin, camera_height_m);
  if (pose) return *pose;
  PosePrior at_origin = run.prior;
  at_origin.height_in_world = origin.z();
  return PoseOfPrior(at_origin, nullptr, origin, camera_height_m).value();
}

ReportOutcome OutcomeOf(const RunRecord& record) {
  if (!record.has_truth) return record.pose ? ReportOutcome::kUnknown : ReportOutcome::kAbstained;
  if (!record.pose) return ReportOutcome::kAbstained;
  const bool right = record.error->translation_m <= 2.0 && record.error->rotation_deg <= 2.0;
  return right ? ReportOutcome::kRight : ReportOutcome::kWrong;
}

// Box around the prior; hillshade and footprints of the ground that is shown.
void AddGround(const Localizer& localizer, const PoseSpaceOptions& ranges, ReportRun& run) {
  const Vector2d origin = localizer.scene().model().origin_in_world.head<2>();
  if (!run.prior && !run.result) return;
  const Vector2d center = (run.prior ? run.prior : run.result)->position.head<2>();
  const Vector2d reach(ranges.east_m, ranges.north_m);
  const Vector2d lower = center - reach;
  const Vector2d upper = center + reach;
  if (run.prior) {
    run.search_box = {lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}, lower};
  }

  const Vector2d margin(kMapMarginM, kMapMarginM);
  Vector2d from = lower - margin;
  Vector2d to = upper + margin;
  if (run.map) {  // a search that went further
    const Vector2d size(run.map->columns - 1, run.map->rows - 1);
    from = from.cwiseMin(run.map->first - 0.2 * margin);
    to = to.cwiseMax(run.map->first + run.map->spacing_m * size + 0.2 * margin);
  }
  if (localizer.dtm() != nullptr) {
    run.hillshade =
        ReportHillshade{Hillshade(*localizer.dtm(), from - origin, to - origin, 160), from, to};
  }
  for (const auto& ring : localizer.footprints().rings()) {
    std::vector<Vector2d> points;
    Vector2d low = ring.front() + origin;
    Vector2d high = low;
    for (const Vector2d& p : ring) {
      points.push_back(p + origin);
      low = low.cwiseMin(points.back());
      high = high.cwiseMax(points.back());
    }
    const bool near = (low.array() < to.array()).all() && (high.array() > from.array()).all();
    if (near) run.footprints.push_back(std::move(points));
  }
}

double HorizontalFieldDeg(const PinholeCamera& camera) {
  return (std::atan(camera.cx / camera.fx) + std::atan((camera.width - camera.cx) / camera.fx)) *
         180.0 / std::numbers::pi;
}

ReportEnergyMap MapOf(const EnergyMap& map) {
  return {map.first, map.spacing_m, map.columns, map.rows, map.energies};
}

// A search that goes further has its stages several times.
std::vector<StageTime> TimesByStage(const std::vector<StageTime>& times) {
  std::vector<StageTime> stages;
  for (const StageTime& time : times) {
    const auto same = std::find_if(stages.begin(), stages.end(), [&](const StageTime& stage) {
      return stage.name == time.name;
    });
    if (same == stages.end()) {
      stages.push_back(time);
    } else {
      same->seconds += time.seconds;
    }
  }
  return stages;
}

std::vector<std::pair<std::string, std::string>> FactsOf(const BenchRun& run) {
  const Localization& localization = run.localization;
  std::vector<std::pair<std::string, std::string>> facts = {
      {"status", run.is_given ? "of another system" : NameOf(localization.status)}};
  if (std::isfinite(localization.energy)) {
    facts.emplace_back("energy", Text("%.4f", localization.energy));
  }
  if (!run.is_given) {
    facts.emplace_back("confidence", Text("%.2f", localization.confidence));
    facts.emplace_back("poses evaluated", std::to_string(localization.evaluations));
    facts.emplace_back("time", Text("%.2f s", run.record.seconds));
  }
  for (const StageTime& stage : TimesByStage(localization.times)) {
    facts.emplace_back("… " + stage.name, Text("%.2f s", stage.seconds));
  }
  if (localization.pose && !run.is_given) {
    facts.emplace_back("heading, standard deviation",
                       Text("%.2f°", localization.spread.heading_sigma_deg));
  }
  if (localization.goodness.is_known()) {
    facts.emplace_back("edges seen, against what is usual at a right pose",
                       Text("%.0f %%", 100.0 * localization.goodness.explained()));
  }
  if (localization.protection) {
    facts.emplace_back("protection level (1 in 1000)",
                       Text("%.1f m", localization.protection->position_m) +
                           Text(", %.1f°", localization.protection->heading_deg));
  }
  for (const std::string& doubt : localization.doubts) facts.emplace_back("doubt", doubt);
  for (const std::string& note : localization.notes) facts.emplace_back("note", note);
  for (const std::string& warning : localization.warnings) facts.emplace_back("warning", warning);
  return facts;
}

const char* ConfidenceWords(double confidence) {
  if (confidence >= 0.99) return "practically certain";
  if (confidence >= 0.9) return "very likely";
  if (confidence >= 0.7) return "likely";
  if (confidence >= 0.5) return "more likely than not";
  if (confidence >= 0.2) return "rather unlikely";
  return "unlikely";
}

// Status, pose and confidence in words, and where in the world it is. A score study's minimum has no
// confidence.
void AddHeadline(const BenchRun& run, const Crs& crs, ReportRun& report) {
  const Localization& found = run.localization;
  if (!report.result) {
    report.headline = "No pose. The best candidate is shown where there is one.";
    return;
  }
  const ReportPose& pose = *report.result;
  const bool is_map = !std::isfinite(found.confidence);
  std::string text = run.is_given ? "Pose of another system. "
                     : is_map     ? "Least energy of the map. "
                     : found.status == LocalizationStatus::kOk ? "Pose found. "
                                                               : "Pose found, in doubt. ";
  if (!run.is_given && !is_map) {
    text += std::string("It is ") + ConfidenceWords(found.confidence) +
            Text(" (%.2f) that it is within 2\u00a0m and 2° of the truth. ", found.confidence);
  }
  text += Text("East %.2f\u00a0m, ", pose.position.x()) +
          Text("north %.2f\u00a0m, ", pose.position.y()) +
          Text("height %.2f\u00a0m; ", pose.position.z()) +
          Text("heading %.1f°, ", pose.heading_deg) + Text("pitch %.1f°, ", pose.pitch_deg) +
          Text("roll %.1f°.", pose.roll_deg);
  if (crs.horizontal_epsg != 0) {
    report.latitude_longitude = LatitudeLongitude(crs, pose.position.head<2>());
  }
  report.headline = text;
}

ReportRun RunOf(const BenchRun& run, const Query& query, const Localizer& localizer) {
  const Localization& localization = run.localization;
  ReportRun report;
  report.id = run.record.query;
  report.set = run.record.set;
  report.seed = run.record.seed;
  report.status = NameOf(localization.status);
  report.reason = localization.reason;
  if (localization.pose && !localization.doubts.empty()) {
    report.reason = "Doubts: " + localization.doubts.front() +
                    (localization.doubts.size() > 1 ? ", and more below." : ".");
  }
  report.outcome = OutcomeOf(run.record);
  report.energy = run.record.energy;
  report.confidence = run.record.confidence;
  if (run.record.error) {
    report.translation_m = run.record.error->translation_m;
    report.rotation_deg = run.record.error->rotation_deg;
  }
  if (!run.is_given) {
    report.prior = PoseOf(PriorPoseOf(run, localizer));
    report.prior->has_heading = run.prior.heading_deg.has_value();
    report.prior->has_height = run.prior.height_in_world.has_value();
    report.prior->has_tilt = run.prior.pitch_deg.has_value() && run.prior.roll_deg.has_value();
  }
  if (localization.pose) report.result = PoseOf(*localization.pose);
  if (query.truth) report.truth = PoseOf(*query.truth);
  for (const PoseMode& mode : DistinctModes(localization.modes)) {
    report.modes.push_back({PoseOf(mode.pose), mode.energy});
  }
  AddHeadline(run, localizer.scene().model().crs, report);
  if (localization.pose && !run.is_given) report.position_covariance = localization.spread.position_covariance;
  if (!localization.map.energies.empty()) report.map = MapOf(localization.map);
  AddGround(localizer, run.ranges, report);
  const PinholeCamera camera = CameraOf(query, localization);
  report.hfov_deg = HorizontalFieldDeg(camera);
  const Overlay overlay = ResultOverlay(localizer, camera, run);
  const auto first_of_result = overlay.layers.begin() + (run.is_given ? 0 : 1);
  report.prior_layers.assign(overlay.layers.begin(), first_of_result);
  report.result_layers.assign(first_of_result, overlay.layers.end());
  report.evaluations = static_cast<double>(localization.evaluations);
  report.seconds = run.record.seconds;
  report.facts = FactsOf(run);
  return report;
}

std::string ErrorText(const Spread& translation_m, const Spread& rotation_deg) {
  return Text("%.2f m, ", translation_m.median) + Text("%.2f°", rotation_deg.median);
}

// 14900 as "14 900".
std::string Grouped(double value) {
  std::string text = Text("%.0f", value);
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) text.insert(at, "\u202f");
  return text;
}

std::string ShareText(const RunShare& share) {
  return Percent(share.share) + " (" + Text("%.1f", 100.0 * share.ci95.lower) + " to " +
         Text("%.1f %%)", 100.0 * share.ci95.upper);
}

void AddSummary(std::span<const BenchRun> runs, const Protocol& protocol, ReportData& data) {
  if (runs.size() == 1) {
    const RunRecord& record = runs.front().record;
    if (record.error) {
      data.facts.emplace_back("error",
                              Text("%.2f m, ", record.error->translation_m) +
                                  Text("%.2f°", record.error->rotation_deg));
    }
    if (!record.is_searched) return;
    data.facts.emplace_back("confidence", Text("%.2f", record.confidence));
    data.facts.emplace_back("time", Text("%.2f s", record.seconds));
    data.facts.emplace_back("poses evaluated", Grouped(static_cast<double>(record.evaluations)));
    return;
  }
  std::vector<RunRecord> records;
  for (const BenchRun& run : runs) records.push_back(run.record);
  const Summary summary = Summarize(records);
  data.facts = {{"photos", std::to_string(summary.queries)},
                {"runs", std::to_string(summary.all_runs)}};
  if (!protocol.name.empty()) data.facts.emplace_back("protocol", protocol.name);
  if (summary.runs > 0 && protocol.HasRecall()) {
    data.facts.emplace_back("within 2 m, 2°", Percent(summary.recall[2]));
    data.facts.emplace_back("within 5 m, 5°", Percent(summary.recall[4]));
    data.facts.emplace_back("median error", ErrorText(summary.translation_m, summary.rotation_deg));
  }
  if (!protocol.HasRecall()) {
    data.facts.emplace_back("confident, 95 % interval", ShareText(summary.confident));
    data.facts.emplace_back("doubtful", Percent(summary.doubtful.share));
  }
  data.facts.emplace_back(summary.searched > 0 ? "abstained" : "without a pose",
                          Percent(summary.abstained.share));
  if (summary.searched > 0) {
    data.facts.emplace_back("time per photo", Text("%.2f s", summary.seconds_median));
    data.facts.emplace_back("poses per second", Grouped(summary.evaluations_per_second));
  } else {
    data.facts.emplace_back("with an energy of ours", std::to_string(summary.judged));
  }
  if (summary.runs < 2 || !protocol.HasRecall()) return;

  const std::string name = protocol.name.empty() ? "" : ", protocol " + protocol.name;
  ReportTable table{
      "Recall" + name, {"within", "of all runs", "95 % interval", "of the answered"}, {}};
  for (std::size_t i = 0; i < kRecallThresholds.size(); ++i) {
    const RecallThreshold& threshold = kRecallThresholds[i];
    table.rows.push_back(
        {Text("%g m, ", threshold.translation_m) + Text("%g°", threshold.rotation_deg),
         Percent(summary.recall[i]),
         Percent(summary.recall_ci95[i].lower) + " to " + Percent(summary.recall_ci95[i].upper),
         Percent(summary.recall_answered[i])});
  }
  data.tables.push_back(std::move(table));
}

void AddAssumptions(const std::vector<Query>& queries, ReportData& data) {
  ReportTable table{"Assumptions", {"photo", "what", "value", "source"}, {}};
  for (const Query& query : queries) {
    for (const Assumption& a : query.assumptions) {
      table.rows.push_back({query.id, a.what, a.value, a.source});
    }
  }
  if (!table.rows.empty()) data.tables.push_back(std::move(table));
}

}  // namespace

ReportPhoto ReportPhotoOf(const Query& query, PictureReader& pictures) {
  ReportPhoto photo;
  photo.name = query.image.filename().string();
  const cv::Mat picture = UndistortImage(BgrOf(pictures.Read(query)), *query.camera);
  photo.width = picture.cols;
  photo.height = picture.rows;
  const double scale =
      std::min(1.0, static_cast<double>(kPhotoSidePx) / std::max(picture.cols, picture.rows));
  cv::resize(picture, photo.picture, {}, scale, scale, cv::INTER_AREA);
  return photo;
}

Overlay ResultOverlay(const Localizer& localizer,
                      const PinholeCamera& camera,
                      const BenchRun& run) {
  const Scene& scene = localizer.scene();
  Overlay overlay;
  if (!run.is_given) {
    overlay.layers.push_back(PlainEdgeLayer(
        scene, camera, LocalOf(PriorPoseOf(run, localizer), localizer), "model at the prior"));
  }
  const Localization& localization = run.localization;
  if (!localization.pose && localization.modes.empty()) return overlay;
  const Pose best = localization.pose ? *localization.pose : localization.modes.front().pose;
  for (OverlayLayer& layer : ModelEdgeLayers(scene, camera, LocalOf(best, localizer))) {
    overlay.layers.push_back(std::move(layer));
  }
  const std::vector<std::uint32_t> misfits = MisfitsOf(localization.goodness);
  if (!misfits.empty()) {
    overlay.layers.push_back(BuildingEdgeLayer(scene,
                                               camera,
                                               LocalOf(best, localizer),
                                               misfits,
                                               "building that does not fit",
                                               kMisfitColor));
  }
  if (run.record.error) {
    overlay.caption = Text("error %.2f m, ", run.record.error->translation_m) +
                      Text("%.2f deg", run.record.error->rotation_deg);
  } else if (!localization.pose) {
    overlay.caption = "abstained; best candidate shown";
  }
  return overlay;
}

ReportData BenchReport(const ReportOrigin& origin,
                       const std::vector<Query>& queries,
                       const Localizer& localizer,
                       std::span<const BenchRun> runs,
                       PictureReader& pictures) {
  ReportData data;
  data.title = origin.title;
  data.command = origin.command;
  data.version = origin.version;
  data.crs = origin.crs;
  data.options_json = origin.options_json;
  data.warnings = localizer.scene().model().warnings;
  data.has_recall = origin.protocol.HasRecall();
  AddSummary(runs, origin.protocol, data);
  std::map<std::size_t, int> photo_of_query;
  for (const BenchRun& run : runs) {
    const Query& query = queries[run.query];
    const auto [it, added] =
        photo_of_query.emplace(run.query, static_cast<int>(data.photos.size()));
    if (added) data.photos.push_back(ReportPhotoOf(query, pictures));
    data.runs.push_back(RunOf(run, query, localizer));
    data.runs.back().photo = it->second;
  }
  AddAssumptions(queries, data);
  return data;
}

}  // namespace ridgeline
