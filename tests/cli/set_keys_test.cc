// SPDX-License-Identifier: Apache-2.0
// Every key that --set takes for a localization changes the result, or is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/option_groups.h"
#include "base/options.h"
#include "camera/pose.h"
#include "cli/in_process.h"
#include "localize/localizer_options.h"
#include "optim/sampler_table.h"
#include "score/score_table.h"

namespace ridgeline::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Every run: a small box.
const std::vector<std::string> kSmall = {"search.east_m=2",
                                         "search.north_m=2",
                                         "search.heading_deg=3",
                                         "search.pitch_deg=2",
                                         "search.roll_deg=2",
                                         "search.widenings=0"};

// A map of which few modes are refined.
const std::string kFewModes = "search.map.modes=3";

// A search by a sampler, on a cheap score unless told otherwise.
std::vector<std::string> Sampled(const std::string& sampler,
                                 int evaluations,
                                 const std::string& score = "line_energy") {
  return {"search.method=sampler",
          "search.sampler.name=" + sampler,
          "search.evaluations=" + std::to_string(evaluations),
          "score.name=" + score,
          "search.refine=false"};
}

std::vector<std::string> With(std::vector<std::string> assignments, const std::string& one) {
  assignments.push_back(one);
  return assignments;
}

// What makes the keys below a prefix work; the longest prefix counts. For a group of options of a
// score or a sampler it is by itself its first user.
const std::map<std::string, std::vector<std::string>>& SpecialCompanions() {
  static const std::map<std::string, std::vector<std::string>> companions = {
      {"", {kFewModes}},
      {"lines.canny_", {kFewModes, "lines.detector=hough"}},
      // The fit is kept then.
      {"search.refinement",
       {kFewModes,
        "search.fit.max_loss=1000",
        "search.fit.max_move_m=5",
        "search.fit.max_turn_deg=10"}},
      // The posterior mass is below 1 then.
      {"confidence.right.mass_power", {kFewModes, "confidence.temperature=50"}},
      // There is no protection level then, until the key makes gross errors impossible.
      {"confidence.near.",
       {kFewModes,
        "confidence.right.offset=-15",
        "confidence.near.mass_power=0",
        "confidence.near.offset=-100"}},
      {"confidence.near.above_background",
       {kFewModes,
        "confidence.right.offset=-15",
        "confidence.near.mass_power=0",
        "confidence.near.offset=-20"}},
      {"confidence.near.offset",
       {kFewModes,
        "confidence.right.offset=-15",
        "confidence.near.mass_power=0",
        "confidence.near.explained=-100"}},
      // The edges can tell little then.
      {"confidence.right.information", {kFewModes, "score.evidence.lines.spacing_width=0.1"}},
      {"confidence.near.information",
       {kFewModes,
        "score.evidence.lines.spacing_width=0.1",
        "confidence.right.offset=-15",
        "confidence.near.mass_power=0",
        "confidence.near.offset=-100"}},
      {"confidence.near.mass_power",
       {kFewModes,
        "confidence.right.offset=-15",
        "confidence.temperature=50",
        "confidence.near.offset=50"}},
      // The answer lies on a limit then.
      {"search.widenings", {kFewModes, "search.east_m=0.2", "search.north_m=0.2"}},
      {"search.evaluations", Sampled("sobol", 20)},
      {"search.sampler.", Sampled("sobol", 20)},
      {"search.sampler.cmaes.", Sampled("cmaes", 200)},
      {"search.sampler.de.", Sampled("de", 200)},
      {"search.sampler.gp_de.", Sampled("gp_de", 30)},
      {"search.sampler.nelder_mead.", Sampled("nelder_mead", 60)},
      // In few dimensions, so that the grids differ.
      {"search.sampler.grid.",
       With(With(With(Sampled("grid", 400), "search.sampler.grid.coarse_points=50"),
                 "search.pitch_deg=0"),
            "search.roll_deg=0")},
      {"search.sampler.multi_start.",
       With(With(Sampled("multi_start", 1000), "search.sampler.multi_start.first_points=8"),
            "search.sampler.multi_start.descents=1")},
      {"search.method", {}},
      // Wide enough to reach into the buildings.
      {"search.free_space",
       With(With(Sampled("sobol", 20), "search.east_m=40"), "search.north_m=40")},
      // Fine enough for a mode that the fit improves.
      {"search.refinement", {kFewModes, "search.map.spacing_m=0.5"}},
      {"search.fit.", {kFewModes, "search.refinement=fit", "search.fit.max_loss=10"}},
      // Only lines that are far from their edges have the sky on their darker side here.
      {"search.fit.matches.dark_sky_factor",
       {kFewModes,
        "search.refinement=fit",
        "search.fit.matches.max_sigmas=20",
        "search.fit.matches.max_angle_deg=20",
        "search.fit.max_loss=1000",
        "search.fit.max_move_m=5",
        "search.fit.max_turn_deg=9"}}};
  return companions;
}

