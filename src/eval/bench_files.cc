// SPDX-License-Identifier: Apache-2.0
#include "eval/bench_files.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>
#include <vector>

#include "base/decimals.h"
#include "base/error.h"
#include "base/text_file.h"
#include "camera/check_pose.h"
#include "camera/local_frame.h"
#include "eval/csv_text.h"
#include "eval/egeniouss_metrics.h"

namespace ridgeline {
namespace {

using Json = nlohmann::ordered_json;

Json JsonOf(const Spread& spread) {
  return {{"median", RoundedTo(spread.median, 6)},
          {"mean", RoundedTo(spread.mean, 6)},
          {"mad", RoundedTo(spread.mad, 6)}};
}

Json JsonOf(const EgenioussSpread& spread) {
  return {{"median", spread.median}, {"mean", spread.mean}, {"rmse", spread.rmse}};
}

Json JsonOf(const EgenioussMetrics& metrics) {
  Json json = {{"poses", metrics.poses}, {"missing", metrics.missing}};
  for (std::size_t b = 0; b < kEgenioussBins.size(); ++b) {
    json["share_strictly_below"][kEgenioussBins[b].name] = metrics.share[b];
  }
  json["translation_m"] = JsonOf(metrics.translation_m);
  json["rotation_deg"] = JsonOf(metrics.rotation_deg);
  return json;
}

Json JsonOf(const RunShare& share) {
  return {{"share", share.share}, {"ci95", {share.ci95.lower, share.ci95.upper}}};
}

Json JsonOf(const Summary& summary, const Protocol& protocol) {
  Json json;
  json["queries"] = summary.queries;
  json["runs"] = summary.all_runs;
  json["runs_with_truth"] = summary.runs;
  // Without a truth nothing is known of errors: null, not 0.
  const bool has_truth = summary.runs > 0;
  for (const char* key : {"recall", "recall_ci95", "recall_answered"}) json[key] = nullptr;
  const bool has_recall = has_truth && protocol.HasRecall();
  for (std::size_t t = 0; has_recall && t < kRecallThresholds.size(); ++t) {
    const char* name = kRecallThresholds[t].name;
    json["recall"][name] = summary.recall[t];
    json["recall_ci95"][name] = {summary.recall_ci95[t].lower, summary.recall_ci95[t].upper};
    json["recall_answered"][name] = summary.recall_answered[t];
  }
  json["translation_error_m"] = has_truth ? JsonOf(summary.translation_m) : Json();
  json["rotation_error_deg"] = has_truth ? JsonOf(summary.rotation_deg) : Json();
  json["abstained"] = summary.abstained.share;
  json["abstained_ci95"] = JsonOf(summary.abstained)["ci95"];
  if (summary.searched == 0) {
    json["with_energy"] = summary.judged;
    for (const char* key : {"doubtful", "confidence_0.9", "coverage_95", "seconds_per_query",
                            "pose_evaluations_per_second"}) {
      json[key] = nullptr;
    }
    return json;
  }
  json["doubtful"] = JsonOf(summary.doubtful);
  json["confidence_0.9"] = JsonOf(summary.confident);
  json["confidence_0.9"]["recall_2m_2deg"] =
      has_truth ? Json(summary.confident_recall_2m_2deg) : Json();
  json["confidence_0.9"]["wrong"] =
      has_truth ? JsonOf(summary.confident_wrong)
                : (protocol.HasRecall() ? Json() : JsonOf(summary.confident));
  if (has_truth && !has_recall) json["found_by_widening_2m_2deg"] = summary.recall[2];
  json["coverage_95"] = nullptr;
  if (has_truth) {
    json["coverage_95"] = {{"position_ellipse", summary.ellipse_coverage},
                           {"heading_interval", summary.interval_coverage}};
  }
  json["seconds_per_query"] = {{"median", summary.seconds_median}, {"p95", summary.seconds_p95}};
  json["pose_evaluations_per_second"] = summary.evaluations_per_second;
  return json;
}

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  std::string field;
  while (std::getline(stream, field, ',')) {
    field.erase(0, field.find_first_not_of(" \t"));
    field.erase(field.find_last_not_of(" \t\r") + 1);
    fields.push_back(field);
  }
  return fields;
}

}  // namespace

std::string ResultsCsv(std::span<const RunRecord> runs) {
  std::ostringstream csv;
  csv << "query,seed,status,energy,confidence,e,n,h,qw,qx,qy,qz,t_err_m,t_err_horizontal_m,r_err_"
         "deg,"
         "evaluations,seconds\n";
  for (const RunRecord& run : runs) {
    csv << CsvField(run.query) << ',' << run.seed << ',' << run.status << ','
        << CsvNumber(run.energy, 6) << ',' << CsvNumber(run.confidence, 6) << ',';
    if (run.pose) {
      const Eigen::Vector3d& c = run.pose->center_in_world;
      const Eigen::Quaterniond& q = run.pose->cam_from_world;
      csv << CsvNumber(c.x(), 4) << ',' << CsvNumber(c.y(), 4) << ',' << CsvNumber(c.z(), 4) << ','
          << CsvNumber(q.w(), 9) << ',' << CsvNumber(q.x(), 9) << ',' << CsvNumber(q.y(), 9) << ','
          << CsvNumber(q.z(), 9) << ',';
    } else {
      csv << ",,,,,,,";
    }
    if (run.error) {
      csv << CsvNumber(run.error->translation_m, 4) << ',' << CsvNumber(run.error->horizontal_m, 4)
          << ',' << CsvNumber(run.error->rotation_deg, 5) << ',';
    } else {
      csv << ",,,";
    }
    if (run.is_searched) {
      csv << run.evaluations << ',' << CsvNumber(run.seconds, 3) << '\n';
    } else {
      csv << ",\n";
    }
  }
  return csv.str();
}

