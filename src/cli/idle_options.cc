// SPDX-License-Identifier: Apache-2.0
#include "cli/idle_options.h"

#include <algorithm>

#include "base/error.h"
#include "score/area_classes.h"
#include "score/line_energy.h"

namespace ridgeline {
namespace {

// Options below a prefix work if another option has one of some values.
struct Rule {
  const char* prefix;
  const char* other;
  std::string (*value)(const LocalizerOptions&);
  std::vector<std::string> values;
};

std::string Detector(const LocalizerOptions& o) { return o.lines.detector; }
std::string ScoreName(const LocalizerOptions& o) { return o.score.name; }
std::string AreaSource(const LocalizerOptions& o) {
  return o.score.groups.Get<AreaOptions>().source;
}
// The distance in pixels goes before the one in widths.
std::string DistanceBy(const LocalizerOptions& o) {
  return o.score.groups.Get<LineEnergyOptions>().max_distance_px > 0.0 ? "above 0" : "0";
}
std::string Method(const LocalizerOptions& o) { return o.search.method; }
std::string Sampler(const LocalizerOptions& o) { return o.search.sampler.name; }
std::string Refine(const LocalizerOptions& o) { return o.search.refine ? "true" : "false"; }
std::string Refinement(const LocalizerOptions& o) { return o.search.refinement; }

const std::vector<Rule>& Rules() {
  static const std::vector<Rule> rules = {
      {"lines.canny_", "lines.detector", Detector, {"hough", "fld"}},
      {"score.weights", "score.name", ScoreName, {"evidence"}},
      {"score.evidence.sky.", "score.name", ScoreName, {"evidence"}},
      {"score.evidence.facades.", "score.name", ScoreName, {"evidence"}},
      {"score.evidence.colours.", "score.name", ScoreName, {"evidence"}},
      {"score.line_energy.", "score.name", ScoreName, {"line_energy", "line_energy_zbuffer", "line_energy_rays"}},
      {"score.line_energy.max_distance_width", "score.line_energy.max_distance_px", DistanceBy, {"0"}},
      {"score.zbuffer_hough.", "score.name", ScoreName, {"line_energy_zbuffer"}},
      {"score.areas.", "score.name", ScoreName, {"areas"}},
      {"score.areas.file", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.building", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.roof", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.wall", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.sky", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.ground", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.unknown", "score.areas.source", AreaSource, {"file"}},
      {"score.rays.", "score.name", ScoreName, {"line_energy_rays"}},
      {"score.oriented_chamfer.", "score.name", ScoreName, {"oriented_chamfer"}},
      {"score.gradient.", "score.name", ScoreName, {"gradient"}},
      {"score.unexplained.", "score.name", ScoreName, {"unexplained"}},
      {"score.skyline.", "score.name", ScoreName, {"skyline_l1"}},
      {"score.skyline_l1.", "score.name", ScoreName, {"skyline_l1"}},
      {"search.map.spacing_m", "search.method", Method, {"map"}},
      {"search.map.heading_step_deg", "search.method", Method, {"map"}},
      {"search.map.max_positions", "search.method", Method, {"map"}},
      {"search.map.tilts", "search.method", Method, {"map"}},
      {"search.evaluations", "search.method", Method, {"sampler"}},
      {"search.sampler.", "search.method", Method, {"sampler"}},
      {"search.sampler.tpe.", "search.sampler.name", Sampler, {"tpe", "tpe_multivariate"}},
      {"search.sampler.gp.", "search.sampler.name", Sampler, {"gp", "gp_de"}},
      {"search.sampler.cmaes.", "search.sampler.name", Sampler, {"cmaes"}},
      {"search.sampler.de.", "search.sampler.name", Sampler, {"de", "gp_de"}},
      {"search.sampler.gp_de.", "search.sampler.name", Sampler, {"gp_de"}},
      {"search.sampler.nelder_mead.", "search.sampler.name", Sampler, {"nelder_mead"}},
      {"search.sampler.grid.", "search.sampler.name", Sampler, {"grid"}},
      {"search.sampler.multi_start.", "search.sampler.name", Sampler, {"multi_start"}},
      {"search.refinement", "search.refine", Refine, {"true"}},
      {"search.fit.", "search.refine", Refine, {"true"}},
      {"search.fit.", "search.refinement", Refinement, {"fit"}},
  };
  return rules;
}

std::string Either(const std::string& option, const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) {
    text += (text.empty() ? "" : " or ") + option + "=" + value;
  }
  return text;
}

}  // namespace

void RefuseIdleOptions(const std::vector<std::string>& assignments,
                       const LocalizerOptions& options) {
  for (const std::string& assignment : assignments) {
    const std::string key = assignment.substr(0, assignment.find('='));
    for (const Rule& rule : Rules()) {
      if (!key.starts_with(rule.prefix)) continue;
      const std::string value = rule.value(options);
      if (std::find(rule.values.begin(), rule.values.end(), value) != rule.values.end()) continue;
      throw InputError(
          "--set",
          key,
          "an option without effect, since " + std::string(rule.other) + " is " + value,
          Either(rule.other, rule.values));
    }
  }
}

}  // namespace ridgeline
