// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer_options.h"

#include <sstream>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

void RequireRange(const char* field, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;  // false for NaN
  std::ostringstream found;
  found << value;
  std::ostringstream range;
  range << "[" << lowest << ", " << highest << "]";
  throw InputError("", field, found.str(), range.str());
}

void RequirePositive(const char* field, double value) {
  if (!(value > 0.0)) throw InputError("", field, std::to_string(value), "> 0");
}

}  // namespace

void MapOptions::Visit(OptionVisitor& v) {
  v.Field("spacing_m", spacing_m);
  v.Field("heading_step_deg", heading_step_deg);
  v.Field("max_positions", max_positions);
  v.Field("tilts", tilts);
  v.Field("modes", modes);
  v.Field("mode_separation_m", mode_separation_m);
  v.Field("mode_separation_deg", mode_separation_deg);
}

void MapOptions::Validate() const {
  RequireRange("search.map.spacing_m", spacing_m, 0.01, 1000.0);
  RequireRange("search.map.heading_step_deg", heading_step_deg, 0.05, 90.0);
  RequireRange("search.map.max_positions", max_positions, 1, 1'000'000);
  RequireRange("search.map.tilts", tilts, 1, 100);
  RequireRange("search.map.modes", modes, 1, 10'000);
  // All poses of the map are held in memory.
  constexpr double kMostPoses = 2e8;
  const double poses = 360.0 / heading_step_deg * max_positions * tilts;
  RequireRange("search.map: limit: poses (max_positions, headings, tilts)", poses, 1, kMostPoses);
  RequirePositive("search.map.mode_separation_m", mode_separation_m);
  RequirePositive("search.map.mode_separation_deg", mode_separation_deg);
}

void SearchOptions::Visit(OptionVisitor& v) {
  space.Visit(v);
  v.Field("method", method);
  v.Group("map", [this](OptionVisitor& g) { map.Visit(g); });
  v.Field("evaluations", evaluations);
  v.Group("sampler", [this](OptionVisitor& g) { sampler.Visit(g); });
  v.Field("refine", refine);
  v.Field("widenings", widenings);
  v.Field("refinement", refinement);
  v.Group("fit", [this](OptionVisitor& g) { fit.Visit(g); });
}

void SearchOptions::Validate() const {
  if (method != "map" && method != "sampler") {
    throw InputError("", "search.method", "\"" + method + "\"", "map or sampler");
  }
  RequirePositive("search.evaluations", evaluations);
  if (refinement != "compass" && refinement != "fit") {
    throw InputError("", "search.refinement", "\"" + refinement + "\"", "compass or fit");
  }
  if (widenings < 0 || widenings > 4) {
    throw InputError("", "search.widenings", std::to_string(widenings), "[0, 4]");
  }
  fit.Validate();
  space.Validate();
  map.Validate();
  sampler.Validate();
}

void LocalizerOptions::Visit(OptionVisitor& v) {
  v.Group("lines", [this](OptionVisitor& g) { lines.Visit(g); });
  v.Group("projection", [this](OptionVisitor& g) { projection.Visit(g); });
  v.Group("score", [this](OptionVisitor& g) { score.Visit(g); });
  v.Group("search", [this](OptionVisitor& g) { search.Visit(g); });
  v.Group("confidence", [this](OptionVisitor& g) { confidence.Visit(g); });
}

void LocalizerOptions::Validate() const {
  lines.Validate();
  projection.Validate();
  score.Validate();
  search.Validate();
  confidence.Validate();
}

}  // namespace ridgeline