// The groups of the plug-ins of a table with the first that declares each.
template <typename Plugin>
std::map<std::string, std::string> FirstUsers(std::span<const Plugin* const> table) {
  std::map<std::string, std::string> users;
  for (const Plugin* plugin : table) {
    OptionGroups groups;
    plugin->declare(groups);
    for (const std::string& group : groups.Names()) users.emplace(group, plugin->name);
  }
  return users;
}

const std::map<std::string, std::vector<std::string>>& Companions() {
  static const auto companions = [] {
    auto all = SpecialCompanions();
    for (const auto& [group, score] : FirstUsers(ScoreTable())) {
      all.emplace("score." + group + ".", Sampled("sobol", 8, score));
    }
    for (const auto& [group, sampler] : FirstUsers(SamplerTable())) {
      all.emplace("search.sampler." + group + ".", Sampled(sampler, 40));
    }
    return all;
  }();
  return companions;
}

// Values for keys that half as much again, twice and one more, or the opposite do not suit, such as
// limits that must bind.
const std::map<std::string, std::string>& Values() {
  static const std::map<std::string, std::string> values = {
      {"lines.detector", "edlines"},
      {"projection.max_distance_m", "30"},
      {"score.name", "line_energy"},
      {"score.weights", "[1,1,1,1,1,1,1,1,1]"},
      {"score.evidence.work_size_px", "200"},
      {"score.evidence.lines.seen_share", "[0.3,0.3,0.3,0.3,0.3]"},
      {"score.evidence.facades.max_lines", "3"},
      {"score.zbuffer_hough.radius_m", "30"},
      {"score.areas.source", "file"},
      {"score.areas.parts", "roof_wall"},
      {"score.areas.file", "none.png"},
      {"score.areas.building", "[1]"},
      {"score.areas.roof", "[2]"},
      {"score.areas.wall", "[3]"},
      {"score.areas.sky", "[4]"},
      {"score.areas.ground", "[5]"},
      {"score.areas.unknown", "[6]"},
      {"score.rays.max_distance_m", "20"},
      {"score.skyline.work_width_px", "200"},
      {"score.skyline.sky.work_width_px", "100"},
      {"score.skyline.sky.rounds", "0"},
      {"score.skyline_l1.max_deviation_px", "1"},
      {"score.skyline_l1.max_obstructed_px", "1"},
      {"score.skyline_l1.columns", "100"},
      {"score.skyline_l1.min_known_share", "1"},
      {"score.unexplained.max_lines", "5"},
      {"search.east_m", "0.5"},
      {"search.north_m", "0.5"},
      {"search.pitch_deg", "0.5"},
      {"search.roll_deg", "0.5"},
      {"search.method", "sampler"},
      {"search.refinement", "fit"},
      {"search.map.max_positions", "5"},
      {"search.map.tilts", "1"},
      {"search.map.modes", "1"},
      {"search.map.mode_separation_m", "4"},
      {"search.map.mode_separation_deg", "0.1"},
      {"search.fit.matches.dark_sky_factor", "0.01"},
      {"search.fit.max_rounds", "1"},
      {"search.fit.max_move_m", "0.01"},
      {"search.fit.max_turn_deg", "0.01"},
      {"search.fit.max_loss", "1e-6"},
      {"search.sampler.name", "random"},
      {"search.sampler.tpe.good_max", "1"},
      {"search.sampler.gp.max_points", "20"},
      {"search.sampler.gp.refit_growth", "2"},
      {"search.sampler.cmaes.ftol", "0.5"},
      {"search.sampler.cmaes.xtol", "1"},
      {"search.sampler.de.ftol", "0.5"},
      {"search.sampler.de.xtol", "1"},
      {"search.sampler.gp_de.gp_trials", "15"},
      {"search.sampler.nelder_mead.steps", "[0.3]"},
      {"search.sampler.nelder_mead.groups", "[\"east_m\",\"*\"]"},
      {"search.sampler.nelder_mead.convergence", "0.9"},
      {"search.sampler.grid.coarse_points", "300"},
      {"search.sampler.grid.keep", "1"},
      {"search.sampler.grid.finest", "0.2"},
      {"search.sampler.multi_start.descents", "4"},
      {"search.sampler.de.variant", "3"},
      {"confidence.abstain_below", "1"},
      {"search.widenings", "1"},
      {"search.height_m", "1.5"},
      {"search.camera_height_range_m", "0.01"},
      {"confidence.doubtful_below", "1"},
      {"confidence.alert_limit_m", "0.001"},
      // A gross error is out of the question then, and there is a protection level.
      {"confidence.near.offset", "500"},
      {"confidence.near.explained", "300"},
      {"confidence.near.above_background", "30"},
      {"confidence.near.information", "-1000"},
      {"confidence.near.mass_power", "0"}};
  return values;
}

