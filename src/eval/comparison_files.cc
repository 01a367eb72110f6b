// SPDX-License-Identifier: Apache-2.0
#include "eval/comparison_files.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "eval/csv_text.h"

namespace ridgeline {
namespace {

using Json = nlohmann::ordered_json;

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string RunFields(const RunRecord& run) {
  std::string fields = run.status + ',';
  fields += run.error ? CsvNumber(run.error->translation_m, 4) : "";
  fields += ',';
  fields += run.error ? CsvNumber(run.error->rotation_deg, 5) : "";
  return fields + ',' + CsvNumber(run.energy, 6) + ',' + CsvNumber(run.confidence, 6) + ',' +
         CsvNumber(run.seconds, 3);
}

std::string Text(const char* format, double value, double scale = 1.0) {
  if (!std::isfinite(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, format, scale * value);
  return text;
}

}  // namespace

std::string ComparisonCsv(std::span<const Comparison> comparisons) {
  std::ostringstream csv;
  csv << "first,second,figure,unit,of_first,of_second,difference,lower,upper,mcnemar_p,queries,"
         "pairs\n";
  for (const Comparison& comparison : comparisons) {
    for (const ComparedFigure& f : comparison.figures) {
      csv << CsvField(comparison.a) << ',' << CsvField(comparison.b) << ',' << f.name << ','
          << f.unit << ',' << CsvNumber(f.a, 6) << ',' << CsvNumber(f.b, 6) << ','
          << CsvNumber(f.difference, 6) << ',' << CsvNumber(f.ci95.lower, 6) << ','
          << CsvNumber(f.ci95.upper, 6) << ',' << CsvNumber(f.mcnemar_p, 6) << ',' << f.queries
          << ',' << f.pairs << '\n';
    }
  }
  return csv.str();
}

std::string PairsCsv(std::span<const Comparison> comparisons) {
  std::ostringstream csv;
  csv << "first,second,query,seed";
  for (const char* of : {"first", "second"}) {
    for (const char* column :
         {"status", "t_err_m", "r_err_deg", "energy", "confidence", "seconds"}) {
      csv << ',' << column << '_' << of;
    }
  }
  csv << ",apart_m,apart_deg,disagreement\n";
  for (const Comparison& comparison : comparisons) {
    for (const RunPair& pair : comparison.pairs) {
      csv << CsvField(comparison.a) << ',' << CsvField(comparison.b) << ','
          << CsvField(pair.query) << ',' << (pair.seed == 0 ? "" : std::to_string(pair.seed))
          << ',' << RunFields(*pair.a) << ',' << RunFields(*pair.b) << ',';
      if (pair.a->pose && pair.b->pose) {
        const PoseError apart = ErrorOf(*pair.a->pose, *pair.b->pose);
        csv << CsvNumber(apart.translation_m, 4) << ',' << CsvNumber(apart.rotation_deg, 5);
      } else {
        csv << ',';
      }
      csv << ',' << WordsOf(DisagreementOf(pair)) << '\n';
    }
  }
  return csv.str();
}

std::string ComparisonJson(std::span<const Comparison> comparisons) {
  Json list = Json::array();
  for (const Comparison& comparison : comparisons) {
    Json figures = Json::array();
    for (const ComparedFigure& f : comparison.figures) {
      figures.push_back({{"figure", f.name},
                         {"unit", f.unit},
                         {"of_first", Number(f.a)},
                         {"of_second", Number(f.b)},
                         {"difference", Number(f.difference)},
                         {"ci95", Json::array({Number(f.ci95.lower), Number(f.ci95.upper)})},
                         {"mcnemar_p", Number(f.mcnemar_p)},
                         {"queries", f.queries},
                         {"pairs", f.pairs}});
    }
    Json apart = Json::array();
    for (const RunPair& pair : comparison.pairs) {
      const Disagreement disagreement = DisagreementOf(pair);
      if (disagreement == Disagreement::kNone) continue;
      apart.push_back({{"query", pair.query},
                       {"seed", pair.seed == 0 ? Json(nullptr) : Json(pair.seed)},
                       {"disagreement", WordsOf(disagreement)}});
    }
    list.push_back({{"first", comparison.a},
                    {"second", comparison.b},
                    {"pairs", comparison.pairs.size()},
                    {"figures", figures},
                    {"disagreements", apart},
                    {"unpaired", comparison.unpaired}});
  }
  return list.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ComparisonText(const Comparison& comparison) {
  char line[240];
  std::string text = comparison.b + " against " + comparison.a + ", " +
                     std::to_string(comparison.pairs.size()) + " pairs\n";
  std::snprintf(line,
                sizeof line,
                "%-46s %10s %10s %11s   %-20s %s\n",
                "",
                comparison.a.substr(0, 10).c_str(),
                comparison.b.substr(0, 10).c_str(),
                "difference",
                "95 % interval",
                "McNemar p");
  text += line;
  for (const ComparedFigure& f : comparison.figures) {
    const bool is_share = f.unit == "share";
    const double scale = is_share ? 100.0 : 1.0;
    const char* format = is_share ? "%.1f" : "%.3g";
    const char* signed_format = is_share ? "%+.1f" : "%+.3g";
    const std::string interval = Text(signed_format, f.ci95.lower, scale) + " to " +
                                 Text(signed_format, f.ci95.upper, scale);
    const std::string unit = is_share ? "%" : f.unit;
    std::snprintf(line,
                  sizeof line,
                  "%-46s %10s %10s %11s   %-20s %s\n",
                  (f.name + (unit.empty() ? "" : " [" + unit + "]")).c_str(),
                  Text(format, f.a, scale).c_str(),
                  Text(format, f.b, scale).c_str(),
                  Text(signed_format, f.difference, scale).c_str(),
                  interval.c_str(),
                  Text("%.3g", f.mcnemar_p).c_str());
    text += line;
  }
  if (!comparison.unpaired.empty()) {
    text += std::to_string(comparison.unpaired.size()) + " runs without a partner, e.g. " +
            comparison.unpaired.front() + "\n";
  }
  text.pop_back();
  return text;
}

}  // namespace ridgeline
