// SPDX-License-Identifier: Apache-2.0
#include "report/compare_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "camera/local_frame.h"
#include "eval/binomial.h"
#include "report/bench_report.h"
#include "report/overlay_layers.h"

namespace ridgeline {
namespace {

// Blue and orange are told apart by people with any colour vision.
constexpr Rgb kColorA{255, 170, 0};
constexpr Rgb kColorB{0, 200, 255};

std::string Text(const char* format, double value, double scale = 1.0) {
  if (!std::isfinite(value)) return "–";
  char text[64];
  std::snprintf(text, sizeof text, format, scale * value);
  return text;
}

std::vector<std::string> RowOf(const ComparedFigure& f) {
  const bool is_share = f.unit == "share";
  const double scale = is_share ? 100.0 : 1.0;
  const std::string unit = is_share ? "\u00a0%%" : f.unit.empty() ? "" : "\u00a0" + f.unit;
  const std::string plain = (is_share ? "%.1f" : "%.3g") + unit;
  const std::string with_sign = (is_share ? "%+.1f" : "%+.3g") + unit;
  const bool holds_zero = f.ci95.lower <= 0.0 && f.ci95.upper >= 0.0;
  return {f.name,
          Text(plain.c_str(), f.a, scale),
          Text(plain.c_str(), f.b, scale),
          Text(with_sign.c_str(), f.difference, scale),
          Text(with_sign.c_str(), f.ci95.lower, scale) + " to " +
              Text(with_sign.c_str(), f.ci95.upper, scale),
          f.queries == 0 ? "–" : holds_zero ? "no" : "yes",
          Text("%.3g", f.mcnemar_p),
          std::to_string(f.queries),
          std::to_string(f.pairs)};
}

ReportTable TableOf(const Comparison& comparison) {
  ReportTable table;
  table.title = comparison.b + " against " + comparison.a;
  table.header = {"",           comparison.a, comparison.b, "difference", "95 % interval",
                  "differs", "McNemar p",  "photos",     "pairs"};
  for (const ComparedFigure& figure : comparison.figures) table.rows.push_back(RowOf(figure));
  return table;
}

// Share of the runs within x m and x degrees, for both.
ReportPlot RecallPlot(const Comparison& comparison) {
  ReportPlot plot;
  plot.title = "Recall of both: " + comparison.b + " against " + comparison.a;
  plot.note = "Share of the paired runs within x metres and x degrees; runs without a pose miss.";
  plot.x_label = "limit: x m and x°";
  plot.y_label = "share of the pairs [%]";
  for (const bool first : {true, false}) {
    ReportSeries series;
    series.name = first ? comparison.a : comparison.b;
    series.line = true;
    for (int step = 1; step <= 40; ++step) {
      const double limit = 0.25 * step;
      int right = 0;
      int all = 0;
      for (const RunPair& pair : comparison.pairs) {
        const RunRecord& run = first ? *pair.a : *pair.b;
        if (!run.has_truth) continue;
        ++all;
        const bool is_right =
            run.error && run.error->translation_m <= limit && run.error->rotation_deg <= limit;
        right += is_right ? 1 : 0;
      }
      if (all == 0) continue;
      series.x.push_back(limit);
      series.y.push_back(100.0 * right / all);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// Both errors of each pair; below the diagonal the second system is nearer.
ReportPlot ErrorPlot(const Comparison& comparison) {
  constexpr double kLeastM = 0.01;
  ReportPlot plot;
  plot.title = "Position errors, pair by pair";
  plot.note = "Below the line " + comparison.b + " is nearer to the truth, above it " +
              comparison.a + ". Pairs that both answer.";
  plot.x_label = "error of " + comparison.a + " [m]";
  plot.y_label = "error of " + comparison.b + " [m]";
  plot.x_log = plot.y_log = true;
  ReportSeries points;
  points.name = "pairs";
  double most = 1.0;
  for (const RunPair& pair : comparison.pairs) {
    if (!pair.a->error || !pair.b->error) continue;
    points.x.push_back(std::max(kLeastM, pair.a->error->translation_m));
    points.y.push_back(std::max(kLeastM, pair.b->error->translation_m));
    points.labels.push_back(pair.query);
    most = std::max({most, points.x.back(), points.y.back()});
  }
  plot.series = {std::move(points), {"equal", {kLeastM, most}, {kLeastM, most}, {}, true}};
  return plot;
}

ReportPose ReportPoseOf(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  ReportPose report;
  report.position = pose.center_in_world;
  report.heading_deg = angles.heading_deg;
  report.pitch_deg = angles.pitch_deg;
  report.roll_deg = angles.roll_deg;
  return report;
}

std::vector<OverlayLayer> LayersAt(const std::optional<Pose>& pose,
                                   const Localizer& localizer,
                                   const PinholeCamera& camera,
                                   const std::string& name,
                                   const Rgb& color) {
  if (!pose) return {};
  const Pose local = LocalFrame{localizer.scene().model().origin_in_world}.FromWorld(*pose);
  OverlayLayer layer = PlainEdgeLayer(localizer.scene(), camera, local, "model at " + name);
  layer.color = color;
  layer.width_px = 1.6;
  layer.opacity = 1.0;
  return {layer};
}

std::string AnswerText(const RunRecord& run) {
  if (!run.pose) return "no pose (" + run.status + ")";
  std::string text = run.status;
  if (run.error) {
    text += Text(", %.2f\u00a0m", run.error->translation_m) +
            Text(", %.2f°", run.error->rotation_deg) + " from the truth";
  }
  if (std::isfinite(run.confidence)) text += Text(", confidence %.2f", run.confidence);
  if (std::isfinite(run.energy)) text += Text(", energy %.4f", run.energy);
  return text;
}

std::string ErrorText(const RunRecord& run) {
  if (!run.pose) return "without a pose";
  if (!run.error) return "without a truth";
  return Text("%.2f\u00a0m, ", run.error->translation_m) + Text("%.2f°", run.error->rotation_deg);
}

ReportOutcome OutcomeOf(Disagreement disagreement) {
  switch (disagreement) {
    case Disagreement::kOnlyA:
      return ReportOutcome::kWrong;
    case Disagreement::kOnlyB:
      return ReportOutcome::kRight;
    case Disagreement::kOneAnswers:
      return ReportOutcome::kAbstained;
    default:
      return ReportOutcome::kUnknown;
  }
}

ReportRun RunOf(const Comparison& comparison,
                const RunPair& pair,
                const Query& query,
                const Localizer& localizer,
                bool many) {
  ReportRun run;
  run.id = pair.query + (many ? ": " + comparison.b : "");
  run.set = query.set;
  run.seed = pair.seed;
  const Disagreement disagreement = DisagreementOf(pair);
  run.outcome = OutcomeOf(disagreement);
  run.status = WordsOf(disagreement);
  run.reason = comparison.a + " " + ErrorText(*pair.a) + "; " + comparison.b + " " + ErrorText(*pair.b);
  run.confidence = NAN;
  run.energy = NAN;
  run.seconds = pair.b->seconds;
  if (pair.a->pose) run.prior = ReportPoseOf(*pair.a->pose);
  if (pair.b->pose) run.result = ReportPoseOf(*pair.b->pose);
  if (query.truth) run.truth = ReportPoseOf(*query.truth);
  const PinholeCamera camera = query.camera->Pinhole();
  run.prior_layers = LayersAt(pair.a->pose, localizer, camera, comparison.a, kColorA);
  run.result_layers = LayersAt(pair.b->pose, localizer, camera, comparison.b, kColorB);
  run.facts = {{comparison.a, AnswerText(*pair.a)}, {comparison.b, AnswerText(*pair.b)}};
  if (pair.a->pose && pair.b->pose) {
    const PoseError apart = ErrorOf(*pair.a->pose, *pair.b->pose);
    run.facts.emplace_back("apart",
                           Text("%.2f\u00a0m", apart.translation_m) +
                               Text(", %.2f°", apart.rotation_deg));
  }
  return run;
}

void AddPhotos(std::span<const Comparison> comparisons,
               const Dataset& dataset,
               const Localizer& localizer,
               ReportData& data) {
  PictureReader pictures;
  std::map<std::string, std::size_t> index;
  for (std::size_t q = 0; q < dataset.queries.size(); ++q) index[dataset.queries[q].id] = q;
  std::map<std::string, int> photos;
  for (const Comparison& comparison : comparisons) {
    for (const RunPair& pair : comparison.pairs) {
      if (DisagreementOf(pair) == Disagreement::kNone) continue;
      const auto it = index.find(pair.query);
      std::error_code error;
      if (it == index.end()) continue;
      const Query& query = dataset.queries[it->second];
      if (!query.camera || !std::filesystem::exists(query.image, error)) continue;
      const auto [photo, added] =
          photos.emplace(pair.query, static_cast<int>(data.photos.size()));
      if (added) data.photos.push_back(ReportPhotoOf(query, pictures));
      data.runs.push_back(RunOf(comparison, pair, query, localizer, comparisons.size() > 1));
      data.runs.back().photo = photo->second;
    }
  }
}

}  // namespace

ReportData CompareReport(const CompareTitle& title,
                         std::span<const Comparison> comparisons,
                         const Dataset* dataset,
                         const Localizer* localizer) {
  ReportData data;
  data.title = title.title;
  data.command = title.command;
  data.version = title.version;
  data.crs = title.crs;
  data.has_recall = false;
  data.pair_names = {comparisons.front().a,
                     comparisons.size() == 1 ? comparisons.front().b : "the other"};
  for (const Comparison& comparison : comparisons) {
    data.tables.push_back(TableOf(comparison));
    int apart = 0;
    for (const RunPair& pair : comparison.pairs) {
      apart += DisagreementOf(pair) == Disagreement::kNone ? 0 : 1;
    }
    data.facts.emplace_back(comparison.b + ": pairs", std::to_string(comparison.pairs.size()));
    data.facts.emplace_back(comparison.b + ": disagreements", std::to_string(apart));
    data.plots.push_back(RecallPlot(comparison));
    data.plots.push_back(ErrorPlot(comparison));
    for (const std::string& one : comparison.unpaired) data.warnings.push_back(one);
  }
  if (dataset != nullptr && localizer != nullptr) {
    AddPhotos(comparisons, *dataset, *localizer, data);
  }
  return data;
}

}  // namespace ridgeline
