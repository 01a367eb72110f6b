// SPDX-License-Identifier: Apache-2.0
#include "report/report_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/decimals.h"
#include "report/map_shapes.h"
#include "report/picture_file.h"
#include "report/report_curves.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Json = nlohmann::ordered_json;

// JSON has no NaN; the script takes null for "none".
Json Number(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  return RoundedTo(value, decimals);
}

Json Optional(const std::optional<double>& value, int decimals) {
  return value ? Number(*value, decimals) : Json(nullptr);
}

// With five significant digits: energies of a sharp score differ in their powers of ten.
Json Significant(double value) {
  if (!std::isfinite(value) || value == 0.0) return Number(value, 0);
  return RoundedTo(value, std::max(0, 4 - static_cast<int>(std::floor(std::log10(std::abs(value))))));
}

// Whole hundredths of a metre keep lists short; the script divides.
Json Centimetres(const std::vector<Vector2d>& points, const Vector2d& origin) {
  Json list = Json::array();
  for (const Vector2d& p : points) {
    list.push_back(std::llround(100.0 * (p.x() - origin.x())));
    list.push_back(std::llround(100.0 * (p.y() - origin.y())));
  }
  return list;
}

Json PoseJson(const std::optional<ReportPose>& pose) {
  if (!pose) return nullptr;
  return {{"position",
           {Number(pose->position.x(), 3),
            Number(pose->position.y(), 3),
            Number(pose->position.z(), 3)}},
          {"heading", Number(pose->heading_deg, 3)},
          {"pitch", Number(pose->pitch_deg, 3)},
          {"roll", Number(pose->roll_deg, 3)},
          {"hasHeading", pose->has_heading},
          {"hasHeight", pose->has_height},
          {"hasTilt", pose->has_tilt}};
}

// Lines of a layer in tenths of a pixel.
Json LayerJson(const OverlayLayer& layer) {
  Json lines = Json::array();
  for (const auto& line : layer.lines) {
    Json points = Json::array();
    for (const Eigen::Vector2f& p : line) {
      points.push_back(std::lround(10.0f * p.x()));
      points.push_back(std::lround(10.0f * p.y()));
    }
    lines.push_back(std::move(points));
  }
  return {{"name", layer.name}, {"color", HexColor(layer.color)}, {"lines", std::move(lines)}};
}

Json LayersJson(const std::vector<OverlayLayer>& layers) {
  Json list = Json::array();
  for (const OverlayLayer& layer : layers) {
    if (!layer.lines.empty()) list.push_back(LayerJson(layer));
  }
  return list;
}

const char* OutcomeName(ReportOutcome outcome) {
  switch (outcome) {
    case ReportOutcome::kRight:
      return "right";
    case ReportOutcome::kWrong:
      return "wrong";
    case ReportOutcome::kAbstained:
      return "abstained";
    case ReportOutcome::kUnknown:
      return "unknown";
  }
  return "";
}

// The point that the map's coordinates are relative to.
Vector2d MapOrigin(const ReportRun& run) {
  for (const auto& pose : {run.prior, run.result, run.truth}) {
    if (pose) return pose->position.head<2>();
  }
  return run.map ? run.map->first : Vector2d::Zero();
}

Json MapJson(const ReportEnergyMap& map, const Vector2d& origin) {
  Json energies = Json::array();
  for (const float energy : map.energies) energies.push_back(Significant(energy));
  return {{"east", Number(map.first.x() - origin.x(), 3)},
          {"north", Number(map.first.y() - origin.y(), 3)},
          {"spacing", map.spacing_m},
          {"columns", map.columns},
          {"rows", map.rows},
          {"energies", std::move(energies)}};
}

Json HillshadeJson(const ReportHillshade& hillshade, const Vector2d& origin) {
  return {
      {"url", JpegDataUrl(hillshade.shade, 512, 85)},
      {"lower",
       {Number(hillshade.lower.x() - origin.x(), 2), Number(hillshade.lower.y() - origin.y(), 2)}},
      {"upper",
       {Number(hillshade.upper.x() - origin.x(), 2), Number(hillshade.upper.y() - origin.y(), 2)}}};
}

Json RunRow(const ReportRun& run) {
  return {{"id", run.id},
          {"set", run.set},
          {"seed", run.seed},
          {"photo", run.photo},
          {"status", run.status},
          {"reason", run.reason},
          {"outcome", OutcomeName(run.outcome)},
          {"energy", Significant(run.energy)},
          {"confidence", Number(run.confidence, 4)},
          {"translation", Optional(run.translation_m, 3)},
          {"rotation", Optional(run.rotation_deg, 3)},
          {"evaluations", Number(run.evaluations, 0)},
          {"seconds", Number(run.seconds, 3)}};
}

