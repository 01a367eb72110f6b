// SPDX-License-Identifier: Apache-2.0
#include "report/study_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "eval/binomial.h"
#include "score/score.h"

namespace ridgeline {
namespace {

// Points of one class in one plot; more are thinned out evenly.
constexpr std::size_t kMaxPoints = 1500;

std::string Text(const char* format, double value) {
  if (!std::isfinite(value)) return "–";
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Percent(double share) { return Text("%.0f\u00a0%%", 100.0 * share); }
// With Wilson's 95 % interval, which says what few queries can.
std::string RecallText(double share, int queries) {
  const Interval95 interval = WilsonInterval(share, queries);
  return Percent(share) + Text(" (%.0f to ", 100.0 * interval.lower) +
         Text("%.0f)", 100.0 * interval.upper);
}
// One pose of 18 000 is 0.006 %.
std::string SmallPercent(double share) {
  return share == 0.0 ? "0\u00a0%" : Text("%.2g\u00a0%%", 100.0 * share);
}

std::vector<std::string> FigureCells(const std::array<double, kFigures>& values) {
  return {Text("%.2f\u00a0m", values[0]) + Text(", %.2f°", values[1]),
          SmallPercent(values[2]),
          Text("%.0f\u00a0m", values[3]) + Text(", %.0f°", values[4]),
          Text("%.2f", values[5]),
          Text("%.2f", values[6])};
}
const std::vector<std::string> kFigureCellNames = {
    "minimum to truth", "better poses", "comes home from", "margin", "rank correlation"};

ReportTable ScoreTable(std::span<const StudySummary> summaries) {
  ReportTable table;
  table.title = "Scores: where the map's minimum lies, and medians";
  table.header = {"score", "set", "queries", "2\u00a0m, 2°", "5\u00a0m, 5°", "9\u00a0m, 10°"};
  table.header.insert(table.header.end(), kFigureCellNames.begin(), kFigureCellNames.end());
  table.header.push_back("s per map");
  for (const StudySummary& summary : summaries) {
    std::vector<std::string> row = {summary.score, summary.set, std::to_string(summary.queries)};
    for (const double recall : summary.recall) {
      row.push_back(RecallText(recall, summary.queries));
    }
    for (std::string& cell : FigureCells(summary.median)) row.push_back(std::move(cell));
    row.push_back(Text("%.2f", summary.seconds));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable QueryTable(const StudyNames& names, std::span<const ScoreStudy> studies) {
  ReportTable table;
  table.title = "Each query";
  table.header = {"query", "score"};
  table.header.insert(table.header.end(), kFigureCellNames.begin(), kFigureCellNames.end());
  table.header.insert(table.header.end(), {"model edges in view", "lines in the picture"});
  for (const ScoreStudy& study : studies) {
    std::vector<std::string> row = {names.dataset.queries[study.query].id,
                                    names.scores[study.score].name};
    std::array<double, kFigures> values;
    for (std::size_t f = 0; f < kFigures; ++f) {
      values[f] = study.figures ? kFigureTexts[f].of(*study.figures) : NAN;
    }
    for (std::string& cell : FigureCells(values)) row.push_back(std::move(cell));
    row.push_back(std::to_string(study.visible_edges));
    row.push_back(std::to_string(study.picture_lines));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable SensitivityTable(const StudyNames& names, std::span<const LevelSummary> levels) {
  ReportTable table;
  table.title = "Sensitivity: one circumstance changed, all others as they are";
  table.header = {"changed", "level", "score", "2\u00a0m, 2°", "5\u00a0m, 5°", "9\u00a0m, 10°"};
  table.header.insert(table.header.end(), kFigureCellNames.begin(), kFigureCellNames.end());
  table.header.push_back("model edges in view");
  for (const LevelSummary& entry : levels) {
    const Variation& variation = names.variations[entry.variation];
    std::vector<std::string> row = {
        variation.meaning, variation.levels[entry.level], entry.summary.score};
    for (const double recall : entry.summary.recall) {
      row.push_back(RecallText(recall, entry.summary.queries));
    }
    for (std::string& cell : FigureCells(entry.summary.median)) row.push_back(std::move(cell));
    row.push_back(Text("%.0f", entry.visible_edges));
    table.rows.push_back(std::move(row));
  }
  return table;
}

// Whether the energies of a sharp score differ in their powers of ten.
bool SpansPowers(const ReportPlot& plot) {
  constexpr double kManifold = 30.0;
  double least = INFINITY;
  double worst = 0.0;
  for (const ReportSeries& series : plot.series) {
    for (const double energy : series.y) {
      if (energy > 0.0) least = std::min(least, energy);
      worst = std::max(worst, energy);
    }
  }
  return worst > kManifold * least;
}

ReportPlot ScatterPlot(const StudyNames& names,
                       std::span<const ScoreStudy> studies,
                       std::size_t score,
                       std::span<const int> classes,
                       bool rotation) {
  ReportPlot plot;
  plot.title = names.scores[score].name +
               (rotation ? ": score against rotation error" : ": score against position error");
  plot.note =
      "Poses that a TPE search looked at, by when it did, as in Fig. 5 of Loeper et al. Where a "
      "score can be trusted, the line of median errors falls to the left.";
  plot.x_label = rotation ? "rotation error [deg]" : "position error [m]";
  plot.y_label = "energy";
  for (std::size_t c = 0; c < classes.size(); ++c) {
    std::vector<const SampledPose*> poses;
    for (const ScoreStudy& study : studies) {
      if (study.score != score) continue;
      for (const SampledPose& pose : study.sampled) {
        if (pose.after == classes[c]) poses.push_back(&pose);
      }
    }
    ReportSeries series;
    series.name = "evaluations " + std::to_string(c == 0 ? 1 : classes[c - 1] + 1) + "–" +
                  std::to_string(classes[c]);
    const std::size_t every = (poses.size() + kMaxPoints - 1) / kMaxPoints;
    for (std::size_t i = 0; i < poses.size(); i += every) {
      series.x.push_back(rotation ? poses[i]->rotation_deg : poses[i]->translation_m);
      series.y.push_back(poses[i]->energy);
    }
    plot.series.push_back(std::move(series));
  }
  plot.y_log = SpansPowers(plot);
  constexpr std::size_t kGroups = 12;
  ReportSeries median;
  median.name = "median error";
  median.line = true;
  for (const EnergyGroup& group : ByEnergy(studies, score, classes.back(), kGroups)) {
    median.x.push_back(rotation ? group.rotation_deg : group.translation_m);
    median.y.push_back(group.energy);
  }
  plot.series.push_back(std::move(median));
  return plot;
}

// Share of all poses at one error, of all queries, from which a local search comes home.
ReportPlot HomePlot(const StudyNames& names,
                    std::span<const ScoreStudy> studies,
                    std::vector<ErrorBin> ScoreStudy::*bins,
                    const char* title,
                    const char* x_label) {
  ReportPlot plot;
  plot.title = title;
  plot.note =
      "A search that goes from a pose to the best beside it until none is better: how often "
      "it ends within 2 m and 2° of the truth.";
  plot.x_label = x_label;
  plot.y_label = "share of the poses [%]";
  for (std::size_t s = 0; s < names.scores.size(); ++s) {
    struct Count {
      double home = 0.0;
      int poses = 0;
      int queries = 0;
    };
    std::map<double, Count> by_error;
    int queries = 0;
    for (const ScoreStudy& study : studies) {
      if (study.score != s) continue;
      ++queries;
      for (const ErrorBin& bin : study.*bins) {
        Count& count = by_error[0.5 * (bin.lower + bin.upper)];
        count.home += bin.home_share * bin.poses;
        count.poses += bin.poses;
        ++count.queries;
      }
    }
    ReportSeries series;
    series.name = names.scores[s].name;
    series.line = true;
    for (const auto& [error, count] : by_error) {
      if (2 * count.queries < queries) continue;  // the corners of a few boxes
      series.x.push_back(error);
      series.y.push_back(100.0 * count.home / count.poses);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

ReportPlot EdgesPlot(const StudyNames& names, std::span<const ScoreStudy> studies) {
  ReportPlot plot;
  plot.title = "Error against the model's edges in view";
  plot.note = "Few edges in view leave a score little to compare; one point per query.";
  plot.x_label = "model edges in the picture, at the truth";
  plot.y_label = "minimum to truth [m]";
  for (std::size_t s = 0; s < names.scores.size(); ++s) {
    ReportSeries series;
    series.name = names.scores[s].name;
    for (const ScoreStudy& study : studies) {
      if (study.score != s || !study.figures) continue;
      series.x.push_back(study.visible_edges);
      series.y.push_back(study.figures->minimum_m);
      series.labels.push_back(names.dataset.queries[study.query].id);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

ReportPlot SensitivityPlot(const StudyNames& names,
                           std::span<const LevelSummary> levels,
                           std::size_t variation) {
  const Variation& varied = names.variations[variation];
  ReportPlot plot;
  plot.title = "Sensitivity: " + varied.meaning;
  plot.note = "Share of the queries whose map has its minimum within 2 m and 2° of the truth.";
  plot.x_label = varied.meaning;
  plot.y_label = "share of the queries [%]";
  plot.x_names = varied.levels;
  for (std::size_t s = 0; s < names.scores.size(); ++s) {
    ReportSeries series;
    series.name = names.scores[s].name;
    series.line = true;
    for (const LevelSummary& entry : levels) {
      if (entry.variation != variation || entry.score != s) continue;
      series.x.push_back(static_cast<double>(entry.level));
      series.y.push_back(100.0 * entry.summary.recall[0]);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

ReportPlot HeadingPlot(const Query& query, const ScoreStudy& study) {
  ReportPlot plot;
  plot.title = "Energy by heading";
  plot.note = "Least energy over all positions at each heading; 0 is the true heading.";
  plot.x_label = "heading, from the truth [deg]";
  plot.y_label = "energy";
  ReportSeries series;
  series.line = true;
  const double truth_deg = ViewAnglesOf(query.truth->cam_from_world).heading_deg;
  for (std::size_t h = 0; h < study.heading_deg.size(); ++h) {
    series.x.push_back(HeadingDifferenceDeg(study.heading_deg[h], truth_deg));
    series.y.push_back(study.heading_energy[h]);
  }
  plot.series.push_back(std::move(series));
  return plot;
}

// The map's minimum in the place of a localization's result.
BenchRun RunOf(const Query& query, const ScoreStudy& study, const StudyOptions& options) {
  BenchRun run;
  run.query = study.query;
  run.prior = study.prior;
  run.ranges = study.ranges;
  run.localization.map = study.map;
  run.localization.status = LocalizationStatus::kNoVisibleModel;
  run.localization.reason = study.reason;
  if (study.figures) {
    run.localization.status = LocalizationStatus::kOk;
    run.localization.reason.clear();
    run.localization.pose = study.minimum;
    run.localization.confidence = NAN;
    for (const float energy : study.map.energies) {
      if (!std::isnan(energy)) {
        run.localization.energy = std::min(run.localization.energy, static_cast<double>(energy));
      }
    }
    run.localization.modes = {{study.minimum, run.localization.energy}};
    run.localization.spread.position_covariance.setIdentity();  // not shown
    run.localization.evaluations = study.figures->poses;
  }
  run.record = RecordOf(query, static_cast<int>(options.seed), run.localization, study.seconds);
  return run;
}

std::vector<std::pair<std::string, std::string>> FactsOf(const ScoreStudy& study) {
  std::vector<std::pair<std::string, std::string>> facts;
  if (study.figures) {
    const Reliability& r = *study.figures;
    facts = {{"result", "the map's minimum, not refined"},
             {"better poses than the truth's neighbourhood", SmallPercent(r.better_share)},
             {"a local search comes home from",
              Text("%.0f\u00a0m", r.basin_m) + Text(", %.0f°", r.basin_deg)},
             {"margin of the best mode over the second", Text("%.2f", r.margin)},
             {"rank correlation of energy with error", Text("%.2f", r.rank_correlation)},
             {"poses of the map", std::to_string(r.poses)}};
  }
  facts.emplace_back("model edges in view at the truth", std::to_string(study.visible_edges));
  facts.emplace_back("lines in the picture", std::to_string(study.picture_lines));
  facts.emplace_back("time of the map", Text("%.2f s", study.seconds));
  return facts;
}

}  // namespace

ReportData StudyReport(const ReportOrigin& origin,
                       const StudyNames& names,
                       const Localizer& localizer,
                       const StudyOptions& options,
                       std::span<const ScoreStudy> studies,
                       std::span<const StudySummary> summaries,
                       std::span<const LevelSummary> levels) {
  std::vector<BenchRun> runs;
  for (const ScoreStudy& study : studies) {
    runs.push_back(RunOf(names.dataset.queries[study.query], study, options));
  }
  PictureReader pictures;
  ReportData data = BenchReport(origin, names.dataset.queries, localizer, runs, pictures);
  data.facts = {{"queries", std::to_string(studies.size() / names.scores.size())},
                {"scores", std::to_string(names.scores.size())},
                {"protocol", origin.protocol.name}};
  data.is_study = true;
  data.right_text = "maps have their minimum within 2 m and 2°";
  data.tables = {ScoreTable(summaries)};
  for (std::size_t i = 0; i < studies.size(); ++i) {
    ReportRun& run = data.runs[i];
    run.confidence = NAN;
    run.position_covariance.reset();
    run.facts = FactsOf(studies[i]);
    run.plots = {HeadingPlot(names.dataset.queries[studies[i].query], studies[i])};
    if (names.scores.size() > 1) run.id += ", " + names.scores[studies[i].score].name;
  }
  for (std::size_t s = 0; s < names.scores.size(); ++s) {
    data.plots.push_back(ScatterPlot(names, studies, s, options.classes, false));
    data.plots.push_back(ScatterPlot(names, studies, s, options.classes, true));
  }
  data.plots.push_back(HomePlot(names,
                                studies,
                                &ScoreStudy::by_distance,
                                "From how far a local search comes home",
                                "distance from the truth [m]; headings within 2°"));
  data.plots.push_back(HomePlot(names,
                                studies,
                                &ScoreStudy::by_angle,
                                "From which headings a local search comes home",
                                "angle from the truth [deg]; positions within 2 m"));
  data.plots.push_back(EdgesPlot(names, studies));
  for (std::size_t v = 0; v < names.variations.size(); ++v) {
    data.plots.push_back(SensitivityPlot(names, levels, v));
  }
  if (!levels.empty()) data.tables.push_back(SensitivityTable(names, levels));
  data.tables.push_back(QueryTable(names, studies));
  return data;
}

}  // namespace ridgeline
