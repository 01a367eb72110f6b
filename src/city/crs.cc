// SPDX-License-Identifier: Apache-2.0
#include "city/crs.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string_view>

#include "base/angle.h"
#include "base/error.h"
#include "base/gdal_handles.h"
#include "city/srs_import.h"
#include "city/units.h"

namespace ridgeline {
namespace {

constexpr int kWgs84 = 4326;

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

Transformation ToWgs84(int epsg) {
  const std::unique_ptr<OGRSpatialReference> source = ImportEpsg(epsg);
  const std::unique_ptr<OGRSpatialReference> wgs84 = ImportEpsg(kWgs84);
  if (source == nullptr || wgs84 == nullptr) return nullptr;
  return Transformation(OGRCreateCoordinateTransformation(source.get(), wgs84.get()));
}

std::optional<Eigen::Vector2d> Transformed(OGRCoordinateTransformation* transformation,
                                           const Eigen::Vector2d& xy) {
  if (transformation == nullptr) return std::nullopt;
  double x = xy.x();
  double y = xy.y();
  const QuietGdal quiet;
  const bool ok = transformation->Transform(1, &x, &y) == TRUE;
  if (!ok || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  return Eigen::Vector2d(x, y);
}

// How far a place is outside of a system's area of use [deg]; 0: within, or no area is known.
double DegreesOutside(const OGRSpatialReference& srs, const Eigen::Vector2d& lon_lat) {
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
  if (!srs.GetAreaOfUse(&west, &south, &east, &north, nullptr)) return 0.0;
  if (east < west) east += 360.0;  // across the date line
  double beside = 360.0;
  for (const double turn : {-360.0, 0.0, 360.0}) {
    const double longitude = lon_lat.x() + turn;
    beside = std::min(beside, std::max({west - longitude, longitude - east, 0.0}));
  }
  return std::max({beside, south - lon_lat.y(), lon_lat.y() - north, 0.0});
}

bool InAreaOfUse(const OGRSpatialReference& srs, const std::optional<Eigen::Vector2d>& lon_lat) {
  constexpr double kMarginDeg = 1.0;
  return lon_lat && DegreesOutside(srs, *lon_lat) <= kMarginDeg;
}

// UTM zone in the datum's own realization where it has one.
int UtmZoneEpsg(const OGRSpatialReference& srs, double longitude, double latitude) {
  const int zone = std::clamp(static_cast<int>(std::floor((longitude + 180.0) / 6.0)) + 1, 1, 60);
  const char* const datum_name = srs.GetAttrValue("DATUM");
  const std::string datum = datum_name != nullptr ? datum_name : "";
  if (datum.find("2011") != std::string::npos && zone >= 51 && zone <= 55) return 6688 + zone - 51;
  if (datum.find("2011") != std::string::npos && zone <= 19) return 6329 + zone;  // NAD83(2011)
  if (datum.starts_with("North_American_Datum_1983") && zone <= 23) return 26900 + zone;
  const bool etrs = datum.find("European_Terrestrial") != std::string::npos;
  if (etrs && zone >= 28 && zone <= 38) return 25800 + zone;
  return (latitude >= 0.0 ? 32600 : 32700) + zone;
}

}  // namespace

bool IsGeographic(const Crs& crs, const std::string& file) {
  return ImportEpsgOrThrow(crs.horizontal_epsg, file)->IsGeographic() == TRUE;
}

bool HasEllipsoidalHeights(const Crs& crs) {
  if (crs.horizontal_epsg == 0 || crs.vertical_epsg != 0) return false;
  const std::unique_ptr<OGRSpatialReference> srs = ImportEpsg(crs.horizontal_epsg);
  return srs != nullptr && srs->IsGeographic() == TRUE && srs->GetAxesCount() == 3;
}

std::optional<double> GeoidUndulation(double latitude_deg, double longitude_deg) {
  OGRSpatialReference ellipsoidal;
  OGRSpatialReference sea_level;
  const QuietGdal quiet;
  std::optional<double> undulation;
  if (ellipsoidal.importFromEPSG(4979) == OGRERR_NONE &&
      sea_level.SetFromUserInput("EPSG:4326+5773") == OGRERR_NONE) {
    ellipsoidal.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    sea_level.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const Transformation transformation(
        OGRCreateCoordinateTransformation(&ellipsoidal, &sea_level));
    double x = longitude_deg;
    double y = latitude_deg;
    double z = 0.0;
    // Without the grid PROJ passes the height through.
    if (transformation != nullptr && transformation->Transform(1, &x, &y, &z) == TRUE && z != 0.0) {
      undulation = -z;
    }
  }
  return undulation;
}

ToProjected::ToProjected(const Crs& source,
                         const Crs& target,
                         const Eigen::Vector3d& sample,
                         const std::string& file)
    : source_(source),
      crs_{source.horizontal_epsg, VerticalEpsgInMetres(source.vertical_epsg)},
      height_unit_m_(HeightUnit(source).metres),
      file_(file) {
  if (source.horizontal_epsg == 0) return;
  const std::unique_ptr<OGRSpatialReference> srs = ImportEpsgOrThrow(source.horizontal_epsg, file);
  const bool geographic = srs->IsGeographic() == TRUE;
  if (!geographic && srs->IsProjected() != TRUE) {
    throw InputError(file, "CRS", CrsName(source), "a projected or geographic system");
  }
  const Transformation to_wgs84 = ToWgs84(source.horizontal_epsg);
  const Eigen::Vector2d as_written(sample.x(), sample.y());
  const Eigen::Vector2d swapped(sample.y(), sample.x());
  const bool written_fits = InAreaOfUse(*srs, Transformed(to_wgs84.get(), as_written));
  const bool swapped_fits = InAreaOfUse(*srs, Transformed(to_wgs84.get(), swapped));
  swap_ = geographic ? swapped_fits || !written_fits : swapped_fits && !written_fits;
  if (target.horizontal_epsg != 0) {
    crs_.horizontal_epsg = target.horizontal_epsg;
    if (ImportEpsgOrThrow(target.horizontal_epsg, file)->IsProjected() != TRUE) {
      throw InputError(file, "project_to", CrsName(target), "a projected system");
    }
  } else if (geographic || !HorizontalUnit(source).IsMetre()) {
    const Eigen::Vector2d xy = swap_ ? swapped : as_written;
    const std::optional<Eigen::Vector2d> lon_lat =
        geographic ? std::optional(xy) : Transformed(to_wgs84.get(), xy);
    if (!lon_lat) FailMoved();
    crs_.horizontal_epsg = UtmZoneEpsg(*srs, lon_lat->x(), lon_lat->y());
  }
  transform_ = crs_.horizontal_epsg != source.horizontal_epsg;
  std::vector<Eigen::Vector3d> moved = {sample};
  Apply(moved);
  CheckMapSystem(
      crs_, moved.front().head<2>(), file, target.horizontal_epsg != 0 ? "project_to" : "CRS");
}

void ToProjected::FailMoved() const {
  throw InputError(
      file_,
      "coordinates",
      "points that cannot be moved from " + CrsName(source_) +
          (crs_.horizontal_epsg != source_.horizontal_epsg ? " to " + CrsName(crs_) : ""),
      "coordinates of " + CrsName(source_) + " (is the CRS right?)");
}

void ToProjected::Apply(std::vector<Eigen::Vector3d>& points) const {
  if (swap_) {
    for (Eigen::Vector3d& point : points) std::swap(point.x(), point.y());
  }
  if (height_unit_m_ != 1.0) {
    for (Eigen::Vector3d& point : points) point.z() *= height_unit_m_;
  }
  if (!transform_ || points.empty()) return;
  const auto source = ImportEpsgOrThrow(source_.horizontal_epsg, file_);
  const auto target = ImportEpsgOrThrow(crs_.horizontal_epsg, file_);
  const Transformation transformation(
      OGRCreateCoordinateTransformation(source.get(), target.get()));
  std::vector<double> x(points.size());
  std::vector<double> y(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x();
    y[i] = points[i].y();
  }
  const QuietGdal quiet;
  const bool ok = transformation != nullptr &&
                  transformation->Transform(points.size(), x.data(), y.data()) == TRUE;
  if (!ok) FailMoved();
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x() = x[i];
    points[i].y() = y[i];
  }
}

bool CrsFit::IsTrueToScale() const {
  constexpr double kTolerance = 0.005;
  return std::abs(scale_north - 1.0) <= kTolerance && std::abs(scale_east - 1.0) <= kTolerance;
}

// The lengths of a short piece of the meridian and of the parallel, on the map and on the
// ellipsoid.
std::optional<CrsFit> FitAt(const Crs& crs, const Eigen::Vector2d& east_north) {
  constexpr double kStepDeg = 1e-3;
  const std::unique_ptr<OGRSpatialReference> srs =
      crs.horizontal_epsg != 0 ? ImportEpsg(crs.horizontal_epsg) : nullptr;
  if (srs == nullptr || srs->IsProjected() != TRUE) return std::nullopt;
  const std::unique_ptr<OGRSpatialReference> degrees(srs->CloneGeogCS());
  degrees->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Transformation to_degrees(OGRCreateCoordinateTransformation(srs.get(), degrees.get()));
  const Transformation to_map(OGRCreateCoordinateTransformation(degrees.get(), srs.get()));
  const std::optional<Eigen::Vector2d> place = Transformed(to_degrees.get(), east_north);
  if (!place) return std::nullopt;
  const Eigen::Vector2d east_step(kStepDeg, 0.0);
  const Eigen::Vector2d north_step(0.0, kStepDeg);
  const auto west = Transformed(to_map.get(), *place - east_step);
  const auto east = Transformed(to_map.get(), *place + east_step);
  const auto south = Transformed(to_map.get(), *place - north_step);
  const auto north = Transformed(to_map.get(), *place + north_step);
  if (!west || !east || !south || !north) return std::nullopt;
  const double flattening = srs->GetInvFlattening() > 0.0 ? 1.0 / srs->GetInvFlattening() : 0.0;
  const double eccentricity2 = flattening * (2.0 - flattening);
  const double s = std::sin(place->y() * kRadPerDeg);
  const double w2 = 1.0 - eccentricity2 * s * s;
  const double prime_vertical = srs->GetSemiMajor() / std::sqrt(w2);
  const double meridian = prime_vertical * (1.0 - eccentricity2) / w2;
  const double step = 2.0 * kStepDeg * kRadPerDeg;
  CrsFit fit;
  fit.outside_deg = DegreesOutside(*srs, *place);
  fit.scale_north = (*north - *south).norm() / (meridian * step);
  fit.scale_east = (*east - *west).norm() / (prime_vertical * std::sqrt(1.0 - s * s) * step);
  return fit;
}

int UtmEpsgAt(const Crs& crs, double latitude_deg, double longitude_deg) {
  const std::unique_ptr<OGRSpatialReference> srs =
      ImportEpsg(crs.horizontal_epsg != 0 ? crs.horizontal_epsg : kWgs84);
  return srs != nullptr ? UtmZoneEpsg(*srs, longitude_deg, latitude_deg) : 0;
}

void CheckMapSystem(const Crs& crs,
                    const Eigen::Vector2d& east_north,
                    const std::string& file,
                    const std::string& field) {
  const std::optional<Eigen::Vector2d> place = LatitudeLongitude(crs, east_north);
  const std::string instead =
      place ? "EPSG:" + std::to_string(UtmEpsgAt(crs, place->x(), place->y())) : "a UTM zone";
  const LengthUnit unit = HorizontalUnit(crs);
  if (!unit.IsMetre()) {
    throw InputError(file,
                     field,
                     CrsName(crs) + ", whose unit is the " + unit.name,
                     "a system in metres such as " + instead);
  }
  const std::optional<CrsFit> fit = FitAt(crs, east_north);
  if (!fit || fit->outside_deg > kReachDeg || fit->IsTrueToScale()) return;
  const auto number = [](double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3f", value);
    return std::string(text.data());
  };
  throw InputError(file,
                   field,
                   CrsName(crs) + ", whose metres are " + number(fit->scale_east) + " (east) and " +
                       number(fit->scale_north) + " (north) to a metre on the ground here",
                   "a system true to scale: --project-to " + instead + " moves the model");
}

std::optional<Eigen::Vector2d> LatitudeLongitude(const Crs& crs,
                                                 const Eigen::Vector2d& east_north) {
  if (crs.horizontal_epsg == 0) return std::nullopt;
  const Transformation to_wgs84 = ToWgs84(crs.horizontal_epsg);
  const std::optional<Eigen::Vector2d> lon_lat = Transformed(to_wgs84.get(), east_north);
  if (!lon_lat) return std::nullopt;
  return Eigen::Vector2d(lon_lat->y(), lon_lat->x());
}

std::optional<Eigen::Vector2d> EastNorth(const Crs& crs,
                                         double latitude_deg,
                                         double longitude_deg) {
  const std::unique_ptr<OGRSpatialReference> wgs84 = ImportEpsg(kWgs84);
  const std::unique_ptr<OGRSpatialReference> target = ImportEpsg(crs.horizontal_epsg);
  if (wgs84 == nullptr || target == nullptr || target->IsProjected() != TRUE) return std::nullopt;
  if (DegreesOutside(*target, {longitude_deg, latitude_deg}) > kReachDeg) return std::nullopt;
  const Transformation transformation(OGRCreateCoordinateTransformation(wgs84.get(), target.get()));
  return Transformed(transformation.get(), {longitude_deg, latitude_deg});
}

// True north at a point, by two points of its meridian.
std::optional<double> MeridianConvergenceDeg(const Crs& crs, const Eigen::Vector2d& east_north) {
  constexpr double kStepDeg = 1e-3;  // 111 m: the meridian is straight, the numbers are exact
  const auto place = LatitudeLongitude(crs, east_north);
  if (!place) return std::nullopt;
  const auto south = EastNorth(crs, place->x() - kStepDeg, place->y());
  const auto north = EastNorth(crs, place->x() + kStepDeg, place->y());
  if (!south || !north) return std::nullopt;
  const Eigen::Vector2d meridian = *north - *south;
  return -std::atan2(meridian.x(), meridian.y()) * kDegPerRad;
}

}  // namespace ridgeline