Json CurveJson(const std::vector<Share95>& curve) {
  Json list = Json::array();
  for (const Share95& s : curve) {
    list.push_back(
        {Number(s.x, 4), Number(s.share, 5), Number(s.lower, 5), Number(s.upper, 5), s.count});
  }
  return list;
}

Json PairsJson(const std::vector<std::pair<std::string, std::string>>& pairs) {
  Json list = Json::array();
  for (const auto& [name, value] : pairs) list.push_back({name, value});
  return list;
}

Json PlotJson(const ReportPlot& plot) {
  Json series = Json::array();
  for (const ReportSeries& s : plot.series) {
    Json x = Json::array();
    Json y = Json::array();
    for (const double value : s.x) x.push_back(Number(value, 6));
    for (const double value : s.y) y.push_back(Significant(value));
    series.push_back(
        {{"name", s.name}, {"x", x}, {"y", y}, {"labels", s.labels}, {"line", s.line}});
  }
  return {{"title", plot.title},
          {"note", plot.note},
          {"x", plot.x_label},
          {"y", plot.y_label},
          {"xLog", plot.x_log},
          {"yLog", plot.y_log},
          {"xNames", plot.x_names},
          {"series", series}};
}

// '<' could end the <script> element; invalid UTF-8 is replaced.
std::string SafeDump(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string SummaryJson(const ReportData& data) {
  Json runs = Json::array();
  for (const ReportRun& run : data.runs) runs.push_back(RunRow(run));
  Json plots = Json::array();
  for (const ReportPlot& plot : data.plots) plots.push_back(PlotJson(plot));
  Json tables = Json::array();
  for (const ReportTable& table : data.tables) {
    tables.push_back({{"title", table.title}, {"header", table.header}, {"rows", table.rows}});
  }
  return SafeDump(
      {{"title", data.title},
       {"command", data.command},
       {"version", data.version},
       {"crs", data.crs},
       {"rightText", data.right_text},
       {"isStudy", data.is_study},
       {"pair", data.pair_names ? Json(*data.pair_names) : Json(nullptr)},
       {"facts", PairsJson(data.facts)},
       {"lead", data.lead},
       {"runs", runs},
       {"recall", CurveJson(data.has_recall ? RecallCurve(data.runs) : std::vector<Share95>{})},
       {"reliability", CurveJson(Reliability(data.runs, 10))},
       {"plots", plots},
       {"tables", tables},
       {"warnings", data.warnings},
       {"options", data.options_json}});
}

std::string PhotoJson(const ReportPhoto& photo, int max_side_px) {
  return SafeDump({{"name", photo.name},
                   {"width", photo.width > 0 ? photo.width : photo.picture.cols},
                   {"height", photo.height > 0 ? photo.height : photo.picture.rows},
                   {"url", JpegDataUrl(photo.picture, max_side_px, 80)}});
}

std::string RunDetailJson(const ReportRun& run) {
  const Vector2d origin = MapOrigin(run);
  Json plots = Json::array();
  for (const ReportPlot& plot : run.plots) plots.push_back(PlotJson(plot));
  Json footprints = Json::array();
  for (const auto& ring : run.footprints) footprints.push_back(Centimetres(ring, origin));
  Json modes = Json::array();
  for (const ReportMode& mode : run.modes) {
    modes.push_back({{"pose", PoseJson(mode.pose)}, {"energy", Significant(mode.energy)}});
  }
  Json trace = Json::array();
  for (const double energy : run.best_energy) trace.push_back(Significant(energy));
  Json place = nullptr;
  if (run.latitude_longitude) {
    place = {Number(run.latitude_longitude->x(), 7), Number(run.latitude_longitude->y(), 7)};
  }
  Json ellipse = nullptr;
  if (run.result && run.position_covariance) {
    ellipse = Centimetres(EllipseOutline(run.result->position.head<2>(), *run.position_covariance),
                          origin);
  }
  return SafeDump(
      {{"origin", {Number(origin.x(), 3), Number(origin.y(), 3)}},
       {"headline", run.headline},
       {"latLon", place},
       {"prior", PoseJson(run.prior)},
       {"result", PoseJson(run.result)},
       {"truth", PoseJson(run.truth)},
       {"modes", modes},
       {"ellipse", ellipse},
       {"box", Centimetres(run.search_box, origin)},
       {"map", run.map ? MapJson(*run.map, origin) : Json(nullptr)},
       {"hillshade", run.hillshade ? HillshadeJson(*run.hillshade, origin) : Json(nullptr)},
       {"footprints", footprints},
       {"priorLayers", LayersJson(run.prior_layers)},
       {"resultLayers", LayersJson(run.result_layers)},
       {"trace", trace},
       {"plots", plots},
       {"facts", PairsJson(run.facts)}});
}

}  // namespace ridgeline
