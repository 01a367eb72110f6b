// SPDX-License-Identifier: Apache-2.0
#include "cli/unread_options.h"

#include <algorithm>

#include "base/error.h"
#include "cli/idle_options.h"
#include "score/cue_table.h"

namespace ridgeline {
namespace {

struct Unread {
  const char* prefix;
  const char* reason;
};

// Of every study: it maps, refines nothing, and judges by the truth.
constexpr Unread kUnread[] = {
    {"search.method", "a study maps the box, and searches it by TPE"},
    {"search.evaluations", "--classes says how many"},
    {"search.map.modes", "a study refines no modes"},
    {"search.map.mode_separation", "a study refines no modes"},
    {"search.refine", "a study refines nothing"},  // and search.refinement
    {"search.fit.", "a study refines nothing"},
    {"search.widenings", "a study keeps to its box"},
    {"search.sampler.name", "a study samples by TPE"},
    {"confidence.", "a study judges by the truth"},
    {"search.east_m", "the protocol says how far the box goes (--protocol, --perturb)"},
    {"search.north_m", "the protocol says how far the box goes (--protocol, --perturb)"},
    {"search.height_m", "the protocol says how far the box goes (--protocol, --perturb)"}};

// The groups of options that a cue declares, below "score.evidence.".
std::vector<std::string> GroupsOf(const std::string& cue) {
  class Names final : public OptionVisitor {
   public:
    std::vector<std::string> names;
    void Field(std::string_view, bool&) override {}
    void Field(std::string_view, int&, const NumberRange&) override {}
    void Field(std::string_view, double&, const NumberRange&) override {}
    void Field(std::string_view, std::string&, const OneOf&) override {}
    void Field(std::string_view, std::vector<double>&, const NumberRange&) override {}
    void Field(std::string_view, std::vector<std::string>&) override {}
    void Group(std::string_view name, const std::function<void(OptionVisitor&)>&) override {
      names.emplace_back(name);
    }
  };
  Names visitor;
  for (const CuePlugin* plugin : CueTable()) {
    const bool is_of_plugin = std::any_of(plugin->names.begin(),
                                          plugin->names.end(),
                                          [&](const CueName& name) { return name.name == cue; });
    if (!is_of_plugin) continue;
    OptionGroups groups;
    plugin->declare(groups);
    groups.Visit(visitor);
  }
  return visitor.names;
}

// A cue alone reads its own weight, its own options, and no other cue's.
bool CueReads(const ScoreChoice& choice, const std::string& key) {
  const std::vector<std::string> cues = CueNames();
  const bool is_cue = std::find(cues.begin(), cues.end(), choice.name) != cues.end();
  if (!is_cue) return true;
  if (key.starts_with("score.weights.")) return key == "score.weights." + choice.name;
  const std::vector<std::string> own = GroupsOf(choice.name);
  for (const std::string& cue : cues) {
    for (const std::string& group : GroupsOf(cue)) {
      const bool is_own = std::find(own.begin(), own.end(), group) != own.end();
      if (key.starts_with("score.evidence." + group + ".") && !is_own) return false;
    }
  }
  return true;
}

// Why the options of one score leave an assignment without effect; empty: they do not.
std::string IdleReason(const std::string& assignment,
                       const std::string& key,
                       LocalizerOptions options,
                       const ScoreChoice& choice) {
  options.score = choice.options;
  options.search.method = "sampler";
  options.search.sampler.name = "tpe";
  const bool is_map = key.starts_with("search.map.");
  try {
    if (!is_map) RefuseIdleOptions({assignment}, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return CueReads(choice, key) ? "" : "--score " + choice.name + " reads other cues' options not";
}

// What the box of a protocol leaves to the configuration.
std::string UnreadByProtocol(const std::string& key, const Protocol& protocol) {
  const bool of_picture = protocol.place == PriorPlace::kPicture;
  const std::string by = "protocol " + protocol.name + " says it";
  if (key == "search.heading_deg" && !of_picture) return by;
  if ((key == "search.pitch_deg" || key == "search.roll_deg") && protocol.tells_tilt) return by;
  const bool height = key == "search.camera_height_m" || key == "search.camera_height_range_m";
  if (height && protocol.height == PriorHeight::kDrawn) return "its priors have heights";
  return "";
}

}  // namespace

void RefuseUnreadOptions(const std::vector<std::string>& assignments,
                         const LocalizerOptions& options,
                         std::span<const ScoreChoice> scores,
                         bool scores_are_named,
                         const Protocol& protocol) {
  for (const std::string& assignment : assignments) {
    const std::string key = assignment.substr(0, assignment.find('='));
    std::string reason = UnreadByProtocol(key, protocol);
    for (const Unread& unread : kUnread) {
      if (key.starts_with(unread.prefix)) reason = unread.reason;
    }
    if (key == "score.name" && scores_are_named) reason = "--score names the scores";
    if (reason.empty()) {
      std::size_t idle = 0;
      for (const ScoreChoice& score : scores) {
        const std::string why = IdleReason(assignment, key, options, score);
        if (why.empty()) continue;
        ++idle;
        reason = why;
      }
      if (idle < scores.size()) continue;
    }
    throw InputError(
        "--set", key, "an option that this study never reads", "another: " + reason);
  }
}

}  // namespace ridgeline