std::string ValueOf(const std::string& key, const Json& value) {
  const auto it = Values().find(key);
  if (it != Values().end()) return it->second;
  if (value.is_boolean()) return value.get<bool>() ? "false" : "true";
  if (value.is_number_integer()) return std::to_string(2 * value.get<int>() + 1);
  if (value.is_number()) {
    const double number = value.get<double>();
    return Json(number == 0.0 ? 0.5 : 1.5 * number).dump();
  }
  ADD_FAILURE() << key << " needs a value here";
  return "";
}

const std::vector<std::string>& CompanionsOf(const std::string& key) {
  const std::vector<std::string>* best = nullptr;
  for (const auto& [prefix, companions] : Companions()) {  // in order: longer ones later
    if (key.starts_with(prefix)) best = &companions;
  }
  return *best;
}

class SetKeys : public ::testing::Test {
 protected:
  SetKeys() {
    const Json dataset = Json::parse(ReadFile(Town() / "dataset.json"));
    const Json& query = dataset["queries"][0];
    const std::vector<double> p = query["truth"]["position"];
    const std::vector<double> q = query["truth"]["cam_from_world_wxyz"];
    const ViewAngles view = ViewAnglesOf(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
    Json prior = query["prior"];
    prior["heading_deg"] = WrapHeadingDeg(view.heading_deg + 1.0);
    prior["pitch_deg"] = view.pitch_deg + 0.5;
    prior["roll_deg"] = view.roll_deg - 0.5;
    prior["position"] = {p[0] + 1.0, p[1] - 1.0};  // no height: the terrain's
    WriteFileAtomically(folder_ / "prior.json", prior.dump());
  }

  std::string Observe(const std::vector<std::string>& assignments) const {
    std::vector<std::string> words = {"localize",
                                      "--json",
                                      "--dataset",
                                      (Town() / "dataset.json").string(),
                                      "--query",
                                      "street_000",
                                      "--prior",
                                      (folder_ / "prior.json").string()};
    for (const std::string& assignment : kSmall) words.insert(words.end(), {"--set", assignment});
    for (const std::string& assignment : assignments) {
      words.insert(words.end(), {"--set", assignment});
    }
    const Outcome outcome = RunHere(words);
    EXPECT_NE(outcome.exit_code, 1) << outcome.text;
    // What is said of the ranges is no result.
    Json json = Json::parse(outcome.text, nullptr, false);
    if (json.is_object()) json.erase("assumptions");
    return std::to_string(outcome.exit_code) + (json.is_discarded() ? outcome.text : json.dump());
  }

  const fs::path folder_ = Scratch("set keys");
};

TEST_F(SetKeys, EachChangesTheResultOrIsRefused) {
  LocalizerOptions options;
  const Json all = Json::parse(OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }));
  std::map<std::vector<std::string>, std::string> before;
  const std::function<void(const Json&, const std::string&)> walk = [&](const Json& json,
                                                                        const std::string& path) {
    if (json.is_object()) {
      for (const auto& [name, value] : json.items()) {
        walk(value, path.empty() ? name : path + "." + name);
      }
      return;
    }
    std::vector<std::string> assignments = CompanionsOf(path);
    const auto [it, added] = before.emplace(assignments, "");
    if (added) it->second = Observe(assignments);
    assignments.push_back(path + "=" + ValueOf(path, json));
    EXPECT_NE(Observe(assignments), it->second) << assignments.back();
  };
  walk(all, "");
}

}  // namespace
}  // namespace ridgeline::testing
