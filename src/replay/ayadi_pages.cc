// SPDX-License-Identifier: Apache-2.0
#include "replay/ayadi_pages.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "augment/impact.h"
#include "augment/insertion.h"
#include "eval/csv_text.h"
#include "report/chart.h"
#include "report/model_view.h"
#include "report/overlay_layers.h"

namespace ridgeline {
namespace {

constexpr std::size_t k3d = static_cast<std::size_t>(AyadiMethod::k3d);

// Table 1 of the paper: errors [px] of instruments, 2D, 2 x 2D, 3D, times [ms] on two telephones.
struct PrintedVideo {
  const char* name;
  double error_px[kAyadiMethodCount];
  double iphone6_ms[kAyadiMethodCount];
  double iphone7_ms[kAyadiMethodCount];
};
constexpr PrintedVideo kPrinted[] = {
    {"video 1", {49.62, 24.88, 6.34, 4.24}, {10.33, 53.43, 99.74, 5083}, {8.90, 35.09, 63.48, 1860}},
    {"video 2", {26.55, 13.19, 5.85, 5.22}, {10.21, 58.72, 103.76, 5705}, {8.89, 29.33, 62.87, 2125}},
    {"video 3", {17.37, 11.32, 5.23, 4.89}, {11.32, 58.96, 98.11, 5178}, {9.79, 37.18, 62.95, 1940}},
    {"video 4", {28.87, 8.33, 4.92, 4.23}, {10.11, 59.14, 96.12, 4932}, {9.07, 37.21, 63.13, 1880}}};

double MeanOf(std::span<const AyadiResult> frames,
              std::size_t method,
              const std::array<double, kAyadiMethodCount> AyadiResult::*values) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const AyadiResult& frame : frames) {
    const double value = (frame.*values)[method];
    if (!frame.usable || !std::isfinite(value)) continue;
    sum += std::abs(value);
    ++count;
  }
  return count == 0 ? std::nan("") : sum / static_cast<double>(count);
}

std::vector<std::string> Row(std::vector<std::string> cells,
                             const auto& errors,
                             const auto& times,
                             const auto& headings) {
  for (const double v : errors) cells.push_back(TableNumber(v, 2));
  for (const double v : times) cells.push_back(TableNumber(v, 1));
  for (const double v : headings) cells.push_back(TableNumber(v, 2));
  return cells;
}

void AddTable(std::span<const AyadiRun> runs, ReplayPage& page) {
  using Four = std::array<double, kAyadiMethodCount>;
  const Four none = {NAN, NAN, NAN, NAN};
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> marked;
  for (const PrintedVideo& video : kPrinted) {
    marked.push_back(rows.size());
    rows.push_back(Row({std::string("paper, ") + video.name, "iPhone 7 Plus", "–"},
                       video.error_px,
                       video.iphone7_ms,
                       none));
  }
  for (const AyadiRun& run : runs) {
    for (const bool is_plain : {true, false}) {
      Four errors, times, headings;
      for (std::size_t m = 0; m < kAyadiMethodCount; ++m) {
        errors[m] = MeanOf(
            run.frames, m, is_plain ? &AyadiResult::plain_l1_px : &AyadiResult::l1_px);
        times[m] = MeanOf(run.frames, m, &AyadiResult::total_ms);
        headings[m] = MeanOf(run.frames, m, &AyadiResult::heading_error_deg);
      }
      if (!is_plain && !run.variant.options.l1.robust) continue;  // the same twice
      rows.push_back(Row({run.variant.name,
                          is_plain ? "here, L1 of all columns"
                                   : "here, robust L1",
                          std::to_string(run.frames.size())},
                         errors,
                         times,
                         headings));
    }
  }
  std::vector<std::string> header = {"method", "on", "frames"};
  for (const char* unit : {" [px]", " [ms]", " |heading| [°]"}) {
    for (const char* method : kAyadiMethods) header.push_back(method + std::string(unit));
  }
  page.Heading("Table 1: mean distance of the skylines and time per frame");
  for (const AyadiRun& run : runs) {
    page.Text(run.variant.name + ": " + run.variant.words +
              (run.variant.rendered ? "; virtual skyline extracted from rendered images."
                                    : "; virtual skyline exact."));
  }
  page.Text(
      "Distances in pixels of a picture 640 px wide. Times hold extraction, clean-up and match; "
      "frames without a skyline do not count. The paper's pictures, and so its distances, are "
      "others; its times on an iPhone 6 are 10, 53 to 59, 96 to 104 and 4 932 to 5 705 ms.");
  page.Table("table1.csv", "Table 1.", header, rows, marked);
}

