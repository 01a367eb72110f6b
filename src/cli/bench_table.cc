// SPDX-License-Identifier: Apache-2.0
#include "cli/bench_table.h"

#include <cmath>
#include <cstdio>

#include "base/atomic_file.h"
#include "eval/bench_files.h"

namespace ridgeline {
namespace {

std::string ShareText(const char* name, const RunShare& share) {
  char text[100];
  std::snprintf(text,
                sizeof(text),
                "%s %.1f %% (%.1f to %.1f)",
                name,
                100.0 * share.share,
                100.0 * share.ci95.lower,
                100.0 * share.ci95.upper);
  return text;
}

}  // namespace

std::string TableOf(const Summary& summary, const Protocol& protocol) {
  std::string text;
  char line[160];
  if (!protocol.HasRecall()) {
    text = "No right answer is in the search box: recall is not defined.\n";
    if (summary.runs > 0) {
      std::snprintf(line,
                    sizeof(line),
                    "found by widening, within 2 m and 2 deg: %.1f %%; ",
                    100.0 * summary.recall[2]);
      text += line + ShareText("confident and wrong", summary.confident_wrong) + "\n";
    }
  } else if (summary.runs == 0) {
    text = "No query has a truth: recall and errors are not known.\n";
  } else {
    text = "            recall   95 % interval   among the answered\n";
    for (std::size_t t = 0; t < kRecallThresholds.size(); ++t) {
      std::snprintf(line,
                    sizeof(line),
                    "%-10s %6.1f %%   %5.1f to %5.1f   %6.1f %%\n",
                    kRecallThresholds[t].name,
                    100.0 * summary.recall[t],
                    100.0 * summary.recall_ci95[t].lower,
                    100.0 * summary.recall_ci95[t].upper,
                    100.0 * summary.recall_answered[t]);
      text += line;
    }
    std::snprintf(line,
                  sizeof(line),
                  "median error %.2f m, %.2f deg\n",
                  summary.translation_m.median,
                  summary.rotation_deg.median);
    text += line;
  }
  if (summary.searched == 0) {
    return text + ShareText("without a pose", summary.abstained) + ", " +
           std::to_string(summary.judged) + " with an energy of our score";
  }
  text += ShareText("confident (>= 0.9)", summary.confident) + ", " +
          ShareText("doubtful", summary.doubtful) + ", " +
          ShareText("abstained", summary.abstained) + "\n";
  std::snprintf(line,
                sizeof(line),
                "%.2f s per query (median), %.0f poses/s",
                summary.seconds_median,
                summary.evaluations_per_second);
  return text + line;
}

void WriteBenchTables(const BenchTitle& title,
                      const std::vector<RunRecord>& records,
                      const Eigen::Vector3d& origin,
                      const std::filesystem::path& out,
                      const Context& context) {
  const Protocol& protocol = title.protocol;
  const std::string summary = SummaryJson(title.dataset, title.config, protocol, records);
  if (!out.empty()) {
    WriteFileAtomically(out / "results.csv", ResultsCsv(records));
    WriteFileAtomically(out / "evidence.csv", EvidenceCsv(records));
    WriteFileAtomically(out / "poses.txt", PosesText(records, origin));
    WriteFileAtomically(out / "summary.json", summary);
  }
  if (context.json) {
    context.Print(summary);
    return;
  }
  const Summary figures = Summarize(records);
  context.Print(title.dataset + ": " + std::to_string(figures.queries) + " queries, " +
                std::to_string(figures.all_runs) + " runs, " + std::to_string(figures.runs) +
                " with truth");
  context.Print("protocol " + protocol.name + ": " + protocol.words);
  context.Print(TableOf(figures, protocol));
  if (!out.empty()) context.Print("written to " + out.string());
}

}  // namespace ridgeline
