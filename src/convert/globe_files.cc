// SPDX-License-Identifier: Apache-2.0
#include "convert/globe_files.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/decimals.h"
#include "base/error.h"
#include "city/crs.h"

namespace ridgeline {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kDegreeDecimals = 9;

struct View {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double true_heading_deg = 0.0;
  ViewAngles grid;
};

Crs CrsOf(const Dataset& dataset) {
  const std::optional<Crs> crs = ParseCrs(dataset.crs);
  if (crs && crs->horizontal_epsg != 0) return *crs;
  throw InputError("--crs",
                   "",
                   dataset.crs.empty() ? "nothing" : "\"" + dataset.crs + "\"",
                   "the system of the poses, such as EPSG:25832, to place them on the globe");
}

View ViewOf(const Query& query, const Crs& crs, const std::string& file) {
  const Eigen::Vector2d place = query.truth->center_in_world.head<2>();
  const auto lat_lon = LatitudeLongitude(crs, place);
  const auto convergence = lat_lon ? MeridianConvergenceDeg(crs, place) : std::nullopt;
  if (!convergence) {
    throw InputError(file,
                     "query " + query.id,
                     std::to_string(place.x()) + ", " + std::to_string(place.y()),
                     "a place in the reach of " + CrsName(crs));
  }
  View view;
  view.latitude_deg = RoundedTo(lat_lon->x(), kDegreeDecimals);
  view.longitude_deg = RoundedTo(lat_lon->y(), kDegreeDecimals);
  view.grid = ViewAnglesOf(query.truth->cam_from_world);
  view.true_heading_deg = WrapHeadingDeg(view.grid.heading_deg + *convergence);
  return view;
}

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string Tag(const char* name, double value, int decimals) {
  return std::string("<") + name + ">" + ShortestText(RoundedTo(value, decimals)) + "</" + name +
         ">";
}

}  // namespace

std::string PosesGeoJson(const Dataset& dataset) {
  const Crs crs = CrsOf(dataset);
  OrderedJson json = {{"type", "FeatureCollection"}, {"features", OrderedJson::array()}};
  for (const Query& query : dataset.queries) {
    if (!query.truth) continue;
    const View view = ViewOf(query, crs, dataset.file.string());
    const Eigen::Vector3d& p = query.truth->center_in_world;
    OrderedJson properties = {{"id", query.id}};
    if (!query.set.empty()) properties["set"] = query.set;
    properties["image"] = query.image.filename().string();
    properties["heading_deg"] = RoundedTo(view.grid.heading_deg, 6);
    properties["true_heading_deg"] = RoundedTo(view.true_heading_deg, 6);
    properties["pitch_deg"] = RoundedTo(view.grid.pitch_deg, 6);
    properties["roll_deg"] = RoundedTo(view.grid.roll_deg, 6);
    properties["crs"] = dataset.crs;
    properties["position"] = {RoundedTo(p.x(), 4), RoundedTo(p.y(), 4), RoundedTo(p.z(), 4)};
    json["features"].push_back(
        {{"type", "Feature"},
         {"geometry",
          {{"type", "Point"},
           {"coordinates", {view.longitude_deg, view.latitude_deg, RoundedTo(p.z(), 4)}}}},
         {"properties", std::move(properties)}});
  }
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string PosesKml(const Dataset& dataset) {
  const Crs crs = CrsOf(dataset);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document><name>" +
      Escaped(dataset.name) + "</name>\n";
  for (const Query& query : dataset.queries) {
    if (!query.truth) continue;
    const View view = ViewOf(query, crs, dataset.file.string());
    const double height = RoundedTo(query.truth->center_in_world.z(), 4);
    // KML's tilt is 0 looking down and 90 at the horizon; its roll is counter-clockwise seen from
    // behind, ours clockwise.
    text += "<Placemark><name>" + Escaped(query.id) + "</name><Camera>" +
            Tag("longitude", view.longitude_deg, kDegreeDecimals) +
            Tag("latitude", view.latitude_deg, kDegreeDecimals) + Tag("altitude", height, 4) +
            Tag("heading", view.true_heading_deg, 6) + Tag("tilt", 90.0 + view.grid.pitch_deg, 6) +
            Tag("roll", -view.grid.roll_deg, 6) +
            "<altitudeMode>absolute</altitudeMode></Camera><Point><altitudeMode>absolute"
            "</altitudeMode><coordinates>" +
            ShortestText(view.longitude_deg) + "," + ShortestText(view.latitude_deg) + "," +
            ShortestText(height) + "</coordinates></Point></Placemark>\n";
  }
  return text + "</Document></kml>\n";
}

}  // namespace ridgeline