void AddCurves(const AyadiRun& run, ReplayPage& page) {
  Drawing picture = ChartPaper(1100, 440);
  Chart chart;
  chart.title = "L1 by frame, " + run.variant.name;
  chart.x = {"frame", {}, {}, {}};
  chart.y = {"L1 [px at 640]", 0.0, {}, {}};
  for (std::size_t m = 0; m < kAyadiMethodCount; ++m) {
    ChartSeries series;
    series.name = kAyadiMethods[m];
    series.color = SeriesColor(m);
    for (std::size_t f = 0; f < run.frames.size(); ++f) {
      series.x.push_back(static_cast<double>(f));
      series.y.push_back(run.frames[f].usable ? run.frames[f].plain_l1_px[m] : NAN);
    }
    chart.series.push_back(std::move(series));
  }
  DrawChart(chart, {0, 0, picture.width(), picture.height()}, picture);
  page.Picture("fig11_" + run.variant.name + ".png",
               "Fig. 11, " + run.variant.name + ": L1 over all columns by frame, four methods",
               picture.Picture());
}

std::string FramesCsv(std::span<const AyadiRun> runs) {
  std::string csv =
      "frame,variant,method,usable,l1_px,plain_l1_px,heading_error_deg,evaluations,ms,east_m,"
      "north_m,height_m,heading_deg,pitch_deg,roll_deg\n";
  for (const AyadiRun& run : runs) {
    for (const AyadiResult& f : run.frames) {
      for (std::size_t m = 0; m < kAyadiMethodCount; ++m) {
        const ViewAngles angles = ViewAnglesOf(f.pose[m].cam_from_world);
        const Eigen::Vector3d& c = f.pose[m].center_in_world;
        csv += CsvField(f.id) + ',' + run.variant.name + ',' + kAyadiMethods[m] + ',' +
               (f.usable ? "1," : "0,") + CsvNumber(f.l1_px[m], 3) + ',' +
               CsvNumber(f.plain_l1_px[m], 3) + ',' + CsvNumber(f.heading_error_deg[m], 4) + ',' +
               std::to_string(f.evaluations[m]) + ',' + CsvNumber(f.total_ms[m], 3) + ',' +
               CsvNumber(c.x(), 3) + ',' + CsvNumber(c.y(), 3) + ',' + CsvNumber(c.z(), 3) + ',' +
               CsvNumber(angles.heading_deg, 4) + ',' + CsvNumber(angles.pitch_deg, 4) + ',' +
               CsvNumber(angles.roll_deg, 4) + '\n';
      }
    }
  }
  return csv;
}

OverlayLayer Coloured(OverlayLayer layer, const char* name, Rgb color) {
  layer.name = name;
  layer.color = color;
  return layer;
}

// Real skyline red, the instruments' green, after the match blue, as in Fig. 10.
cv::Mat SkylinesDrawn(const Scene& scene,
                      const AyadiFrame& frame,
                      const Skyline& skyline,
                      const Pose& after,
                      const std::string& caption,
                      bool with_before) {
  Overlay overlay;
  overlay.layers.push_back(Coloured(SkylineLayer(skyline), "real", {230, 40, 40}));
  if (with_before) {
    overlay.layers.push_back(Coloured(
        ModelSkylineLayer(scene, frame.camera, frame.instruments), "instruments", {40, 200, 60}));
  }
  overlay.layers.push_back(
      Coloured(ModelSkylineLayer(scene, frame.camera, after), "after", {60, 110, 255}));
  overlay.caption = caption;
  return DrawOverlay(frame.picture, overlay, OverlayDrawOptions{true, 0.75});
}

cv::Mat LineDrawn(const cv::Mat& paper, const std::vector<Eigen::Vector2f>& line) {
  cv::Mat drawn = paper.clone();
  for (std::size_t i = 1; i < line.size(); ++i) {
    cv::line(drawn,
             cv::Point2f(line[i - 1].x(), line[i - 1].y()),
             cv::Point2f(line[i].x(), line[i].y()),
             {60, 60, 200},
             std::max(1, drawn.cols / 500),
             cv::LINE_AA);
  }
  for (const Eigen::Vector2f& p : line) {
    cv::circle(drawn, cv::Point2f(p.x(), p.y()), std::max(1, drawn.cols / 300), {160, 90, 20}, -1);
  }
  return drawn;
}

}  // namespace

void AddAyadiResults(std::span<const AyadiRun> runs, ReplayPage& page) {
  AddTable(runs, page);
  page.Heading("Fig. 11: distance by frame");
  for (const AyadiRun& run : runs) AddCurves(run, page);
  page.File("frames.csv", "All frames, methods and poses (local frame):", FramesCsv(runs));
}

