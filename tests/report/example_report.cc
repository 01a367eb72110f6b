// SPDX-License-Identifier: Apache-2.0
#include "report/example_report.h"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "base/random.h"

namespace ridgeline::testing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector3d kPlace(690896.0, 5335940.0, 517.0);

cv::Mat Photo(int index) {
  cv::Mat photo(480, 640, CV_8UC3, cv::Scalar(200, 170, 140));
  const int shift = 17 * (index % 7);
  cv::rectangle(photo, {60 + shift, 140}, {300 + shift, 420}, {90, 120, 160}, cv::FILLED);
  cv::rectangle(photo, {330 + shift, 200}, {520 + shift, 420}, {150, 150, 150}, cv::FILLED);
  return photo;
}

OverlayLayer House(const char* name, const Rgb& color, float shift) {
  OverlayLayer layer;
  layer.name = name;
  layer.color = color;
  layer.lines = {{{60 + shift, 420}, {60 + shift, 140}, {300 + shift, 140}, {300 + shift, 420}},
                 {{330 + shift, 420}, {330 + shift, 200}, {520 + shift, 200}, {520 + shift, 420}}};
  return layer;
}

ReportEnergyMap Map(const Vector2d& best) {
  ReportEnergyMap map;
  map.first = kPlace.head<2>() - Vector2d(10.0, 10.0);
  map.columns = map.rows = 21;
  for (int r = 0; r < map.rows; ++r) {
    for (int c = 0; c < map.columns; ++c) {
      const double distance = (map.first + Vector2d(c, r) - best).norm();
      map.energies.push_back(c < 3 ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(1.0 - std::exp(-distance / 6.0)));
    }
  }
  return map;
}

ReportHillshade Hillshade() {
  ReportHillshade hillshade;
  hillshade.shade = cv::Mat(40, 40, CV_8U);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) hillshade.shade.at<uchar>(y, x) = static_cast<uchar>(130 + 2 * x);
  }
  hillshade.lower = kPlace.head<2>() - Vector2d(20.0, 20.0);
  hillshade.upper = kPlace.head<2>() + Vector2d(20.0, 20.0);
  return hillshade;
}

ReportRun Run(int index) {
  Random random(1, 2, static_cast<std::uint64_t>(index));
  ReportRun run;
  run.id = index == 0 ? "Straße \"1\" <script>alert(1)</script>'s.jpg"
                      : "query " + std::to_string(index);
  run.set = index % 2 == 0 ? "street" : "drone & co";
  run.photo = index;
  run.truth = ReportPose{kPlace, 112.0, 0.4, -0.2};
  run.prior = ReportPose{kPlace + Vector3d(random.Uniform(-9, 9), random.Uniform(-9, 9), 0.3),
                         112.0 + random.Uniform(-20, 20),
                         0.0,
                         0.0};
  const double error = index % 5 == 3 ? random.Uniform(3, 12) : random.Uniform(0.05, 1.2);
  run.result = ReportPose{kPlace + Vector3d(error, 0.1, 0.0), 112.3, 0.4, -0.2};
  run.outcome = index % 5 == 3 ? ReportOutcome::kWrong : ReportOutcome::kRight;
  run.status = "ok";
  if (index % 9 == 7) {
    run.outcome = ReportOutcome::kAbstained;
    run.status = "ambiguous";
    run.reason = "two poses explain the picture about equally well";
    run.result.reset();
  } else {
    run.translation_m = error;
    run.rotation_deg = 0.3;
  }
  run.energy = 0.3 + 0.03 * error + random.Uniform(0.0, 0.05);
  run.confidence =
      run.outcome == ReportOutcome::kRight ? random.Uniform(0.6, 1.0) : random.Uniform(0.1, 0.7);
  run.position_covariance = Eigen::Matrix2d{{0.2, 0.1}, {0.1, 0.4}};
  run.modes = {{run.result.value_or(*run.prior), run.energy},
               {ReportPose{kPlace + Vector3d(-5, 4, 0), 100.0, 0, 0}, run.energy + 0.02}};
  run.map = Map(kPlace.head<2>() + Vector2d(error, 0.1));
  run.hillshade = Hillshade();
  run.footprints = {{kPlace.head<2>() + Vector2d(3, 3),
                     kPlace.head<2>() + Vector2d(9, 3),
                     kPlace.head<2>() + Vector2d(9, 8),
                     kPlace.head<2>() + Vector2d(3, 8)}};
  const Vector2d box = run.prior->position.head<2>();
  run.search_box = {box + Vector2d(-10, -10),
                    box + Vector2d(10, -10),
                    box + Vector2d(10, 10),
                    box + Vector2d(-10, 10),
                    box + Vector2d(-10, -10)};
  const float shift = 17.0f * static_cast<float>(index % 7);
  run.prior_layers = {House("prior", {225, 225, 225}, shift + 55.0f)};
  run.result_layers = {House("against the sky", {0, 220, 255}, shift + 2.0f)};
  run.best_energy = {0.9, 0.8, 0.8, 0.6, 0.5, 0.45, run.energy};
  run.evaluations = 12000;
  run.seconds = 0.8 + 0.01 * index;
  run.facts = {{"evaluations", "12 000"}, {"time", "0.8 s"}};
  return run;
}

}  // namespace

ReportData ExampleReport(int runs) {
  ReportData data;
  data.title = "Bench of \"Müller & <b>Söhne</b>\"";
  data.command = "ridgeline bench 'a folder/dataset.json' --out out";
  data.version = "ridgeline test";
  data.crs = "EPSG:25832";
  data.facts = {{"photos", std::to_string(runs)},
                {"median error", "0.42 m, 0.3°"},
                {"time per photo", "0.9 s"},
                {"evaluations", "14 000 /s"}};
  for (int i = 0; i < runs; ++i) {
    data.photos.push_back({"photo " + std::to_string(i), Photo(i)});
    data.runs.push_back(Run(i));
  }
  ReportPlot plot;
  plot.title = "Energy along a line";
  plot.note = "Through the truth, towards the east.";
  plot.x_label = "east of the truth [m]";
  plot.y_label = "energy";
  plot.series = {{"line_energy", {-2, -1, 0, 1, 2}, {0.9, 0.7, 0.5, 0.6, 0.8}, {}, true}};
  data.plots.push_back(plot);
  data.tables.push_back(
      {"Recall", {"limit", "recall"}, {{"2 m, 2°", "81 %"}, {"5 m, 5°", "90 %"}}});
  data.warnings = {"3 polygons without area dropped (<b>obj</b>)"};
  data.options_json = "{\n  \"search\": {\"east_m\": 10}\n}";
  return data;
}

}  // namespace ridgeline::testing