std::string EvidenceCsv(std::span<const RunRecord> runs) {
  std::ostringstream csv;
  csv << "query,seed,set,status,confidence,posterior_mass,explained,observed_nat,information_nat,"
         "above_background_nat,candidate_t_err_m,candidate_r_err_deg\n";
  for (const RunRecord& run : runs) {
    csv << CsvField(run.query) << ',' << run.seed << ',' << CsvField(run.set) << ',' << run.status
        << ',' << CsvNumber(run.confidence, 6) << ',' << CsvNumber(run.posterior_mass, 6) << ','
        << CsvNumber(run.explained, 4) << ',' << CsvNumber(run.observed_nat, 3) << ','
        << CsvNumber(run.information_nat, 3) << ','
        << (run.above_background_nat ? CsvNumber(*run.above_background_nat, 3) : "") << ',';
    if (run.candidate_error) {
      csv << CsvNumber(run.candidate_error->translation_m, 4) << ','
          << CsvNumber(run.candidate_error->rotation_deg, 5);
    } else {
      csv << ',';
    }
    csv << '\n';
  }
  return csv.str();
}

std::string SummaryJson(const std::string& dataset,
                        const std::string& config,
                        const Protocol& protocol,
                        std::span<const RunRecord> runs) {
  Json json = {{"dataset", dataset},
               {"config", config},
               {"protocol", protocol.name},
               {"protocol_means", protocol.words}};
  json.update(JsonOf(Summarize(runs), protocol));
  const EgenioussMetrics egeniouss = EgenioussMetricsOf(runs);
  json["egenioussbench"] = protocol.HasRecall() && egeniouss.poses > 0 ? JsonOf(egeniouss) : Json();
  std::map<std::string, std::vector<RunRecord>> sets;
  for (const RunRecord& run : runs) sets[run.set].push_back(run);
  if (sets.size() > 1) {
    for (const auto& [name, of_set] : sets) {
      json["sets"][name.empty() ? "(none)" : name] = JsonOf(Summarize(of_set), protocol);
    }
  }
  return json.dump(1) + "\n";
}

std::string PosesText(std::span<const RunRecord> runs, const Eigen::Vector3d& origin) {
  std::ostringstream text;
  text << "# cam_from_world poses in the manner of COLMAP's images.txt, relative to the origin\n"
       << "# origin " << CsvNumber(origin.x(), 1) << ' ' << CsvNumber(origin.y(), 1) << ' '
       << CsvNumber(origin.z(), 1) << " (east north height)\n"
       << "# query seed qw qx qy qz tx ty tz\n";
  const LocalFrame frame{origin};
  for (const RunRecord& run : runs) {
    if (!run.pose) continue;
    const Pose relative = frame.FromWorld(*run.pose);
    const Eigen::Quaterniond& q = relative.cam_from_world;
    const Eigen::Vector3d t = relative.ColmapTranslation();
    text << run.query << ' ' << run.seed << ' ' << CsvNumber(q.w(), 9) << ' ' << CsvNumber(q.x(), 9)
         << ' ' << CsvNumber(q.y(), 9) << ' ' << CsvNumber(q.z(), 9) << ' ' << CsvNumber(t.x(), 5)
         << ' ' << CsvNumber(t.y(), 5) << ' ' << CsvNumber(t.z(), 5) << '\n';
  }
  return text.str();
}

std::map<std::string, Pose> ReadPosesCsv(const std::filesystem::path& path) {
  std::istringstream stream(ReadText(path));
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = Fields(line);
  const std::vector<std::string> wanted = {"query", "e", "n", "h", "qw", "qx", "qy", "qz"};
  std::vector<std::size_t> columns;
  for (const std::string& name : wanted) {
    const auto it = std::find(header.begin(), header.end(), name);
    if (it == header.end()) {
      throw InputError(
          path.string(), "line 1", "no column \"" + name + "\"", "query,e,n,h,qw,qx,qy,qz");
    }
    columns.push_back(static_cast<std::size_t>(it - header.begin()));
  }
  std::map<std::string, Pose> poses;
  for (int number = 2; std::getline(stream, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    if (fields.empty()) continue;
    std::vector<double> values;
    for (std::size_t i = 1; i < columns.size(); ++i) {
      double value = NAN;
      if (columns[i] < fields.size()) {
        std::istringstream text(fields[columns[i]]);
        if (!(text >> value)) value = NAN;
      }
      if (!std::isfinite(value)) {
        throw InputError(path.string(),
                         "line " + std::to_string(number),
                         "\"" + line + "\"",
                         "a number for " + wanted[i]);
      }
      values.push_back(value);
    }
    Pose pose;
    pose.center_in_world = {values[0], values[1], values[2]};
    const std::string place = "line " + std::to_string(number);
    CheckPlace(pose.center_in_world, path.string(), place);
    pose.cam_from_world =
        UnitQuaternion(std::span(values).subspan(3), path.string(), place + ": qw,qx,qy,qz");
    if (!poses.emplace(fields[columns[0]], pose).second) {
      throw InputError(
          path.string(), place, "\"" + fields[columns[0]] + "\" again", "one line per query");
    }
  }
  if (poses.empty()) throw InputError(path.string(), "", "no pose", "one line per query");
  return poses;
}

}  // namespace ridgeline
