// SPDX-License-Identifier: Apache-2.0
#include "eval/verify_results.h"

#include <nlohmann/json.hpp>
#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/bench_files.h"
#include "eval/run_folder.h"
#include "eval/run_json.h"
#include "eval/sha256.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Check CheckInput(const HashedFile& input, const Provenance& provenance) {
  Check check{input.role + " " + input.path, true, ""};
  if (input.sha256.empty()) return check;
  const fs::path place = PlaceOf(input, provenance);
  if (place.empty()) return {check.what, false, "is not there any more"};
  const std::string now = Sha256OfFile(place);
  if (now == input.sha256) return check;
  return {check.what,
          false,
          "has SHA-256 " + now.substr(0, 16) + "..., not " + input.sha256.substr(0, 16) + "..."};
}

// The records of all pieces, in the order of the work.
std::vector<RunRecord> RecordsOf(const fs::path& folder,
                                 const Provenance& provenance,
                                 const Dataset& dataset) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "runs")) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(".")) names.insert(name);
  }
  std::vector<RunRecord> records;
  for (const std::string& name : names) {
    const auto text = ReadPiece(folder, FingerprintOf(provenance), name);
    if (!text) throw InputError((folder / "runs" / name).string(), "", "a torn file", "a whole one");
    const std::size_t q =
        FindQuery(dataset, Json::parse(*text).at("query").get<std::string>(), name);
    records.push_back(ReadRun(*text, dataset.queries[q], q, name).record);
  }
  return records;
}

Check CheckText(const fs::path& file, const std::string& wanted) {
  const std::string name = file.filename();
  if (!fs::exists(file)) return {name, false, "is not there: the work was not finished (--resume)"};
  if (ReadFile(file) == wanted) return {name, true, ""};
  return {name, false, "is not what runs/ gives"};
}

}  // namespace

std::vector<Check> CheckInputs(const Provenance& provenance) {
  std::vector<Check> checks;
  for (const HashedFile& input : provenance.inputs) checks.push_back(CheckInput(input, provenance));
  return checks;
}

std::vector<Check> CheckTables(const fs::path& folder,
                               const Provenance& provenance,
                               const Dataset& dataset) {
  const std::vector<RunRecord> records = RecordsOf(folder, provenance, dataset);
  return {CheckText(folder / "results.csv", ResultsCsv(records)),
          CheckText(folder / "evidence.csv", EvidenceCsv(records))};
}

Provenance ProvenanceOfResults(const fs::path& folder) {
  if (fs::exists(folder / kProvenanceFile)) return ReadProvenance(folder / kProvenanceFile);
  const fs::path report = folder / "report.json";
  if (!fs::exists(report)) {
    throw InputError(
        folder.string(), "", "no provenance.json and no report.json", "a folder of results");
  }
  const Json json = Json::parse(ReadFile(report), nullptr, false);
  if (!json.is_object() || !json.contains("inputs")) {
    throw InputError(report.string(), "inputs", "nothing", "results of a version that hashes them");
  }
  Provenance provenance;
  provenance.version = json.value("version", "");
  provenance.command = "localize";
  provenance.folder = json.value("folder", "");
  provenance.arguments = provenance.task = "{}";
  for (const Json& input : json["inputs"]) {
    provenance.inputs.push_back(
        {input.value("role", ""), input.value("path", ""), input.value("sha256", "")});
  }
  return provenance;
}

}  // namespace ridgeline
