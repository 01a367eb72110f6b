// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "report/report_data.h"

namespace ridgeline {

// One HTML file that opens offline: summary, plots, and a gallery of the runs, failures first.
// Photos are scaled so that a report of a thousand queries still opens. Texts are data: nothing in
// them is taken for markup.
std::string HtmlReport(const ReportData& data);

// Writes it, whole or not at all. Throws InputError if the file cannot be written.
void WriteHtmlReport(const ReportData& data, const std::filesystem::path& path);

// Whether this build has the plotting library embedded.
bool ReportHasPlots();

}  // namespace ridgeline