void AddAyadiStability(std::span<const AyadiRun> runs,
                       std::span<const AyadiFrame> frames,
                       const AyadiTemporal& temporal,
                       const TexturedMesh& tower,
                       ReplayPage& page) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& name, const auto& pose_of) {
    std::vector<InsertedFrame> inserted;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      inserted.push_back({frames[i].camera, pose_of(i), frames[i].truth});
    }
    const InsertionStability s = StabilityOf(inserted, tower);
    if (s.frames == 0) return;
    rows.push_back({name,
                    std::to_string(s.frames),
                    TableNumber(s.mean_error_px, 2),
                    TableNumber(s.worst_error_px, 2),
                    TableNumber(s.jitter_px, 2)});
  };
  for (const AyadiRun& run : runs) {
    for (std::size_t m = 0; m < kAyadiMethodCount; ++m) {
      add(run.variant.name + ", " + kAyadiMethods[m],
          [&](std::size_t i) { return std::optional<Pose>(run.frames[i].pose[m]); });
    }
  }
  add("temporal", [&](std::size_t i) { return temporal.poses[i]; });
  page.Heading("How true and how steady the insertion stands");
  if (rows.empty()) {
    page.Text("Not known: no frame has a true pose, or the building is not before the camera.");
    return;
  }
  page.Text(
      "Distance of the new building's corners in the picture from where the true pose puts them, in "
      "pixels of the picture; jitter: root mean square of its change from frame to frame, which is "
      "seen as hovering. Temporal: from the last frame, with key frames in six degrees of freedom.");
  page.Table("stability.csv",
             "Insertion.",
             {"poses", "frames", "mean error [px]", "worst [px]", "jitter [px]"},
             rows);
}

void AddAyadiSizes(std::span<const AyadiRun> runs, ReplayPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const AyadiRun& run : runs) {
    for (const double precision : {0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0}) {
      double points = 0.0, kept = 0.0, simple = 0.0;
      for (const AyadiResult& frame : run.frames) {
        const SimplifiedSkyline s = Simplified(
            frame.skyline, precision * frame.skyline.image_width / kSkylineReferenceWidthPx);
        points += static_cast<double>(s.points) / run.frames.size();
        kept += static_cast<double>(s.without_outliers) / run.frames.size();
        simple += static_cast<double>(s.simplified) / run.frames.size();
      }
      rows.push_back({run.variant.name,
                      TableNumber(precision, 1),
                      TableNumber(points, 1),
                      TableNumber(kept, 1),
                      TableNumber(simple, 1)});
    }
  }
  page.Heading("Table 2: points of a skyline before and after its simplification");
  page.Text(
      "Means over the frames. The paper's own Table 2 is in its supplementary material; the text "
      "says that a few dozen points are left. A precision of 0 simplifies nothing.");
  page.Table("table2.csv",
             "Table 2.",
             {"extraction", "precision [px at 640]", "points", "after Algorithm 1",
              "after Douglas-Peucker"},
             rows);
}

void AddAyadiFrame(const Scene& scene,
                   const AyadiVariant& variant,
                   const AyadiFrame& frame,
                   const AyadiResult& result,
                   const TexturedMesh* tower,
                   ReplayPage& page) {
  constexpr int kHeightPx = 360;
  const std::string of = variant.name + ", frame " + frame.id;
  const cv::Mat paper(frame.picture.size(), CV_8UC3, cv::Scalar(255, 255, 255));
  const double scale = result.skyline.image_width / kSkylineReferenceWidthPx;
  const SimplifiedSkyline all = Simplified(result.skyline, 0.0);
  const SimplifiedSkyline simple = Simplified(result.skyline, 2.0 * scale);
  page.Heading("Frame " + frame.id + ", " + variant.name);
  page.Picture("fig8_" + variant.name + ".png",
               "Fig. 8, " + of + ": " + std::to_string(all.points) + " points as extracted, " +
                   std::to_string(simple.simplified) + " after the simplification (2 px)",
               SideBySide({LineDrawn(paper, all.line), LineDrawn(paper, simple.line)}, kHeightPx));

  std::vector<cv::Mat> skylines, views = {frame.picture};
  for (std::size_t m = 0; m < kAyadiMethodCount; ++m) {
    const std::string caption =
        std::string(kAyadiMethods[m]) + ": " + TableNumber(result.plain_l1_px[m], 2) + " px";
    skylines.push_back(
        SkylinesDrawn(scene, frame, result.skyline, result.pose[m], caption, m > 0));
    views.push_back(
        ShadedPicture(scene.Render(frame.camera, result.pose[m], true), scene.model()));
  }
  page.Picture("fig10_" + variant.name + ".png",
               "Fig. 7 and 10, " + of +
                   ": real skyline red, by the instruments green, after the match blue; "
                   "instruments, 2D, 2 x 2D, 3D",
               SideBySide(skylines, kHeightPx));
  page.Picture("fig12_" + variant.name + ".png",
               "Fig. 12, " + of + ": real picture; virtual ones by instruments, 2D, 2 x 2D, 3D",
               SideBySide(views, kHeightPx));
  if (tower == nullptr) return;
  std::vector<cv::Mat> augmented;
  const Inserter inserter(scene, *tower);
  for (const std::size_t m : {std::size_t{0}, k3d}) {
    augmented.push_back(
        inserter.Insert(frame.picture, frame.camera, result.pose[m], InsertionOptions{}).picture);
  }
  page.Picture("fig13_" + variant.name + ".png",
               "Fig. 13, " + of + ": the new building by the instruments' pose and after 3D",
               SideBySide(augmented, kHeightPx));
}

