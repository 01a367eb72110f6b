// SPDX-License-Identifier: Apache-2.0
#include "eval/provenance.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/sha256.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What the fingerprint is of.
Json Essence(const Provenance& provenance) {
  Json inputs = Json::array();
  for (const HashedFile& input : provenance.inputs) inputs.push_back({input.role, input.sha256});
  return {{"version", provenance.version},
          {"command", provenance.command},
          {"task", Json::parse(provenance.task)},
          {"inputs", inputs}};
}

[[noreturn]] void FailDifferent(const fs::path& file,
                                const std::string& field,
                                const std::string& there,
                                const std::string& now) {
  throw InputError(file.string(),
                   field,
                   "results made with " + there,
                   now + " as asked for now, or another --out");
}

std::string Short(const Json& value) {
  const std::string text = value.dump();
  constexpr std::size_t kMost = 80;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

// The first leaf in which two values differ, as a path with dots.
void CheckSameValue(const Json& there,
                    const Json& now,
                    const std::string& path,
                    const fs::path& file) {
  if (there == now) return;
  if (there.is_object() && now.is_object()) {
    for (const auto& [key, value] : now.items()) {
      const std::string below = path.empty() ? key : path + "." + key;
      const auto it = there.find(key);
      if (it == there.end()) FailDifferent(file, below, "nothing", Short(value));
      CheckSameValue(*it, value, below, file);
    }
    for (const auto& [key, value] : there.items()) {
      if (!now.contains(key)) FailDifferent(file, path + "." + key, Short(value), "nothing");
    }
    return;
  }
  FailDifferent(file, path, Short(there), Short(now));
}

std::vector<fs::path> FilesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string ProvenanceJson(const Provenance& provenance) {
  Json inputs = Json::array();
  for (const HashedFile& input : provenance.inputs) {
    inputs.push_back({{"role", input.role}, {"path", input.path}, {"sha256", input.sha256}});
  }
  Json json = {{"version", provenance.version},
               {"command", provenance.command},
               {"fingerprint", FingerprintOf(provenance)},
               {"shard", provenance.shard ? Json(TextOf(*provenance.shard)) : Json(nullptr)},
               {"folder", provenance.folder},
               {"arguments", Json::parse(provenance.arguments)},
               {"task", Json::parse(provenance.task)},
               {"inputs", inputs}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Provenance ReadProvenance(const fs::path& file) {
  const std::string text = ReadFile(file);
  try {
    const Json json = Json::parse(text);
    Provenance provenance;
    provenance.version = json.at("version").get<std::string>();
    provenance.command = json.at("command").get<std::string>();
    provenance.folder = json.at("folder").get<std::string>();
    provenance.arguments = json.at("arguments").dump();
    provenance.task = json.at("task").dump();
    if (!json.at("shard").is_null()) {
      provenance.shard = ParseShard(json.at("shard").get<std::string>());
    }
    for (const Json& input : json.at("inputs")) {
      provenance.inputs.push_back({input.at("role").get<std::string>(),
                                   input.at("path").get<std::string>(),
                                   input.at("sha256").get<std::string>()});
    }
    return provenance;
  } catch (const Json::exception& e) {
    throw InputError(file.string(), "", "no provenance of results", "one that ridgeline wrote");
  }
}

std::string FingerprintOf(const Provenance& provenance) {
  return Sha256Of(Essence(provenance).dump(-1, ' ', false, Json::error_handler_t::replace));
}

void CheckSame(const Provenance& there, const Provenance& now, const fs::path& file) {
  if (FingerprintOf(there) == FingerprintOf(now)) return;
  CheckSameValue(there.command, now.command, "command", file);
  CheckSameValue(there.version, now.version, "version", file);
  CheckSameValue(Json::parse(there.task), Json::parse(now.task), "", file);
  for (std::size_t i = 0; i < std::min(there.inputs.size(), now.inputs.size()); ++i) {
    const HashedFile& a = there.inputs[i];
    const HashedFile& b = now.inputs[i];
    if (a.role == b.role && a.sha256 == b.sha256) continue;
    FailDifferent(file,
                  "inputs[" + std::to_string(i) + "]",
                  a.role + " " + a.path + " (SHA-256 " + a.sha256.substr(0, 12) + "...)",
                  b.role + " " + b.path + " (" + b.sha256.substr(0, 12) + "...)");
  }
  FailDifferent(file,
                "inputs",
                std::to_string(there.inputs.size()) + " files",
                std::to_string(now.inputs.size()) + " files");
}

void AddHashed(const std::string& role, const fs::path& path, std::vector<HashedFile>& inputs) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    for (const fs::path& file : FilesBelow(path)) AddHashed(role, file, inputs);
    return;
  }
  const bool is_file = fs::exists(path, error);
  inputs.push_back({role, path.string(), is_file ? Sha256OfFile(path) : ""});
}

std::vector<HashedFile> HashInputs(const Dataset& dataset,
                                  const std::vector<std::size_t>& queries,
                                  const std::string& role) {
  std::vector<HashedFile> inputs;
  const std::string prefix = role == "dataset" ? "" : role + " ";
  AddHashed(role, dataset.file, inputs);
  for (const fs::path& model : dataset.model) AddHashed(prefix + "model", model, inputs);
  if (dataset.dtm) AddHashed(prefix + "dtm", *dataset.dtm, inputs);
  std::set<fs::path> seen;  // several queries may be of one picture
  for (const std::size_t q : queries) {
    const Query& query = dataset.queries[q];
    if (seen.insert(query.image).second) AddHashed("image", query.image, inputs);
    if (query.lines && seen.insert(*query.lines).second) AddHashed("lines", *query.lines, inputs);
  }
  return inputs;
}

fs::path PlaceOf(const HashedFile& input, const Provenance& provenance) {
  std::error_code error;
  for (const fs::path& place : {fs::path(provenance.folder) / input.path, fs::path(input.path)}) {
    if (fs::is_regular_file(place, error)) return place;
  }
  return {};
}

}  // namespace ridgeline
