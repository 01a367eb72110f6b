// SPDX-License-Identifier: Apache-2.0
#include "cli/track_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "cli/track_output.h"
#include "eval/metrics.h"

namespace ridgeline {
namespace {

constexpr std::size_t kMaxPictures = 60;
constexpr int kPictureSidePx = 900;

std::string Text(const char* format, double a, double b = 0.0, double c = 0.0) {
  char text[128];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

ReportPose PoseOf(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  return {pose.center_in_world, angles.heading_deg, angles.pitch_deg, angles.roll_deg};
}

ReportRun RunOf(const TrackRow& row) {
  const TrackFrame& f = row.frame;
  ReportRun run;
  run.id = f.id;
  run.status = NameOf(f.state);
  run.reason = f.reason;
  run.confidence = f.confidence;
  run.energy = NAN;
  run.seconds = 1e-3 * f.milliseconds;
  if (f.pose) {
    run.result = PoseOf(*f.pose);
    run.position_covariance = f.covariance.topLeftCorner<2, 2>();
  }
  if (row.truth) run.truth = PoseOf(*row.truth);
  run.outcome = f.pose ? ReportOutcome::kUnknown : ReportOutcome::kAbstained;
  if (f.pose && row.truth) {
    const PoseError error = ErrorOf(*f.pose, *row.truth);
    run.translation_m = error.translation_m;
    run.rotation_deg = error.rotation_deg;
    run.outcome = error.translation_m <= 1.0 && error.rotation_deg <= 1.0 ? ReportOutcome::kRight
                                                                          : ReportOutcome::kWrong;
  }
  run.facts = {{"state", NameOf(f.state)}, {"look", NameOf(f.look)}};
  if (!f.reason.empty()) run.facts.emplace_back("reason", f.reason);
  if (f.protection) {
    run.facts.emplace_back(
        "protection level",
        Text("%.1f m, %.1f°", f.protection->position_m, f.protection->heading_deg));
  }
  run.facts.emplace_back("edges explained", Text("%.2f", f.explained));
  return run;
}

using Value = std::function<std::optional<double>(const TrackRow&)>;

// One value per frame; frames without one interrupt the line.
ReportSeries SeriesOf(const char* name, std::span<const TrackRow> rows, const Value& value) {
  ReportSeries series;
  series.name = name;
  series.line = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(value(rows[i]).value_or(NAN));
    series.labels.push_back(rows[i].frame.id + ": " + NameOf(rows[i].frame.state));
  }
  return series;
}

std::optional<double> ErrorM(const std::optional<Pose>& pose, const std::optional<Pose>& truth) {
  if (!pose || !truth) return std::nullopt;
  return (pose->center_in_world - truth->center_in_world).norm();
}

std::optional<Pose> Smoothed(const TrackRow& row) {
  return row.smoothed ? std::optional(row.smoothed->pose) : std::nullopt;
}

ReportPlot PlotOf(std::string title,
                  std::string note,
                  std::string y_label,
                  std::vector<ReportSeries> series) {
  ReportPlot plot;
  plot.title = std::move(title);
  plot.note = std::move(note);
  plot.x_label = "frame";
  plot.y_label = std::move(y_label);
  plot.series = std::move(series);
  return plot;
}

void AddPlots(std::span<const TrackRow> rows, bool has_truth, ReportData& data) {
  const auto confidence = [](const TrackRow& r) { return std::optional(r.frame.confidence); };
  const auto explained = [](const TrackRow& r) { return std::optional(r.frame.explained); };
  data.plots.push_back(PlotOf("Evidence",
                              "Confidence that the pose is the right one, and the share of the "
                              "edges that are seen where they should be.",
                              "share",
                              {SeriesOf("confidence", rows, confidence),
                               SeriesOf("edges explained", rows, explained)}));
  std::vector<ReportSeries> lines;
  if (has_truth) {
    lines.push_back(SeriesOf("error as it came", rows, [](const TrackRow& r) {
      return ErrorM(r.frame.pose, r.truth);
    }));
    lines.push_back(SeriesOf(
        "error smoothed", rows, [](const TrackRow& r) { return ErrorM(Smoothed(r), r.truth); }));
  }
  lines.push_back(SeriesOf("protection level", rows, [](const TrackRow& r) {
    return r.frame.protection ? std::optional(r.frame.protection->position_m) : std::nullopt;
  }));
  data.plots.push_back(PlotOf("Position",
                              "Gaps are frames that were not tracked or have no truth.",
                              "metres",
                              std::move(lines)));
  if (std::any_of(rows.begin(), rows.end(), [](const TrackRow& r) { return r.frame.gnss; })) {
    data.plots.push_back(PlotOf("Receiver",
                                "Log likelihood ratio of a jump or a drag of the fixes against an "
                                "honest receiver.",
                                "nat",
                                {SeriesOf("lie", rows, [](const TrackRow& r) {
                                  return r.frame.gnss ? std::optional(r.frame.gnss->ratio)
                                                      : std::nullopt;
                                })}));
  }
  data.plots.push_back(PlotOf(
      "Time per frame",
      "Wide looks search a whole region; between close looks the odometry leads.",
      "ms",
      {SeriesOf("time", rows, [](const TrackRow& r) { return std::optional(r.frame.milliseconds); })}));
}

ReportTable ErrorTable(const TrackSummary& s) {
  ReportTable table;
  table.title = "Errors against the truth";
  table.header = {"", "ATE [m]", "median [m]", "RPE [m]", "RPE [°]", "1 m", "3 m", "5 m", "1 m 1°"};
  const auto add = [&](const char* name, const TrackErrors& e) {
    if (e.posed == 0) {
      table.rows.push_back({name, "no pose", "", "", "", "", "", "", ""});
      return;
    }
    table.rows.push_back({name,
                          Text("%.2f", e.ate_rmse_m),
                          Text("%.2f", e.ate_median_m),
                          Text("%.2f", e.rpe_rmse_m),
                          Text("%.2f", e.rpe_rmse_deg),
                          Text("%.0f %%", 100.0 * e.within_1m),
                          Text("%.0f %%", 100.0 * e.within_3m),
                          Text("%.0f %%", 100.0 * e.within_5m),
                          Text("%.0f %%", 100.0 * e.within_1m_1deg)});
  };
  add("as it came", s.causal);
  add("smoothed", s.smoothed);
  return table;
}

}  // namespace

TrackReport::TrackReport(std::size_t frames)
    : every_(std::max<std::size_t>(1, (frames + kMaxPictures - 1) / kMaxPictures)) {}

bool TrackReport::Shows(std::size_t frame) const {
  return frame % every_ == 0 && pictures_.size() < kMaxPictures;
}

void TrackReport::AddPicture(std::size_t frame,
                             const std::string& name,
                             const cv::Mat& picture,
                             std::vector<OverlayLayer> layers) {
  ReportPhoto photo;
  photo.name = name;
  photo.width = picture.cols;
  photo.height = picture.rows;
  const double scale =
      std::min(1.0, static_cast<double>(kPictureSidePx) / std::max(picture.cols, picture.rows));
  cv::resize(picture, photo.picture, {}, scale, scale, cv::INTER_AREA);
  pictures_[frame] = {std::move(photo), std::move(layers)};
}

ReportData TrackReport::Make(std::span<const TrackRow> rows, const Localizer& localizer) const {
  const TrackSummary summary = SummaryOf(rows);
  ReportData data;
  data.right_text = "frames within 1 m and 1° as they came";
  data.facts = {{"frames", std::to_string(summary.frames)},
                {"tracked", std::to_string(summary.tracking)},
                {"lost", std::to_string(summary.lost)}};
  const bool has_truth = summary.causal.frames > 0;
  if (has_truth) {
    const auto ate = [](const TrackErrors& e) {
      return e.posed == 0 ? std::string("no pose") : Text("%.2f m", e.ate_rmse_m);
    };
    data.facts.emplace_back("ATE, as it came → smoothed",
                            ate(summary.causal) + " → " + ate(summary.smoothed));
    data.tables.push_back(ErrorTable(summary));
  }
  data.facts.emplace_back("time per frame", Text("%.0f ms", summary.median_ms));
  if (summary.gnss && summary.gnss->lies) {
    data.facts.emplace_back("receiver lies", Text("since %.1f s", summary.gnss->since_s));
  }
  AddPlots(rows, has_truth, data);
  const cv::Mat map = TrackMap(rows, localizer);
  if (!map.empty()) {
    data.lead = 0;
    data.photos.push_back({"The way from above, north up; the corridor is the protection level.",
                           map,
                           map.cols,
                           map.rows});
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ReportRun run = RunOf(rows[i]);
    const auto picture = pictures_.find(i);
    if (picture != pictures_.end()) {
      run.photo = static_cast<int>(data.photos.size());
      data.photos.push_back(picture->second.photo);
      run.result_layers = picture->second.layers;
    }
    data.runs.push_back(std::move(run));
  }
  return data;
}

}  // namespace ridgeline
