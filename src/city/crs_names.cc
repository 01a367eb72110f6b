// SPDX-License-Identifier: Apache-2.0
#include <ogr_spatialref.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <memory>

#include "base/gdal_handles.h"
#include "city/crs.h"
#include "city/srs_import.h"

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

int CodeOf(const OGRSpatialReference& srs, const char* node) {
  const char* const code = srs.GetAuthorityCode(node);
  return code != nullptr ? std::atoi(code) : 0;
}

// The parts of a compound system.
Crs SplitCompound(int epsg) {
  const std::unique_ptr<OGRSpatialReference> srs = ImportEpsg(epsg);
  if (srs == nullptr || !srs->IsCompound()) return {epsg, 0};
  const int horizontal = CodeOf(*srs, srs->IsProjected() ? "COMPD_CS|PROJCS" : "COMPD_CS|GEOGCS");
  const int vertical = CodeOf(*srs, "COMPD_CS|VERT_CS");
  if (horizontal == 0) return {epsg, 0};
  return {horizontal, vertical};
}

// EPSG code of a system of two dimensions; 0: it has none.
int CodeOfHorizontal(const OGRSpatialReference& system) {
  OGRSpatialReference flat(system);
  flat.StripVertical();
  flat.DemoteTo2D(nullptr);
  const char* const authority = flat.GetAuthorityName(nullptr);
  if (authority != nullptr && std::string_view(authority) == "EPSG") return CodeOf(flat, nullptr);
  if (authority != nullptr) return 0;
  constexpr int kSureness = 90;  // [%] of PROJ's comparison
  const std::unique_ptr<OGRSpatialReference> match(flat.FindBestMatch(kSureness, "EPSG", nullptr));
  return match != nullptr ? CodeOf(*match, nullptr) : 0;
}

// What GDAL understands without opening files: WKT, PROJJSON, OGC's names of compound systems.
std::optional<Crs> ParseByGdal(std::string_view text) {
  const QuietGdal quiet;
  OGRSpatialReference srs;
  const char* const options[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  if (srs.SetFromUserInput(std::string(text).c_str(), options) != OGRERR_NONE) return std::nullopt;
  return CrsOf(srs);
}

}  // namespace

std::optional<Crs> CrsOf(const OGRSpatialReference& srs) {
  Crs crs;
  crs.horizontal_epsg = CodeOfHorizontal(srs);
  if (crs.horizontal_epsg == 0) return std::nullopt;
  if (srs.IsCompound()) crs.vertical_epsg = CodeOf(srs, "COMPD_CS|VERT_CS");
  return crs;
}

std::optional<Crs> ParseCrs(std::string_view name) {
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  constexpr std::string_view kAdv = "urn:adv:crs:";
  if (name.starts_with(kAdv)) return ParseAdv(name.substr(kAdv.size()));
  if (const std::optional<Crs> adv = ParseAdv(name)) return adv;
  if (name.find_first_of("[{?") != std::string_view::npos) return ParseByGdal(name);
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

}  // namespace ridgeline
