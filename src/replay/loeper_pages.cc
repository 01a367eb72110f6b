// SPDX-License-Identifier: Apache-2.0
#include "replay/loeper_pages.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "eval/csv_text.h"
#include "replay/loeper_table.h"
#include "report/chart.h"

namespace ridgeline {
namespace {

std::string Percent(double share) { return TableNumber(100.0 * share, 2); }

std::string BoxText(double side_m, double heading_deg) {
  return TableNumber(side_m, 0) + " × " + TableNumber(side_m, 0) + " m, ± " +
         TableNumber(heading_deg, 0) + "°";
}

// Logarithmic where energies differ by more than a factor of 30, as a sharp score's do.
ChartAxis EnergyAxis(std::span<const LoeperRun* const> runs) {
  constexpr double kManifold = 30.0;
  double least = 1.0;
  for (const LoeperRun* run : runs) {
    for (const LoeperSample& sample : run->samples) {
      if (sample.energy > 0.0) least = std::min(least, sample.energy);
    }
  }
  if (kManifold * least >= 1.0) return {"energy", 0.0, 1.0, {}};
  return {"energy (logarithmic)", 0.7 * least, 1.3, {}, true};
}

// One panel per number of iterations, as in Fig. 5.
cv::Mat ScatterOf(std::span<const LoeperRun* const> runs,
                  std::span<const int> iterations,
                  const char* label,
                  double limit,
                  double LoeperSample::*error) {
  constexpr int kPanelPx = 460;
  Drawing picture = ChartPaper(kPanelPx * static_cast<int>(iterations.size()), kPanelPx);
  const ChartAxis energy = EnergyAxis(runs);
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    Chart chart;
    chart.title = std::to_string(iterations[i]) + " iterations";
    chart.x = {label, error == &LoeperSample::kappa_deg ? -limit : 0.0, limit, {}};
    chart.y = energy;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      ChartSeries series;
      series.color = SeriesColor(r);
      series.line = false;
      series.points = true;
      for (const LoeperSample& sample : runs[r]->samples) {
        if (sample.iteration > iterations[i]) break;
        series.x.push_back(sample.*error);
        series.y.push_back(energy.log ? std::max(sample.energy, *energy.lower) : sample.energy);
      }
      chart.series.push_back(std::move(series));
    }
    DrawChart(chart, {kPanelPx * static_cast<int>(i), 0, kPanelPx, kPanelPx}, picture);
  }
  return picture.Picture();
}

void AddScatter(std::span<const LoeperMethod> methods,
                std::span<const LoeperRun> runs,
                const LoeperReplayOptions& options,
                std::size_t pictures,
                ReplayPage& page) {
  const double side = *std::min_element(options.sides_m.begin(), options.sides_m.end());
  const double heading =
      *std::max_element(options.headings_deg.begin(), options.headings_deg.end());
  page.Heading("Fig. 5: score against error");
  page.Text("Every pose that the searches looked at, one colour a picture, in the box of " +
            BoxText(side, heading) +
            ". A score that tells the true pose has its low energies at the left (in the second "
            "row: in the middle). The paper sees no such cluster, and energies of 1 beside the "
            "truth.");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::vector<const LoeperRun*> shown;
    for (const LoeperRun& run : runs) {
      if (run.method == m && run.side_m == side && run.heading_deg == heading &&
          shown.size() < pictures) {
        shown.push_back(&run);
      }
    }
    if (shown.empty()) continue;
    const std::string name = methods[m].name;
    page.Picture("fig5_" + name + ".png",
                 "Fig. 5, " + name + ": " + methods[m].words + "; " +
                     std::to_string(shown.size()) + " pictures",
                 ScatterOf(shown,
                           options.iterations,
                           "horizontal error [m]",
                           // Priors off by half a side: errors up to a diagonal.
                           std::ceil((methods[m].around_truth ? 0.5 : 1.0) * std::sqrt(2.0) * side),
                           &LoeperSample::horizontal_m));
    page.Picture("fig5_rotation_" + name + ".png",
                 "The same by the error of kappa (5.1, in words), " + name,
                 ScatterOf(shown,
                           options.iterations,
                           "error of kappa [deg]",
                           (methods[m].around_truth ? 1.0 : 2.0) * heading,
                           &LoeperSample::kappa_deg));
  }
}

