// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "city/city_model.h"

class OGRSpatialReference;

namespace ridgeline {

// Understands the spellings of reference systems that city models use: EPSG:25832, EPSG::25832,
// urn:ogc:def:crs:EPSG::25832, urn:ogc:def:crs,crs:EPSG:6.12:31468,crs:EPSG:6.12:5783,
// http://www.opengis.net/def/crs/EPSG/0/6697, ...gml/srs/epsg.xml#25832, plain 25832,
// EPSG:25832+7837, AdV's names (urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH, DE_DHDN_3GK4, ...), OGC's
// compound names (http://www.opengis.net/def/crs-compound?1=...&2=...), WKT and PROJJSON. Compound
// codes come apart (7415 is 28992 + 5709). nullopt: not understood.
std::optional<Crs> ParseCrs(std::string_view srs_name);

// The codes of a system that GDAL has read, e.g. a raster's; compound ones come apart, those that
// were given a third dimension are taken by their two. nullopt: no EPSG code describes it.
std::optional<Crs> CrsOf(const OGRSpatialReference& srs);

// "EPSG:25832", "EPSG:25832+7837", or "no CRS".
std::string CrsName(const Crs& crs);

// Whether the horizontal system has degrees (latitude and longitude). Throws InputError if PROJ
// does not know the code; `file` is named in the message.
bool IsGeographic(const Crs& crs, const std::string& file);

// Whether the system's own heights are above its ellipsoid (three-dimensional geographic systems
// such as EPSG:4979), not above sea level.
bool HasEllipsoidalHeights(const Crs& crs);

// Height of the ellipsoid's surface below sea level (geoid undulation, EGM96) at a place [m];
// nullopt if PROJ has no grid of it.
std::optional<double> GeoidUndulation(double latitude_deg, double longitude_deg);

// How a projected system serves at a place.
struct CrsFit {
  double outside_deg = 0.0;  // how far outside of its area of use; 0: within
  // Units of the map per metre on the ground, along the meridian and the parallel. 1.0004: a true
  // map; 1.32: web Mercator at 40 degrees.
  double scale_north = 1.0;
  double scale_east = 1.0;

  // Whether lengths and angles taken from the map are those of the ground (within 0.5 %).
  bool IsTrueToScale() const;
};
std::optional<CrsFit> FitAt(const Crs& crs, const Eigen::Vector2d& east_north);

// The UTM zone of a place in the datum of `crs` where there is one, else of WGS 84.
int UtmEpsgAt(const Crs& crs, double latitude_deg, double longitude_deg);

// Throws InputError(file, field, ...) for a projected system in other units than metres or whose
// scale at the place is off by more than 0.5 %, with the system to be taken in its stead.
void CheckMapSystem(const Crs& crs,
                    const Eigen::Vector2d& east_north,
                    const std::string& file,
                    const std::string& field);

// Takes coordinates as a file has them to east, north, height in metres. Files write east first
// whatever the EPSG register says, but for geographic systems (latitude first); where the system's
// area of use shows the opposite, the two are swapped. Systems in feet are moved to a UTM zone, and
// heights in feet are made metres.
class ToProjected {
 public:
  // @param sample  A coordinate of the file, which decides the order of the axes and, for a
  //     system of degrees or feet without `target`, the UTM zone.
  // @param target  System wanted; horizontal_epsg 0: `source`, or a UTM zone if it is geographic or
  //     in feet.
  // Throws InputError for codes that PROJ does not know, for a target that is not projected or not
  // in metres, and for a result whose scale is off (CheckMapSystem).
  ToProjected(const Crs& source,
              const Crs& target,
              const Eigen::Vector3d& sample,
              const std::string& file);

  const Crs& crs() const { return crs_; }
  bool swaps() const { return swap_; }
  bool transforms() const { return transform_; }
  // Metres per unit of the file's heights.
  double height_unit_m() const { return height_unit_m_; }
  // In place.
  void Apply(std::vector<Eigen::Vector3d>& points) const;

 private:
  [[noreturn]] void FailMoved() const;

  Crs source_;
  Crs crs_;  // of the result
  bool swap_ = false;
  bool transform_ = false;
  double height_unit_m_ = 1.0;
  std::string file_;
};

// Geographic position (WGS 84) of a point of a projected system; nullopt where PROJ has no answer.
// Shared by callers that show a place on a map.
std::optional<Eigen::Vector2d> LatitudeLongitude(const Crs& crs, const Eigen::Vector2d& east_north);

// East, north of a geographic position (WGS 84) in a projected system; nullopt where PROJ has no
// answer and farther than kReachDeg outside of the system's area of use.
inline constexpr double kReachDeg = 6.0;  // a UTM zone and the next one
std::optional<Eigen::Vector2d> EastNorth(const Crs& crs, double latitude_deg, double longitude_deg);

// Meridian convergence at a point: heading from true north minus heading from grid north [deg].
// nullopt where PROJ has no answer.
std::optional<double> MeridianConvergenceDeg(const Crs& crs, const Eigen::Vector2d& east_north);

}  // namespace ridgeline
