// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace ridgeline::web {

// Files of web/ and of the npm packages named in web/package.json, embedded by
// cmake/EmbedText.cmake.
extern const std::string_view kReportBody;
extern const std::string_view kReportCss;
extern const std::string_view kReportJs;
extern const std::string_view kReportPlotsJs;
extern const std::string_view kReportDetailJs;
extern const std::string_view kPlotly;  // empty in a build without npm
extern const std::string_view kPlotlyLicense;

}  // namespace ridgeline::web