void AddAyadiDomain(const AyadiDomain& domain,
                    const AyadiFrame& frame,
                    const std::string& variant,
                    ReplayPage& page) {
  GridPicture grid;
  grid.title = "Fig. 9: least L1 over the attitudes";
  grid.note = "frame " + frame.id + ", " + variant;
  grid.value_label = "L1 [px at 640]";
  const int steps = (domain.cells - 1) / 2;
  grid.first_east_m = grid.first_north_m = -steps * domain.spacing_m;
  grid.spacing_m = domain.spacing_m;
  grid.columns = grid.rows = domain.cells;
  grid.values = domain.distance_px;
  grid.marks.push_back({"instruments", 0.0, 0.0, 1, {20, 20, 20}});
  if (frame.truth) {
    const Eigen::Vector3d off =
        frame.truth->center_in_world - frame.instruments.center_in_world;
    grid.marks.push_back({"truth", off.x(), off.y(), 0, {30, 90, 220}});
  }
  Drawing picture = ChartPaper(760, 640);
  DrawGrid(grid, {0, 0, picture.width(), picture.height()}, picture);
  page.Heading("Fig. 9: exploration of the positions");
  page.Picture("fig9.png",
               "Every " + TableNumber(domain.spacing_m, 1) +
                   " m around the instruments' position the least distance of a 3D match",
               picture.Picture());
  std::string csv = "east_m,north_m,l1_px\n";
  for (std::size_t i = 0; i < domain.distance_px.size(); ++i) {
    csv += CsvNumber((static_cast<int>(i % domain.cells) - steps) * domain.spacing_m, 2) + ',' +
           CsvNumber((static_cast<int>(i / domain.cells) - steps) * domain.spacing_m, 2) + ',' +
           CsvNumber(domain.distance_px[i], 3) + '\n';
  }
  page.File("fig9.csv", "Its values, from the instruments' position:", csv);
}

CityModel TowerBefore(const Pose& cam_from_local, double distance_m, double ground_height_m) {
  constexpr double kHalfM = 7.0, kHeightM = 45.0;
  const double heading =
      ViewAnglesOf(cam_from_local.cam_from_world).heading_deg * std::numbers::pi / 180.0;
  const Eigen::Vector3d middle(
      cam_from_local.center_in_world.x() + distance_m * std::sin(heading),
      cam_from_local.center_in_world.y() + distance_m * std::cos(heading),
      ground_height_m);
  CityModel model;
  model.buildings.emplace_back();
  for (const double z : {0.0, kHeightM}) {
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      model.vertices.push_back(middle + Eigen::Vector3d(x * kHalfM, y * kHalfM, z));
    }
  }
  const auto face = [&](std::array<std::uint32_t, 4> v, SurfaceClass c, Eigen::Vector3f normal) {
    const auto surface = static_cast<std::uint32_t>(model.surfaces.size());
    Surface s;
    s.surface_class = c;
    s.normal = normal;
    model.surfaces.push_back(s);
    model.triangles.push_back({{v[0], v[1], v[2]}, surface});
    model.triangles.push_back({{v[0], v[2], v[3]}, surface});
  };
  face({4, 5, 6, 7}, SurfaceClass::kRoof, {0.0f, 0.0f, 1.0f});
  face({0, 1, 5, 4}, SurfaceClass::kWall, {0.0f, -1.0f, 0.0f});
  face({1, 2, 6, 5}, SurfaceClass::kWall, {1.0f, 0.0f, 0.0f});
  face({2, 3, 7, 6}, SurfaceClass::kWall, {0.0f, 1.0f, 0.0f});
  face({3, 0, 4, 7}, SurfaceClass::kWall, {-1.0f, 0.0f, 0.0f});
  return model;
}

}  // namespace ridgeline
