// SPDX-License-Identifier: Apache-2.0
#include "cli/idle_options.h"

#include <algorithm>
#include <map>
#include <span>

#include "base/error.h"
#include "base/option_groups.h"
#include "lines/detector_table.h"
#include "optim/sampler_table.h"
#include "score/area_classes.h"
#include "score/line_energy.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

// Options below a prefix work if another option has one of some values.
struct Rule {
  std::string prefix;
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

// The options of a plug-in's groups work if one that declares the group is chosen.
template <typename Plugin>
void AddGroups(std::span<const Plugin* const> table, const Rule& chosen, std::vector<Rule>& rules) {
  std::map<std::string, std::vector<std::string>> users;
  for (const Plugin* plugin : table) {
    OptionGroups groups;
    plugin->declare(groups);
    for (const std::string& group : groups.Names()) users[group].emplace_back(plugin->name);
  }
  for (const auto& [group, names] : users) {
    rules.push_back({chosen.prefix + group + ".", chosen.other, chosen.value, names});
  }
}

std::vector<Rule> AllRules() {
  const Rule sampler = {"search.sampler.", "search.sampler.name", Sampler, {}};
  const Rule score = {"score.", "score.name", ScoreName, {}};
  std::vector<Rule> rules = {
      {"score.weights", "score.name", ScoreName, {"evidence"}},
      {"score.line_energy.max_distance_width",
       "score.line_energy.max_distance_px",
       DistanceBy,
       {"0"}},
      {"score.areas.file", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.building", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.roof", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.wall", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.sky", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.ground", "score.areas.source", AreaSource, {"file"}},
      {"score.areas.unknown", "score.areas.source", AreaSource, {"file"}},
      {"search.map.spacing_m", "search.method", Method, {"map"}},
      {"search.map.heading_step_deg", "search.method", Method, {"map"}},
      {"search.map.max_positions", "search.method", Method, {"map"}},
      {"search.map.tilts", "search.method", Method, {"map"}},
      {"search.evaluations", "search.method", Method, {"sampler"}},
      {"search.sampler.", "search.method", Method, {"sampler"}},
      {"search.refinement", "search.refine", Refine, {"true"}},
      {"search.fit.", "search.refine", Refine, {"true"}},
      {"search.fit.", "search.refinement", Refinement, {"fit"}},
  };
  Rule canny = {"lines.canny_", "lines.detector", Detector, {}};
  for (const DetectorPlugin* detector : DetectorTable()) {
    if (detector->reads_canny) canny.values.emplace_back(detector->name);
  }
  rules.push_back(canny);
  AddGroups(ScoreTable(), score, rules);
  AddGroups(SamplerTable(), sampler, rules);
  for (const std::string& group : EvidenceOptions().cues.Names()) {
    if (group == "lines") continue;  // the goodness of any answer and its fit read them, too
    rules.push_back({"score.evidence." + group + ".", score.other, score.value, {"evidence"}});
  }
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
  const std::vector<Rule> rules = AllRules();
  for (const std::string& assignment : assignments) {
    const std::string key = assignment.substr(0, assignment.find('='));
    for (const Rule& rule : rules) {
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
