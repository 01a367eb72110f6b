// SPDX-License-Identifier: Apache-2.0
#include "study/study_files.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "eval/binomial.h"
#include "eval/csv_text.h"
#include "score/score.h"
#include "score/skyline_l1.h"

namespace ridgeline {
namespace {

using Json = nlohmann::ordered_json;

// Query, set and score of a row.
std::string NameFields(const StudyNames& names, const ScoreStudy& study) {
  return CsvField(names.dataset.queries[study.query].id) + ',' + CsvField(study.set) + ',' +
         CsvField(names.scores[study.score].name);
}

std::string FigureHeader() {
  std::string header;
  for (const FigureText& figure : kFigureTexts) header += std::string(",") + figure.key;
  return header;
}

// Small shares need digits: one pose of 18 000 is 6e-5.
std::string FigureFields(const ScoreStudy& study) {
  std::string fields;
  for (const FigureText& figure : kFigureTexts) {
    fields += ',' + (study.figures ? CsvNumber(figure.of(*study.figures), 6) : "");
  }
  return fields;
}

std::string RecallHeader() {
  std::string header;
  for (const StudyLimit& limit : kStudyLimits) {
    const std::string name = std::string(",recall_") + limit.name;
    header += name + name + "_lower" + name + "_upper";
  }
  return header;
}

std::string SummaryFields(const StudySummary& summary) {
  std::string fields;
  for (const double recall : summary.recall) {
    const Interval95 interval = WilsonInterval(recall, summary.queries);
    fields += ',' + CsvNumber(recall, 4) + ',' + CsvNumber(interval.lower, 4) + ',' +
              CsvNumber(interval.upper, 4);
  }
  for (const double median : summary.median) fields += ',' + CsvNumber(median, 6);
  return fields;
}

void AddProfile(const StudyNames& names,
                const ScoreStudy& study,
                const char* axis,
                std::span<const ErrorBin> bins,
                std::ostringstream& csv) {
  for (const ErrorBin& bin : bins) {
    csv << NameFields(names, study) << ',' << axis << ',' << CsvNumber(bin.lower, 3) << ','
        << CsvNumber(bin.upper, 3) << ',' << bin.poses << ','
        << CsvNumber(Score::EnergyOf(bin.best_log_ratio), 6) << ','
        << CsvNumber(Score::EnergyOf(bin.median_log_ratio), 6) << ','
        << CsvNumber(bin.home_share, 4) << '\n';
  }
}

}  // namespace

std::string FiguresCsv(const StudyNames& names, std::span<const ScoreStudy> studies) {
  std::ostringstream csv;
  csv << "query,set,score" << FigureHeader()
      << ",margin_log_ratio,minimum_e,minimum_n,minimum_h,minimum_heading_deg,minimum_energy,poses,"
         "visible_edges,picture_lines,seconds,reason\n";
  for (const ScoreStudy& study : studies) {
    csv << NameFields(names, study) << FigureFields(study) << ',';
    if (study.figures) {
      const Eigen::Vector3d& c = study.minimum.center_in_world;
      float least = 1.0f;
      for (const float energy : study.map.energies) least = std::fmin(least, energy);
      csv << CsvNumber(study.figures->margin_log_ratio, 4) << ',' << CsvNumber(c.x(), 3) << ','
          << CsvNumber(c.y(), 3) << ',' << CsvNumber(c.z(), 3) << ','
          << CsvNumber(ViewAnglesOf(study.minimum.cam_from_world).heading_deg, 3) << ','
          << CsvNumber(least, 6) << ',' << study.figures->poses;
    } else {
      csv << ",,,,,,0";
    }
    csv << ',' << study.visible_edges << ',' << study.picture_lines << ','
        << CsvNumber(study.seconds, 3) << ',' << CsvField(study.reason) << '\n';
  }
  return csv.str();
}

std::string SummaryCsv(const Protocol& protocol, std::span<const StudySummary> summaries) {
  std::ostringstream csv;
  csv << "protocol,score,set,queries,with_figures" << RecallHeader() << FigureHeader()
      << ",seconds\n";
  for (const StudySummary& summary : summaries) {
    csv << CsvField(protocol.name) << ',' << CsvField(summary.score) << ',' << CsvField(summary.set)
        << ',' << summary.queries << ',' << summary.with_figures << SummaryFields(summary) << ','
        << CsvNumber(summary.seconds, 3) << '\n';
  }
  return csv.str();
}

std::string StudySummaryJson(const std::string& dataset,
                             const Protocol& protocol,
                             std::span<const StudySummary> summaries) {
  Json rows = Json::array();
  for (const StudySummary& summary : summaries) {
    Json row = {{"score", summary.score},
                {"set", summary.set},
                {"queries", summary.queries},
                {"with_figures", summary.with_figures}};
    for (std::size_t t = 0; t < kStudyLimits.size(); ++t) {
      const Interval95 interval = WilsonInterval(summary.recall[t], summary.queries);
      row["recall"][kStudyLimits[t].name] = summary.recall[t];
      row["recall_ci95"][kStudyLimits[t].name] = {interval.lower, interval.upper};
    }
    for (std::size_t f = 0; f < kFigures; ++f) {
      const double value = summary.median[f];
      row["median"][kFigureTexts[f].key] = std::isfinite(value) ? Json(value) : Json(nullptr);
    }
    row["seconds_per_map"] = summary.seconds;
    rows.push_back(std::move(row));
  }
  return Json({{"dataset", dataset}, {"protocol", protocol.name}, {"scores", rows}})
             .dump(1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

std::string MapCsv(const EnergyMap& map) {
  std::ostringstream csv;
  csv << "east,north,energy,heading_deg\n";
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const std::size_t cell = static_cast<std::size_t>(row) * map.columns + column;
      csv << CsvNumber(map.first.x() + column * map.spacing_m, 3) << ','
          << CsvNumber(map.first.y() + row * map.spacing_m, 3) << ','
          << CsvNumber(map.energies[cell], 6) << ',' << CsvNumber(map.headings_deg[cell], 3)
          << '\n';
    }
  }
  return csv.str();
}

std::string HeadingsCsv(const StudyNames& names, std::span<const ScoreStudy> studies) {
  std::ostringstream csv;
  csv << "query,set,score,heading_deg,heading_error_deg,energy\n";
  for (const ScoreStudy& study : studies) {
    const Query& query = names.dataset.queries[study.query];
    const double truth_deg = ViewAnglesOf(query.truth->cam_from_world).heading_deg;
    for (std::size_t h = 0; h < study.heading_deg.size(); ++h) {
      csv << NameFields(names, study) << ',' << CsvNumber(study.heading_deg[h], 3) << ','
          << CsvNumber(HeadingDifferenceDeg(study.heading_deg[h], truth_deg), 3) << ','
          << CsvNumber(study.heading_energy[h], 6) << '\n';
    }
  }
  return csv.str();
}

std::string ProfilesCsv(const StudyNames& names, std::span<const ScoreStudy> studies) {
  std::ostringstream csv;
  csv << "query,set,score,axis,from,to,poses,least_energy,median_energy,home_share\n";
  for (const ScoreStudy& study : studies) {
    AddProfile(names, study, "translation_m", study.by_distance, csv);
    AddProfile(names, study, "rotation_deg", study.by_angle, csv);
  }
  return csv.str();
}

std::string SampledCsv(const StudyNames& names, std::span<const ScoreStudy> studies) {
  std::ostringstream csv;
  csv << "query,set,score,evaluation,class,energy,t_err_m,t_err_horizontal_m,r_err_deg\n";
  for (const ScoreStudy& study : studies) {
    for (const SampledPose& point : study.sampled) {
      csv << NameFields(names, study) << ',' << point.evaluation << ',' << point.after << ','
          << CsvNumber(point.energy, 6) << ',' << CsvNumber(point.translation_m, 4) << ','
          << CsvNumber(point.horizontal_m, 4) << ',' << CsvNumber(point.rotation_deg, 4) << '\n';
    }
  }
  return csv.str();
}

std::string SensitivityCsv(const StudyNames& names, std::span<const VariedStudy> studies) {
  std::ostringstream csv;
  csv << "vary,level,query,set,score" << FigureHeader() << ",visible_edges,picture_lines\n";
  for (const VariedStudy& varied : studies) {
    const Variation& variation = names.variations[varied.variation];
    csv << variation.name << ',' << variation.levels[varied.level] << ','
        << NameFields(names, varied.study) << FigureFields(varied.study) << ','
        << varied.study.visible_edges << ',' << varied.study.picture_lines << '\n';
  }
  return csv.str();
}

std::string SensitivitySummaryCsv(const StudyNames& names,
                                  std::span<const LevelSummary> summaries) {
  std::ostringstream csv;
  csv << "vary,level,score,queries,with_figures" << RecallHeader() << FigureHeader()
      << ",visible_edges\n";
  for (const LevelSummary& entry : summaries) {
    const Variation& variation = names.variations[entry.variation];
    csv << variation.name << ',' << variation.levels[entry.level] << ','
        << CsvField(entry.summary.score) << ',' << entry.summary.queries << ','
        << entry.summary.with_figures << SummaryFields(entry.summary) << ','
        << CsvNumber(entry.visible_edges, 1) << '\n';
  }
  return csv.str();
}

std::string ExploredCsv(const ExploredMap& explored, const ScoreChoice& score) {
  const EnergyMap& map = explored.map;
  const bool is_skyline = score.options.name == "skyline_l1";
  std::ostringstream csv;
  csv << "east,north,energy,heading_deg,pitch_deg,roll_deg" << (is_skyline ? ",l1_px" : "") << '\n';
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const std::size_t cell = static_cast<std::size_t>(row) * map.columns + column;
      csv << CsvNumber(map.first.x() + column * map.spacing_m, 3) << ','
          << CsvNumber(map.first.y() + row * map.spacing_m, 3) << ','
          << CsvNumber(map.energies[cell], 6) << ',' << CsvNumber(map.headings_deg[cell], 3) << ','
          << CsvNumber(explored.pitch_deg[cell], 3) << ',' << CsvNumber(explored.roll_deg[cell], 3);
      if (is_skyline) {
        csv << ',' << CsvNumber(SkylineDistanceOf(map.energies[cell], score.options), 3);
      }
      csv << '\n';
    }
  }
  return csv.str();
}

double SkylineDistanceOf(double energy, const ScoreOptions& options) {
  return options.groups.Get<SkylineL1Options>().half_energy_px * energy / (1.0 - energy);
}

}  // namespace ridgeline
