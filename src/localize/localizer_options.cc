// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer_options.h"

#include <string>

namespace ridgeline {

void MapOptions::Visit(OptionVisitor& v) {
  v.Field("spacing_m", spacing_m, Closed(0.01, 1000.0));
  v.Field("heading_step_deg", heading_step_deg, Closed(0.05, 90.0));
  v.Field("max_positions", max_positions, Closed(1, 1'000'000));
  v.Field("tilts", tilts, Closed(1, 100));
  v.Field("modes", modes, Closed(1, 10'000));
  v.Field("mode_separation_m", mode_separation_m, Positive());
  v.Field("mode_separation_deg", mode_separation_deg, Positive());
  constexpr double kMostPoses = 2e8;  // all are held in memory
  const double poses = 360.0 / heading_step_deg * max_positions * tilts;
  v.Rule("max_positions",
         poses <= kMostPoses,
         std::to_string(poses) + " poses with their headings and tilts",
         "limit: at most 2e8 poses");
}

void SearchOptions::Visit(OptionVisitor& v) {
  space.Visit(v);
  v.Field("method", method, OneOf{{"map", "sampler"}});
  v.Group("map", [this](OptionVisitor& g) { map.Visit(g); });
  v.Field("evaluations", evaluations, Positive());
  v.Group("sampler", [this](OptionVisitor& g) { sampler.Visit(g); });
  v.Field("refine", refine);
  v.Field("widenings", widenings, Closed(0, 4));
  v.Field("refinement", refinement, OneOf{{"compass", "fit"}});
  v.Group("fit", [this](OptionVisitor& g) { fit.Visit(g); });
}

void LocalizerOptions::Visit(OptionVisitor& v) {
  v.Group("lines", [this](OptionVisitor& g) { lines.Visit(g); });
  v.Group("projection", [this](OptionVisitor& g) { projection.Visit(g); });
  v.Group("score", [this](OptionVisitor& g) { score.Visit(g); });
  v.Group("search", [this](OptionVisitor& g) { search.Visit(g); });
  v.Group("confidence", [this](OptionVisitor& g) { confidence.Visit(g); });
}

void LocalizerOptions::Validate() const { CheckOptions(*this); }

}  // namespace ridgeline
