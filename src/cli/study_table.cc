// SPDX-License-Identifier: Apache-2.0
#include "cli/study_table.h"

#include <cmath>
#include <cstdio>

namespace ridgeline {
namespace {

std::string Cell(const char* format, double value) {
  if (!std::isfinite(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string TableOf(std::span<const StudySummary> summaries) {
  char line[256];
  std::string text =
      "                                          minimum within         medians\n"
      "score                set          queries 2m2deg 5m5deg 9m10deg  better     comes home from "
      "  "
      "margin  rank\n";
  for (const StudySummary& s : summaries) {
    std::snprintf(line,
                  sizeof line,
                  "%-20.20s %-12.12s %7d %4.0f %% %4.0f %% %5.0f %%  %-9s %5s m %5s deg  %6s %6s\n",
                  s.score.c_str(),
                  s.set.c_str(),
                  s.queries,
                  100.0 * s.recall[0],
                  100.0 * s.recall[1],
                  100.0 * s.recall[2],
                  Cell("%.3g %%", 100.0 * s.median[2]).c_str(),
                  Cell("%.1f", s.median[3]).c_str(),
                  Cell("%.1f", s.median[4]).c_str(),
                  Cell("%.2f", s.median[5]).c_str(),
                  Cell("%.2f", s.median[6]).c_str());
    text += line;
  }
  text.pop_back();
  return text;
}

std::string SensitivityTextOf(const StudyNames& names, std::span<const LevelSummary> levels) {
  char line[256];
  std::string text =
      "                                       minimum within         medians\n"
      "changed     level    score             2m2deg 5m5deg 9m10deg  better     comes home from\n";
  for (const LevelSummary& entry : levels) {
    const Variation& variation = names.variations[entry.variation];
    const StudySummary& s = entry.summary;
    std::snprintf(line,
                  sizeof line,
                  "%-11s %-8s %-17.17s %4.0f %% %4.0f %% %5.0f %%  %-9s %5s m %5s deg\n",
                  variation.name.c_str(),
                  variation.levels[entry.level].c_str(),
                  s.score.c_str(),
                  100.0 * s.recall[0],
                  100.0 * s.recall[1],
                  100.0 * s.recall[2],
                  Cell("%.3g %%", 100.0 * s.median[2]).c_str(),
                  Cell("%.1f", s.median[3]).c_str(),
                  Cell("%.1f", s.median[4]).c_str());
    text += line;
  }
  text.pop_back();
  return text;
}

}  // namespace ridgeline
