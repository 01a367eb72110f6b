// SPDX-License-Identifier: Apache-2.0
#include "city/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>

#include "city/srs_import.h"

namespace ridgeline {
namespace {

constexpr double kFoot = 0.3048;
constexpr double kUsFoot = 1200.0 / 3937.0;

struct NamedLength {
  std::string_view name;  // lower case, letters and digits only, singular
  double metres;
};
constexpr std::array kLengths = {
    NamedLength{"m", 1.0},
    NamedLength{"metre", 1.0},
    NamedLength{"meter", 1.0},
    NamedLength{"9001", 1.0},
    NamedLength{"ft", kFoot},
    NamedLength{"foot", kFoot},
    NamedLength{"feet", kFoot},
    NamedLength{"internationalfoot", kFoot},
    NamedLength{"internationalfeet", kFoot},
    NamedLength{"footinternational", kFoot},
    NamedLength{"9002", kFoot},
    NamedLength{"ftu", kUsFoot},  // "ftUS" without its s
    NamedLength{"usft", kUsFoot},
    NamedLength{"sft", kUsFoot},
    NamedLength{"surveyfoot", kUsFoot},
    NamedLength{"surveyfeet", kUsFoot},
    NamedLength{"ussurveyfoot", kUsFoot},
    NamedLength{"ussurveyfeet", kUsFoot},
    NamedLength{"usfoot", kUsFoot},
    NamedLength{"usfeet", kUsFoot},
    NamedLength{"footu", kUsFoot},  // "foot_us"
    NamedLength{"9003", kUsFoot},
    NamedLength{"mm", 0.001},
    NamedLength{"millimetre", 0.001},
    NamedLength{"millimeter", 0.001},
    NamedLength{"1025", 0.001},
    NamedLength{"cm", 0.01},
    NamedLength{"centimetre", 0.01},
    NamedLength{"centimeter", 0.01},
    NamedLength{"1033", 0.01},
    NamedLength{"dm", 0.1},
    NamedLength{"decimetre", 0.1},
    NamedLength{"decimeter", 0.1},
    NamedLength{"km", 1000.0},
    NamedLength{"kilometre", 1000.0},
    NamedLength{"kilometer", 1000.0},
    NamedLength{"9036", 1000.0},
    NamedLength{"yd", 0.9144},
    NamedLength{"yard", 0.9144},
    NamedLength{"9096", 0.9144},
    NamedLength{"in", 0.0254},
    NamedLength{"inch", 0.0254},
    NamedLength{"inche", 0.0254},
};

LengthUnit UnitOf(int epsg) {
  LengthUnit unit;
  const std::unique_ptr<OGRSpatialReference> srs = ImportEpsg(epsg);
  if (srs == nullptr || srs->IsGeographic() == TRUE) return unit;
  const char* name = nullptr;
  const double metres = srs->GetLinearUnits(&name);
  // PROJ's metre may come with a last digit of its own.
  if (metres > 0.0 && std::abs(metres - 1.0) > 1e-12) {
    unit.metres = metres;
    unit.name = name != nullptr ? name : "unit";
  }
  return unit;
}

}  // namespace

std::optional<double> MetresPerUnit(std::string_view unit) {
  const std::size_t code = unit.find_last_of(":/#");
  if (code != std::string_view::npos) unit.remove_prefix(code + 1);
  std::string key;
  for (const char c : unit) {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  if (key.size() > 1 && key.back() == 's') key.pop_back();
  const auto it = std::find_if(
      kLengths.begin(), kLengths.end(), [&](const NamedLength& l) { return l.name == key; });
  return it != kLengths.end() ? std::optional(it->metres) : std::nullopt;
}

LengthUnit HorizontalUnit(const Crs& crs) {
  return crs.horizontal_epsg != 0 ? UnitOf(crs.horizontal_epsg) : LengthUnit{};
}

LengthUnit HeightUnit(const Crs& crs) {
  return crs.vertical_epsg != 0 ? UnitOf(crs.vertical_epsg) : HorizontalUnit(crs);
}

int VerticalEpsgInMetres(int vertical_epsg) {
  struct Pair {
    int feet;
    int metres;
  };
  static constexpr std::array kPairs = {
      Pair{6360, 5703},  // NAVD88, US survey feet
      Pair{8228, 5703},  // NAVD88, feet
      Pair{5702, 7968},  // NGVD29, US survey feet
  };
  for (const Pair& pair : kPairs) {
    if (pair.feet == vertical_epsg) return pair.metres;
  }
  return vertical_epsg == 0 || UnitOf(vertical_epsg).IsMetre() ? vertical_epsg : 0;
}

}  // namespace ridgeline
