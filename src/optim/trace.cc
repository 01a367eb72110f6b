// SPDX-License-Identifier: Apache-2.0
#include "optim/trace.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/json_input.h"

namespace ridgeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

Json BoxToJson(const SearchBox& box) {
  Json parameters = Json::array();
  for (const Parameter& p : box.parameters) {
    parameters.push_back(
        {{"name", p.name}, {"lower", p.lower}, {"upper", p.upper}, {"periodic", p.periodic}});
  }
  return parameters;
}

Json TrialToJson(const Trial& trial) {
  Json json = {{"index", trial.index}, {"values", trial.values}};
  switch (trial.state) {
    case TrialState::kComplete:
      json["energy"] = trial.energy;
      json["state"] = "complete";
      break;
    case TrialState::kInfeasible:
      json["state"] = "infeasible";
      break;
    case TrialState::kFailed:
      json["state"] = "failed";
      json["message"] = trial.message;
      break;
    case TrialState::kAsked:
      json["state"] = "asked";
      break;
  }
  return json;
}

// Throws nlohmann's exceptions and std::runtime_error; the caller adds file and line.
Trial TrialFromJson(const nlohmann::json& json) {
  Trial trial;
  trial.index = json.at("index").get<std::int64_t>();
  trial.values = json.at("values").get<std::vector<double>>();
  const std::string state = json.at("state").get<std::string>();
  if (state == "complete") {
    trial.SetEnergy(json.at("energy").get<double>());
  } else if (state == "infeasible") {
    trial.SetEnergy(std::numeric_limits<double>::infinity());
  } else if (state == "failed") {
    trial.SetEnergy(std::numeric_limits<double>::quiet_NaN());
    trial.message = json.at("message").get<std::string>();
  } else {
    throw std::runtime_error("the state \"" + state + "\"");
  }
  return trial;
}

void CheckHeader(const std::string& line, const std::string& file, const SearchBox& box) {
  const nlohmann::json header = ParseJson(line, file, "line 1");
  if (!header.is_object() || !header.contains("ridgeline_trace")) {
    throw InputError(file, "line 1", "no trace header", "{\"ridgeline_trace\": 1, ...}");
  }
  if (header["ridgeline_trace"] != kVersion) {
    throw InputError(file, "line 1: ridgeline_trace", JsonText(header["ridgeline_trace"]), "1");
  }
  const nlohmann::json parameters = header.value("parameters", nlohmann::json());
  if (parameters != nlohmann::json(BoxToJson(box))) {
    throw InputError(file, "line 1: parameters", JsonText(parameters), BoxToJson(box).dump());
  }
}

Trial ReadTrial(const std::string& line, const std::string& file, const std::string& place) {
  try {
    return TrialFromJson(ParseJson(line, file, place));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(file, place, e.what(), "a trial: index, values, state, energy");
  }
}

}  // namespace

const Trial* Trace::Best() const {
  const Trial* best = nullptr;
  for (const Trial& trial : trials) {
    if (trial.state != TrialState::kComplete) continue;
    if (best == nullptr || trial.energy < best->energy) best = &trial;
  }
  return best;
}

double Trace::BestEnergyAfter(std::size_t count) const {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(count, trials.size()); ++i) {
    if (trials[i].state == TrialState::kComplete) best = std::min(best, trials[i].energy);
  }
  return best;
}

void WriteTrace(const std::filesystem::path& path, const SearchBox& box, const Trace& trace) {
  std::string text = Json{{"ridgeline_trace", kVersion}, {"parameters", BoxToJson(box)}}.dump();
  text += "\n";
  // Messages may hold anything; bytes that are not UTF-8 are replaced.
  for (const Trial& trial : trace.trials) {
    text += TrialToJson(trial).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  WriteFileAtomically(path, text);
}

Trace ReadTrace(const std::filesystem::path& path, const SearchBox& box) {
  const std::string file = path.string();
  std::istringstream stream(ReadFile(path));
  std::string line;
  std::getline(stream, line);
  CheckHeader(line, file, box);
  Trace trace;
  for (int number = 2; std::getline(stream, line); ++number) {
    const std::string place = "line " + std::to_string(number);
    Trial trial = ReadTrial(line, file, place);
    if (trial.index != static_cast<std::int64_t>(trace.trials.size())) {
      throw InputError(file,
                       place + ": index",
                       std::to_string(trial.index),
                       std::to_string(trace.trials.size()));
    }
    if (!box.Contains(trial.values)) {
      throw InputError(file, place + ": values", Json(trial.values).dump(), "a point of the box");
    }
    trace.trials.push_back(std::move(trial));
  }
  return trace;
}

}  // namespace ridgeline
