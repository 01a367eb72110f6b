// SPDX-License-Identifier: Apache-2.0
#include "cli/skyline_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "eval/metrics.h"

namespace ridgeline {
namespace {

constexpr std::size_t kMaxPictures = 200;
// Longest side of a picture [px]: they are all kept until the end.
constexpr int kPictureSidePx = 900;
// A frame is right if the angle of its rotation's error is within this [deg].
constexpr double kRightDeg = 2.0;

std::string Text(const char* format, double a, double b = 0.0) {
  char text[96];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

ReportPose PoseOf(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  return {pose.center_in_world, angles.heading_deg, angles.pitch_deg, angles.roll_deg};
}

ReportRun RunOf(const SkylineFrameResult& frame) {
  ReportRun run;
  run.id = frame.id;
  run.status = frame.status;
  run.reason = frame.reason;
  run.confidence = NAN;
  run.seconds = 1e-3 * frame.times.Total();
  run.outcome = frame.pose || frame.status == "extracted" ? ReportOutcome::kUnknown
                                                          : ReportOutcome::kAbstained;
  if (frame.start) run.prior = PoseOf(*frame.start);
  if (frame.pose) run.result = PoseOf(*frame.pose);
  if (frame.truth) run.truth = PoseOf(*frame.truth);
  if (frame.pose && frame.truth) {
    const PoseError error = ErrorOf(*frame.pose, *frame.truth);
    run.translation_m = error.translation_m;
    run.rotation_deg = error.rotation_deg;
    run.outcome = error.rotation_deg <= kRightDeg ? ReportOutcome::kRight : ReportOutcome::kWrong;
  }
  const auto add = [&](const char* name, const std::optional<SkylineDistances>& d) {
    if (!d) return;
    run.facts.emplace_back(name, Text("%.1f px; all columns: %.1f px", d->used_px, d->plain_px));
  };
  run.facts = {{"status", frame.status}};
  if (!frame.method.empty()) run.facts.emplace_back("method", frame.method);
  add("L1 by the sensors", frame.by_sensors);
  add("L1 after the match", frame.at_best);
  add("L1 at the true pose", frame.at_truth);
  run.facts.emplace_back("extraction", Text("%.1f ms", frame.times.extract_ms));
  run.facts.emplace_back("clean-up, match",
                         Text("%.1f ms, %.1f ms", frame.times.clean_ms, frame.times.match_ms));
  return run;
}

// One value per frame; frames without one interrupt the line.
ReportSeries SeriesOf(const char* name,
                      const std::vector<SkylineFrameResult>& frames,
                      std::optional<double> (*value)(const SkylineFrameResult&)) {
  ReportSeries series;
  series.name = name;
  series.line = true;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(value(frames[i]).value_or(NAN));
    series.labels.push_back(frames[i].id);
  }
  return series;
}

std::optional<double> Used(const std::optional<SkylineDistances>& distances) {
  return distances ? std::optional<double>(distances->used_px) : std::nullopt;
}

std::optional<double> RotationError(const std::optional<Pose>& pose,
                                    const std::optional<Pose>& truth) {
  if (!pose || !truth) return std::nullopt;
  return RotationDistanceDeg(pose->cam_from_world, truth->cam_from_world);
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

void AddPlots(const std::vector<SkylineFrameResult>& frames,
              const SkylineSummary& summary,
              ReportData& data) {
  if (summary.matched > 0) {
    data.plots.push_back(PlotOf(
        "Distance of the skylines",
        "Mean distance between the picture's skyline and the model's; gaps are frames that "
        "were not "
        "matched.",
        "L1 [px at 640]",
        {SeriesOf("by the sensors", frames, [](const auto& f) { return Used(f.by_sensors); }),
         SeriesOf("after the match", frames, [](const auto& f) {
           return f.pose ? Used(f.at_best) : std::nullopt;
         })}));
  }
  if (summary.with_truth > 0) {
    data.plots.push_back(
        PlotOf("Error of the attitude",
               "Angle between the rotation and the true one.",
               "error [deg]",
               {SeriesOf("by the sensors",
                         frames,
                         [](const auto& f) { return RotationError(f.start, f.truth); }),
                SeriesOf("after the match", frames, [](const auto& f) {
                  return RotationError(f.pose, f.truth);
                })}));
  }
  data.plots.push_back(
      PlotOf("Time per frame",
             "One thread.",
             "time [ms]",
             {SeriesOf("extraction",
                       frames,
                       [](const auto& f) { return std::optional<double>(f.times.extract_ms); }),
              SeriesOf("match", frames, [](const auto& f) {
                return std::optional<double>(f.times.match_ms);
              })}));
}

}  // namespace

SkylineReport::SkylineReport(std::size_t frames)
    : every_(std::max<std::size_t>(1, (frames + kMaxPictures - 1) / kMaxPictures)) {}

bool SkylineReport::Shows(std::size_t frame) const { return frame % every_ == 0; }

void SkylineReport::AddPicture(std::size_t frame,
                               const std::string& name,
                               const cv::Mat& picture,
                               std::vector<OverlayLayer> before,
                               std::vector<OverlayLayer> after) {
  ReportPhoto photo;
  photo.name = name;
  photo.width = picture.cols;
  photo.height = picture.rows;
  const double scale =
      std::min(1.0, static_cast<double>(kPictureSidePx) / std::max(picture.cols, picture.rows));
  cv::resize(picture, photo.picture, {}, scale, scale, cv::INTER_AREA);
  pictures_[frame] = {std::move(photo), std::move(before), std::move(after)};
}

ReportData SkylineReport::Make(const std::vector<SkylineFrameResult>& frames) const {
  const SkylineSummary summary = Summarize(frames);
  ReportData data;
  data.is_study = true;
  data.right_text = "frames within 2° of the true attitude";
  data.facts = {{"frames", std::to_string(summary.frames)},
                {"matched", std::to_string(summary.matched)}};
  if (summary.matched > 0) {
    data.facts.emplace_back(
        "distance, sensors → match",
        Text("%.1f → %.1f px", summary.by_sensors.used_px, summary.at_best.used_px));
  }
  if (summary.with_truth > 0) {
    data.facts.emplace_back("heading error, sensors → match",
                            Text("%.2f° → %.2f°", summary.start_heading_deg, summary.heading_deg));
  }
  data.facts.emplace_back("time per frame", Text("%.1f ms", summary.times.Total()));
  AddPlots(frames, summary, data);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ReportRun run = RunOf(frames[i]);
    const auto picture = pictures_.find(i);
    if (picture != pictures_.end()) {
      run.photo = static_cast<int>(data.photos.size());
      data.photos.push_back(picture->second.photo);
      run.prior_layers = picture->second.before;
      run.result_layers = picture->second.after;
    }
    data.runs.push_back(std::move(run));
  }
  return data;
}

}  // namespace ridgeline
