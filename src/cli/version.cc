// SPDX-License-Identifier: Apache-2.0
#include "cli/version.h"

#include <ceres/version.h>
#include <embree3/rtcore_config.h>
#include <gdal.h>
#include <proj.h>

#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include "cli/command.h"

namespace ridgeline {
namespace {

int RunVersion(const Context& context) {
  const PJ_INFO proj = proj_info();
  const nlohmann::ordered_json versions = {{"ridgeline", VersionNumber()},
                                           {"opencv", CV_VERSION},
                                           {"embree", RTC_VERSION_STRING},
                                           {"gdal", GDALVersionInfo("RELEASE_NAME")},
                                           {"proj", proj.version},
                                           {"ceres", CERES_VERSION_STRING}};
  if (context.json) {
    context.Print(versions.dump(2));
    return kExitOk;
  }
  for (const auto& [name, version] : versions.items()) {
    context.Print(name + " " + version.get<std::string>());
  }
  return kExitOk;
}

}  // namespace

void AddVersionCommand(CLI::App& app, Context& context) {
  AddCommand(app,
             context,
             {"version", "Versions of ridgeline and its libraries.", "ridgeline version --json"},
             [](Context& c) { return RunVersion(c); });
}

}  // namespace ridgeline
