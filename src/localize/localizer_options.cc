// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer_options.h"

#include <string>

namespace ridgeline {

void MapOptions::Visit(OptionVisitor& v) {
  v.Field("spacing_m", spacing_m, Positive());
  v.Field("heading_step_deg", heading_step_deg, Positive());
  v.Field("max_positions", max_positions, Positive());
  v.Field("tilts", tilts, Positive());
  v.Field("modes", modes, Positive());
  v.Field("mode_separation_m", mode_separation_m, Positive());
  v.Field("mode_separation_deg", mode_separation_deg, Positive());
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
