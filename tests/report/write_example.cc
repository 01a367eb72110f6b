// SPDX-License-Identifier: Apache-2.0
// Writes example reports for the browser test: write_example FOLDER.
#include <filesystem>
#include <limits>

#include "report/example_report.h"
#include "report/html_report.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  using ridgeline::WriteHtmlReport;
  using ridgeline::testing::ExampleReport;
  WriteHtmlReport(ExampleReport(24), folder / "bench.html");
  WriteHtmlReport(ExampleReport(1), folder / "one.html");
  WriteHtmlReport(ExampleReport(0), folder / "none.html");
  WriteHtmlReport(ExampleReport(1000), folder / "thousand.html");
  ridgeline::ReportData bare = ExampleReport(3);
  for (ridgeline::ReportRun& run : bare.runs) {
    run.photo = -1;
    run.outcome = ridgeline::ReportOutcome::kUnknown;
    run.truth.reset();
    run.translation_m.reset();
    run.rotation_deg.reset();
  }
  bare.photos.clear();
  WriteHtmlReport(bare, folder / "bare.html");
  ridgeline::ReportData abstained = ExampleReport(4);
  for (ridgeline::ReportRun& run : abstained.runs) {
    run.outcome = ridgeline::ReportOutcome::kAbstained;
    run.reason = "too few lines";
    run.result.reset();
    run.translation_m.reset();
    run.rotation_deg.reset();
  }
  WriteHtmlReport(abstained, folder / "abstained.html");
  ridgeline::ReportData study = ExampleReport(6);
  study.is_study = true;
  study.right_text = "maps have their minimum within 2 m and 2°";
  for (ridgeline::ReportRun& run : study.runs) {
    run.confidence = std::numeric_limits<double>::quiet_NaN();
    run.plots = study.plots;
  }
  study.plots.push_back({"Sensitivity",
                         "One circumstance changed.",
                         "detector",
                         "share [%]",
                         false,
                         false,
                         {"lsd", "fld"},
                         {{"evidence", {0, 1}, {80, 70}, {}, true}}});
  WriteHtmlReport(study, folder / "study.html");
}