void AddTable(std::span<const LoeperMethod> methods,
              std::span<const LoeperRun> runs,
              const LoeperReplayOptions& options,
              ReplayPage& page) {
  std::vector<std::vector<std::string>> rows;
  const LoeperPrinted paper;
  rows.push_back({"paper (Braunschweig)",
                  BoxText(20.0, 20.0),
                  "200 at most",
                  "30",
                  Percent(paper.recall[0]),
                  Percent(paper.recall[1]),
                  Percent(paper.recall[2]),
                  TableNumber(paper.mean_translation_m, 2),
                  TableNumber(paper.mean_kappa_deg, 2),
                  "–",
                  TableNumber(paper.mad_translation_m, 2),
                  TableNumber(paper.mad_kappa_deg, 2)});
  for (const LoeperRow& row : LoeperTable(runs, options.iterations)) {
    rows.push_back({methods[row.method].name,
                    BoxText(row.side_m, row.heading_deg),
                    std::to_string(row.iterations),
                    std::to_string(row.pictures),
                    Percent(row.recall[0]),
                    Percent(row.recall[1]),
                    Percent(row.recall[2]),
                    TableNumber(row.mean_translation_m, 2),
                    TableNumber(row.mean_kappa_deg, 2),
                    TableNumber(row.mean_absolute_kappa_deg, 2),
                    TableNumber(row.mad_translation_m, 2),
                    TableNumber(row.mad_kappa_deg, 2)});
  }
  page.Heading("Table 1: localization results");
  for (const LoeperMethod& method : methods) page.Text(method.name + ": " + method.words + ".");
  page.Text(
      "Rotation errors are those of kappa (the other two angles are assumed, not searched), their "
      "mean is signed as in the paper. MAD: mean absolute deviation from the mean, of the signed "
      "errors for the rotation. A search around the true pose is flattered: its box is centred on "
      "the answer, and the sampler's prior density is highest there.");
  page.Table("table1.csv",
             "Table 1, in per cent, m and degrees.",
             {"method",
              "box",
              "iterations",
              "pictures",
              "2 m, 2°",
              "5 m, 5°",
              "9 m, 10°",
              "mean translation",
              "mean rotation, signed",
              "mean |rotation|",
              "MAD translation",
              "MAD rotation"},
             rows,
             {0});
}

}  // namespace

void AddLoeperFigures(const LoeperFigures& figures, const std::string& name, ReplayPage& page) {
  constexpr int kHeightPx = 520;
  page.Heading("Fig. 2 and 3: " + name);
  page.Picture("fig2.png",
               "Fig. 2: (a) projected building edges, (b) z-buffer, (c) segments by Canny and Hough "
               "from it (" +
                   std::to_string(figures.model_segments) + ")",
               SideBySide({figures.edges, figures.depth, figures.segments}, kHeightPx));
  page.Picture(
      "fig3.png",
      "Fig. 3: (a) segments of the model, (b) " + std::to_string(figures.picture_segments) +
          " segments of the picture, (c) matched: " +
          std::to_string(figures.matched_model_segments) + " segments of the model in " +
          std::to_string(figures.pairs) + " pairs; energy " + TableNumber(figures.energy, 3),
      SideBySide({figures.model, figures.picture, figures.matched}, kHeightPx));
}

void AddLoeperResults(const Dataset& dataset,
                      std::span<const LoeperMethod> methods,
                      std::span<const LoeperRun> runs,
                      const LoeperReplayOptions& options,
                      std::size_t pictures,
                      ReplayPage& page) {
  AddTable(methods, runs, options, page);
  AddScatter(methods, runs, options, pictures, page);
  std::string samples =
      "query,method,side_m,heading_deg,iteration,energy,t_err_m,t_err_horizontal_m,kappa_err_deg,"
      "r_err_deg\n";
  std::string results =
      "query,method,side_m,heading_deg,iterations,energy,t_err_m,t_err_horizontal_m,kappa_err_deg,"
      "r_err_deg,seconds\n";
  for (const LoeperRun& run : runs) {
    const std::string key = CsvField(dataset.queries[run.query].id) + ',' +
                            methods[run.method].name + ',' + CsvNumber(run.side_m, 1) + ',' +
                            CsvNumber(run.heading_deg, 1) + ',';
    const auto row = [&](int count, const LoeperSample& s) {
      return key + std::to_string(count) + ',' + CsvNumber(s.energy, 6) + ',' +
             CsvNumber(s.translation_m, 4) + ',' + CsvNumber(s.horizontal_m, 4) + ',' +
             CsvNumber(s.kappa_deg, 4) + ',' + CsvNumber(s.rotation_deg, 4);
    };
    for (const LoeperSample& sample : run.samples) {
      samples += row(sample.iteration, sample) + '\n';
    }
    for (const int count : options.iterations) {
      if (const LoeperSample* best = run.BestAfter(count)) {
        results += row(count, *best) + ',' + CsvNumber(run.seconds, 2) + '\n';
      }
    }
  }
  page.Heading("Files");
  page.File("results.csv", "The pose of least energy of every search:", results);
  page.File("samples.csv", "Every pose that was looked at:", samples);
}

}  // namespace ridgeline
