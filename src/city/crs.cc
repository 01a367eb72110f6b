// SPDX-License-Identifier: Apache-2.0
#include "city/crs.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "base/error.h"

namespace ridgeline {
namespace {

struct NamedCode {
  std::string_view name;
  int epsg;
};

// Names of the AdV (GeoInfoDok, "urn:adv:crs:<horizontal>*<vertical>*<geoid>").
constexpr std::array kAdvHorizontal = {
    NamedCode{"ETRS89_UTM31", 25831},
    NamedCode{"ETRS89_UTM32", 25832},
    NamedCode{"ETRS89_UTM33", 25833},
    NamedCode{"DE_DHDN_3GK2", 31466},
    NamedCode{"DE_DHDN_3GK3", 31467},
    NamedCode{"DE_DHDN_3GK4", 31468},
    NamedCode{"DE_DHDN_3GK5", 31469},
    NamedCode{"DE_42-83_3GK4", 2398},
    NamedCode{"DE_42-83_3GK5", 2399},
    NamedCode{"DE_PD-83_3GK3", 3396},
    NamedCode{"DE_PD-83_3GK4", 3397},
    NamedCode{"DE_RD-83_3GK4", 3398},
    NamedCode{"DE_RD-83_3GK5", 3399},
    NamedCode{"ETRS89_Lat-Lon", 4258},
};
constexpr std::array kAdvVertical = {
    NamedCode{"DE_DHHN12_NOH", 7699},
    NamedCode{"DE_DHHN85_NOH", 5784},
    NamedCode{"DE_DHHN92_NH", 5783},
    NamedCode{"DE_DHHN2016_NH", 7837},
    NamedCode{"DE_SNN76_NH", 5785},
};

template <std::size_t N>
int FindCode(const std::array<NamedCode, N>& table, std::string_view name) {
  for (const NamedCode& entry : table) {
    if (entry.name == name) return entry.epsg;
  }
  return 0;
}

std::optional<Crs> ParseAdv(std::string_view names) {
  const std::size_t star = names.find('*');
  Crs crs;
  crs.horizontal_epsg = FindCode(kAdvHorizontal, names.substr(0, star));
  if (crs.horizontal_epsg == 0) return std::nullopt;
  if (star == std::string_view::npos) return crs;
  const std::string_view rest = names.substr(star + 1);
  crs.vertical_epsg = FindCode(kAdvVertical, rest.substr(0, rest.find('*')));
  return crs;
}

// Digits at the end of a text such as "crs:EPSG:6.12:31468" or "EPSG:25832" or "25832".
int TrailingCode(std::string_view text) {
  std::size_t first = text.size();
  while (first > 0 && text[first - 1] >= '0' && text[first - 1] <= '9') --first;
  int code = 0;
  const auto [end, error] = std::from_chars(text.data() + first, text.data() + text.size(), code);
  const bool delimited =
      first == 0 || text[first - 1] == ':' || text[first - 1] == '/' || text[first - 1] == '#';
  return error == std::errc() && delimited && code >= 1024 && code < 100000 ? code : 0;
}

std::unique_ptr<OGRSpatialReference> Import(int epsg) {
  auto srs = std::make_unique<OGRSpatialReference>();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const OGRErr error = srs->importFromEPSG(epsg);
  CPLPopErrorHandler();
  if (error != OGRERR_NONE) return nullptr;
  srs->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return srs;
}

std::unique_ptr<OGRSpatialReference> ImportOrThrow(int epsg, const std::string& file) {
  std::unique_ptr<OGRSpatialReference> srs = Import(epsg);
  if (srs == nullptr) {
    throw InputError(file,
                     "CRS",
                     "EPSG:" + std::to_string(epsg) + ", unknown to PROJ",
                     "a known EPSG code (--model-crs overrides the file's)");
  }
  return srs;
}

int CodeOf(const OGRSpatialReference& srs, const char* node) {
  const char* const code = srs.GetAuthorityCode(node);
  return code != nullptr ? std::atoi(code) : 0;
}

// The parts of a compound system.
Crs SplitCompound(int epsg) {
  const std::unique_ptr<OGRSpatialReference> srs = Import(epsg);
  if (srs == nullptr || !srs->IsCompound()) return {epsg, 0};
  const int horizontal = CodeOf(*srs, srs->IsProjected() ? "COMPD_CS|PROJCS" : "COMPD_CS|GEOGCS");
  const int vertical = CodeOf(*srs, "COMPD_CS|VERT_CS");
  if (horizontal == 0) return {epsg, 0};
  return {horizontal, vertical};
}

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

Transformation ToWgs84(int epsg) {
  const std::unique_ptr<OGRSpatialReference> source = Import(epsg);
  const std::unique_ptr<OGRSpatialReference> wgs84 = Import(4326);
  if (source == nullptr || wgs84 == nullptr) return nullptr;
  return Transformation(OGRCreateCoordinateTransformation(source.get(), wgs84.get()));
}

std::optional<Eigen::Vector2d> Transformed(OGRCoordinateTransformation* transformation,
                                           const Eigen::Vector2d& xy) {
  if (transformation == nullptr) return std::nullopt;
  double x = xy.x();
  double y = xy.y();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const bool ok = transformation->Transform(1, &x, &y) == TRUE;
  CPLPopErrorHandler();
  if (!ok || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  return Eigen::Vector2d(x, y);
}

bool InAreaOfUse(const OGRSpatialReference& srs, const std::optional<Eigen::Vector2d>& lon_lat) {
  constexpr double kMarginDeg = 1.0;
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
  if (!lon_lat || !srs.GetAreaOfUse(&west, &south, &east, &north, nullptr)) return false;
  return lon_lat->x() >= west - kMarginDeg && lon_lat->x() <= east + kMarginDeg &&
         lon_lat->y() >= south - kMarginDeg && lon_lat->y() <= north + kMarginDeg;
}

// UTM zone in the datum's own realization where it has one.
int UtmZoneEpsg(const OGRSpatialReference& srs, double longitude, double latitude) {
  const int zone = std::clamp(static_cast<int>(std::floor((longitude + 180.0) / 6.0)) + 1, 1, 60);
  const char* const datum_name = srs.GetAttrValue("DATUM");
  const std::string datum = datum_name != nullptr ? datum_name : "";
  if (datum.find("2011") != std::string::npos && zone >= 51 && zone <= 55) return 6688 + zone - 51;
  const bool etrs = datum.find("European_Terrestrial") != std::string::npos;
  if (etrs && zone >= 28 && zone <= 38) return 25800 + zone;
  return (latitude >= 0.0 ? 32600 : 32700) + zone;
}

}  // namespace

std::optional<Crs> ParseCrs(std::string_view name) {
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  constexpr std::string_view kAdv = "urn:adv:crs:";
  if (name.starts_with(kAdv)) return ParseAdv(name.substr(kAdv.size()));
  if (const std::optional<Crs> adv = ParseAdv(name)) return adv;
  // Two codes: "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783" or "EPSG:25832+7837".
  std::string_view first = name;
  std::string_view second;
  constexpr std::string_view kCompoundUrn = "urn:ogc:def:crs,";
  if (name.starts_with(kCompoundUrn)) {
    const std::string_view parts = name.substr(kCompoundUrn.size());
    first = parts.substr(0, parts.find(','));
    if (first.size() < parts.size()) second = parts.substr(first.size() + 1);
  } else if (const std::size_t plus = name.find('+'); plus != std::string_view::npos) {
    first = name.substr(0, plus);
    second = name.substr(plus + 1);
    if (second.empty()) return std::nullopt;
  }
  // ".../def/crs/EPSG/0/25832", ".../epsg.xml#25832", "urn:...:EPSG::25832", "EPSG:25832", "25832".
  const int code = TrailingCode(first);
  if (code == 0) return std::nullopt;
  Crs crs = SplitCompound(code);
  if (!second.empty()) {
    crs.vertical_epsg = TrailingCode(second);
    if (crs.vertical_epsg == 0) return std::nullopt;
  }
  return crs;
}

std::string CrsName(const Crs& crs) {
  if (crs.horizontal_epsg == 0) return "no CRS";
  std::string name = "EPSG:" + std::to_string(crs.horizontal_epsg);
  if (crs.vertical_epsg != 0) name += "+" + std::to_string(crs.vertical_epsg);
  return name;
}

bool IsGeographic(const Crs& crs, const std::string& file) {
  return ImportOrThrow(crs.horizontal_epsg, file)->IsGeographic() == TRUE;
}

bool HasEllipsoidalHeights(const Crs& crs) {
  if (crs.horizontal_epsg == 0 || crs.vertical_epsg != 0) return false;
  const std::unique_ptr<OGRSpatialReference> srs = Import(crs.horizontal_epsg);
  return srs != nullptr && srs->IsGeographic() == TRUE && srs->GetAxesCount() == 3;
}

std::optional<double> GeoidUndulation(double latitude_deg, double longitude_deg) {
  OGRSpatialReference ellipsoidal;
  OGRSpatialReference sea_level;
  CPLPushErrorHandler(CPLQuietErrorHandler);
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
  CPLPopErrorHandler();
  return undulation;
}

ToProjected::ToProjected(const Crs& source,
                         const Crs& target,
                         const Eigen::Vector3d& sample,
                         const std::string& file)
    : source_(source), crs_(source), file_(file) {
  if (source.horizontal_epsg == 0) return;
  const std::unique_ptr<OGRSpatialReference> srs = ImportOrThrow(source.horizontal_epsg, file);
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
    if (ImportOrThrow(target.horizontal_epsg, file)->IsProjected() != TRUE) {
      throw InputError(file, "project_to", CrsName(target), "a projected system");
    }
  } else if (geographic) {
    const Eigen::Vector2d& lon_lat = swap_ ? swapped : as_written;
    crs_.horizontal_epsg = UtmZoneEpsg(*srs, lon_lat.x(), lon_lat.y());
  }
  transform_ = crs_.horizontal_epsg != source.horizontal_epsg;
}

void ToProjected::Apply(std::vector<Eigen::Vector3d>& points) const {
  if (swap_) {
    for (Eigen::Vector3d& point : points) std::swap(point.x(), point.y());
  }
  if (!transform_ || points.empty()) return;
  const auto source = ImportOrThrow(source_.horizontal_epsg, file_);
  const auto target = ImportOrThrow(crs_.horizontal_epsg, file_);
  const Transformation transformation(
      OGRCreateCoordinateTransformation(source.get(), target.get()));
  std::vector<double> x(points.size());
  std::vector<double> y(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x();
    y[i] = points[i].y();
  }
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const bool ok = transformation != nullptr &&
                  transformation->Transform(points.size(), x.data(), y.data()) == TRUE;
  CPLPopErrorHandler();
  if (!ok) {
    throw InputError(
        file_,
        "coordinates",
        "points that cannot be moved from " + CrsName(source_) + " to " + CrsName(crs_),
        "coordinates of " + CrsName(source_) + " (is the CRS right?)");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x() = x[i];
    points[i].y() = y[i];
  }
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
  const std::unique_ptr<OGRSpatialReference> wgs84 = Import(4326);
  const std::unique_ptr<OGRSpatialReference> target = Import(crs.horizontal_epsg);
  if (wgs84 == nullptr || target == nullptr || target->IsProjected() != TRUE) return std::nullopt;
  const Transformation transformation(
      OGRCreateCoordinateTransformation(wgs84.get(), target.get()));
  return Transformed(transformation.get(), {longitude_deg, latitude_deg});
}

// True north at a point, by two points of its meridian.
std::optional<double> MeridianConvergenceDeg(const Crs& crs, const Eigen::Vector2d& east_north) {
  constexpr double kStepDeg = 1e-3;  // 111 m: the meridian is straight, the numbers are exact
  constexpr double kDegPerRad = 57.29577951308232;
  const auto place = LatitudeLongitude(crs, east_north);
  if (!place) return std::nullopt;
  const auto south = EastNorth(crs, place->x() - kStepDeg, place->y());
  const auto north = EastNorth(crs, place->x() + kStepDeg, place->y());
  if (!south || !north) return std::nullopt;
  const Eigen::Vector2d meridian = *north - *south;
  return -std::atan2(meridian.x(), meridian.y()) * kDegPerRad;
}

}  // namespace ridgeline
