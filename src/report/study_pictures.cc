// SPDX-License-Identifier: Apache-2.0
#include "report/study_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "report/chart.h"
#include "score/score.h"

namespace ridgeline {
namespace {

constexpr Rgb kTruthColor{213, 40, 40};
constexpr Rgb kMinimumColor{20, 20, 20};
constexpr Rgb kPriorColor{110, 110, 110};

// Of equal size, for the median error at an energy.
constexpr std::size_t kEnergyGroups = 12;

std::string Text(const char* format, double a, double b = 0.0) {
  char text[96];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

std::string TitleOf(const StudyNames& names, const ScoreStudy& study) {
  return names.dataset.queries[study.query].id + ": " + names.scores[study.score].name;
}

GridPicture GridOf(const EnergyMap& map, const ScoreStudy& study, const Pose& truth) {
  const Eigen::Vector2d& prior = study.prior.position_in_world;
  GridPicture grid;
  grid.first_east_m = map.first.x() - prior.x();
  grid.first_north_m = map.first.y() - prior.y();
  grid.spacing_m = map.spacing_m;
  grid.columns = map.columns;
  grid.rows = map.rows;
  grid.values.assign(map.energies.begin(), map.energies.end());
  const Eigen::Vector2d t = truth.center_in_world.head<2>() - prior;
  grid.marks.push_back({"prior", 0.0, 0.0, 2, kPriorColor});
  grid.marks.push_back({"truth", t.x(), t.y(), 0, kTruthColor});
  return grid;
}

ChartSeries Profile(std::span<const ErrorBin> bins,
                    const char* name,
                    std::size_t color,
                    double (*value)(const ErrorBin&)) {
  ChartSeries series{name, SeriesColor(color), {}, {}, true, false};
  for (const ErrorBin& bin : bins) {
    series.x.push_back(0.5 * (bin.lower + bin.upper));
    series.y.push_back(value(bin));
  }
  return series;
}

// Energies of a sharp score differ in their powers of ten: on a linear axis all but the worst lie
// on its foot.
bool WantsLog(double least, double worst) {
  constexpr double kManifold = 30.0;
  return least > 0.0 && worst > kManifold * least;
}

bool SpansPowers(const Chart& chart) {
  double least = INFINITY;
  double worst = 0.0;
  for (const ChartSeries& series : chart.series) {
    for (const double energy : series.y) {
      if (energy > 0.0) least = std::min(least, energy);
      if (std::isfinite(energy)) worst = std::max(worst, energy);
    }
  }
  return WantsLog(least, worst);
}

ChartAxis EnergyAxis(double least, double worst) {
  if (WantsLog(least, worst)) return {"energy (logarithmic)", 0.5 * least, 2.0 * worst, {}, true};
  const double pad = std::max(1e-3, 0.04 * (worst - least));
  return {"energy", least - pad, worst + pad, {}, false};
}

}  // namespace

Drawing MapPicture(const StudyNames& names, const ScoreStudy& study) {
  const Query& query = names.dataset.queries[study.query];
  Drawing picture = ChartPaper(1180, 640);
  GridPicture grid = GridOf(study.map, study, *query.truth);
  grid.title = TitleOf(names, study);
  grid.value_label = "energy, least over headings";
  if (study.figures) {
    const Eigen::Vector2d m =
        study.minimum.center_in_world.head<2>() - study.prior.position_in_world;
    grid.marks.push_back({"minimum", m.x(), m.y(), 1, kMinimumColor});
    grid.note = Text("minimum %.2f m, %.2f deg from the truth; ",
                     study.figures->minimum_m,
                     study.figures->minimum_deg) +
                (std::isnan(study.figures->better_share)
                     ? "no pose of the map near the truth"
                     : Text("%.2g %% of all poses score better than near it",
                            100.0 * study.figures->better_share));
  } else {
    grid.note = study.reason;
  }
  DrawGrid(grid, {0, 0, 660, 640}, picture);

  Chart heading;
  heading.title = "Energy by heading, least over positions";
  heading.x.label = "heading, from the truth [deg]";
  heading.y.label = "energy";
  heading.mark = 0.0;
  heading.mark_name = "truth";
  ChartSeries curve{"", SeriesColor(0), {}, {}, true, true};
  const double truth_deg = ViewAnglesOf(query.truth->cam_from_world).heading_deg;
  for (std::size_t h = 0; h < study.heading_deg.size(); ++h) {
    curve.x.push_back(HeadingDifferenceDeg(study.heading_deg[h], truth_deg));
    curve.y.push_back(study.heading_energy[h]);
  }
  heading.series.push_back(std::move(curve));
  heading.y.log = SpansPowers(heading);
  DrawChart(heading, {670, 0, 500, 310}, picture);

  Chart distance;
  distance.title = "Energy by distance from the truth (headings within 2 deg)";
  distance.x.label = "distance [m]";
  distance.x.lower = 0.0;
  distance.y.label = "energy";
  distance.series = {
      Profile(study.by_distance,
              "least",
              0,
              [](const ErrorBin& bin) { return Score::EnergyOf(bin.best_log_ratio); }),
      Profile(study.by_distance, "median", 4, [](const ErrorBin& bin) {
        return Score::EnergyOf(bin.median_log_ratio);
      })};
  distance.y.log = SpansPowers(distance);
  DrawChart(distance, {670, 320, 500, 310}, picture);
  return picture;
}

Drawing ExploredPicture(const StudyNames& names, const ScoreStudy& study) {
  const ScoreChoice& score = names.scores[study.score];
  const EnergyMap& map = study.explored->map;
  Drawing picture = ChartPaper(840, 800);
  GridPicture grid = GridOf(map, study, *names.dataset.queries[study.query].truth);
  grid.title = TitleOf(names, study) + Text(", explored at %.2f m", map.spacing_m);
  grid.value_label = "energy with the best angles";
  if (score.options.name == "skyline_l1") {
    grid.value_label = "mean distance of the skylines, best angles [px at 640]";
    for (double& value : grid.values) value = SkylineDistanceOf(value, score.options);
  }
  std::size_t best = grid.values.size();
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    if (std::isfinite(grid.values[i]) &&
        (best == grid.values.size() || grid.values[i] < grid.values[best])) {
      best = i;
    }
  }
  if (best < grid.values.size()) {
    const double east = grid.first_east_m + static_cast<double>(best % map.columns) * map.spacing_m;
    const double north =
        grid.first_north_m + static_cast<double>(best / map.columns) * map.spacing_m;
    const GridPicture::Mark& truth = grid.marks.back();
    grid.note = Text("minimum %.2f m from the truth, ",
                     std::hypot(east - truth.east_m, north - truth.north_m)) +
                Text("value %.3g", grid.values[best]);
    grid.marks.push_back({"minimum", east, north, 1, kMinimumColor});
  }
  DrawGrid(grid, {0, 0, 840, 800}, picture);
  return picture;
}

Drawing ScatterPicture(const StudyNames& names,
                       std::span<const ScoreStudy> studies,
                       std::size_t score,
                       std::span<const int> classes) {
  constexpr int kWidth = 420;
  constexpr int kHeight = 360;
  Drawing picture = ChartPaper(kWidth * static_cast<int>(classes.size()), 2 * kHeight);
  // One scale for all panels, so that they compare.
  double least = 1.0;
  double worst = 0.0;
  for (const ScoreStudy& study : studies) {
    if (study.score != score) continue;
    for (const SampledPose& pose : study.sampled) {
      if (pose.energy > 0.0) least = std::min(least, pose.energy);
      worst = std::max(worst, pose.energy);
    }
  }
  const ChartAxis energy = EnergyAxis(least, worst);
  for (std::size_t panel = 0; panel < classes.size(); ++panel) {
    Chart translation;
    translation.title =
        names.scores[score].name + ", " + std::to_string(classes[panel]) + " evaluations a picture";
    translation.x = {"position error [m]", 0.0, {}, {}, false};
    translation.y = energy;
    Chart rotation;
    rotation.x = {"rotation error [deg]", 0.0, {}, {}, false};
    rotation.y = energy;
    for (std::size_t c = 0; c <= panel; ++c) {
      const int first = c == 0 ? 1 : classes[c - 1] + 1;
      const std::string name = std::to_string(first) + "-" + std::to_string(classes[c]);
      constexpr std::size_t kColors[] = {5, 0, 1, 2, 3, 4, 6, 7};
      ChartSeries points{name, SeriesColor(kColors[c % 8]), {}, {}, false, true};
      ChartSeries turned = points;
      for (const ScoreStudy& study : studies) {
        if (study.score != score) continue;
        for (const SampledPose& pose : study.sampled) {
          if (pose.after != classes[c]) continue;
          points.x.push_back(pose.translation_m);
          turned.x.push_back(pose.rotation_deg);
          points.y.push_back(pose.energy);
          turned.y.push_back(pose.energy);
        }
      }
      translation.series.push_back(std::move(points));
      rotation.series.push_back(std::move(turned));
    }
    ChartSeries median{"median error", SeriesColor(6), {}, {}, true, false};
    ChartSeries median_turned = median;
    for (const EnergyGroup& group : ByEnergy(studies, score, classes[panel], kEnergyGroups)) {
      median.x.push_back(group.translation_m);
      median_turned.x.push_back(group.rotation_deg);
      median.y.push_back(group.energy);
      median_turned.y.push_back(group.energy);
    }
    translation.series.push_back(std::move(median));
    rotation.series.push_back(std::move(median_turned));
    const int left = kWidth * static_cast<int>(panel);
    DrawChart(translation, {left, 0, kWidth, kHeight}, picture);
    DrawChart(rotation, {left, kHeight, kWidth, kHeight}, picture);
  }
  return picture;
}

Drawing SensitivityPicture(const StudyNames& names,
                           std::span<const LevelSummary> summaries,
                           std::size_t variation) {
  constexpr int kWidth = 400;
  constexpr int kHeight = 320;
  constexpr int kColumns = 3;
  // Recall first, then the median of each figure.
  constexpr std::size_t kPanels = kFigures + 2;
  const Variation& varied = names.variations[variation];
  std::vector<LegendEntry> legend;
  for (std::size_t s = 0; s < names.scores.size(); ++s) {
    legend.push_back({names.scores[s].name, SeriesColor(s)});
  }
  const int top = LegendHeight(legend, kWidth * kColumns);
  constexpr int kRows = static_cast<int>((kPanels + kColumns - 1) / kColumns);
  Drawing picture = ChartPaper(kWidth * kColumns, top + kHeight * kRows);
  DrawLegend(legend, {0, 0, picture.width(), top}, picture);
  for (std::size_t panel = 0; panel < kPanels; ++panel) {
    Chart chart;
    chart.x = {varied.meaning, {}, {}, varied.levels, false};
    if (panel < 2) {
      chart.title = panel == 0 ? "Minimum within 2 m, 2 deg [%]" : "Minimum within 5 m, 5 deg [%]";
      chart.y = {"% of the queries", 0.0, 105.0, {}, false};
    } else {
      constexpr const char* kTitles[kFigures] = {"Minimum to truth [m]",
                                                 "Minimum to truth [deg]",
                                                 "Poses better than the truth's [%]",
                                                 "Comes home from [m]",
                                                 "Comes home from [deg]",
                                                 "Margin of the best mode",
                                                 "Rank correlation"};
      chart.title = kTitles[panel - 2];
      chart.y = {"median of the queries", {}, {}, {}, false};
      if (panel - 2 < 5) chart.y.lower = 0.0;
    }
    for (std::size_t s = 0; s < names.scores.size(); ++s) {
      ChartSeries series{"", SeriesColor(s), {}, {}, true, true};
      for (const LevelSummary& entry : summaries) {
        if (entry.variation != variation || entry.score != s) continue;
        series.x.push_back(static_cast<double>(entry.level));
        const double value =
            panel < 2 ? 100.0 * entry.summary.recall[panel] : entry.summary.median[panel - 2];
        series.y.push_back(panel - 2 == 2 ? 100.0 * value : value);
      }
      chart.series.push_back(std::move(series));
    }
    const int column = static_cast<int>(panel) % kColumns;
    const int row = static_cast<int>(panel) / kColumns;
    DrawChart(chart, {column * kWidth, top + row * kHeight, kWidth, kHeight}, picture);
  }
  return picture;
}

}  // namespace ridgeline
