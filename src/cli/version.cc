// SPDX-License-Identifier: Apache-2.0
#include "cli/version.h"

#include <ceres/version.h>
#include <embree3/rtcore_config.h>
#include <gdal.h>
#include <proj.h>

#include <Eigen/Core>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/version_text.h"

namespace ridgeline {
namespace {

struct Library {
  std::string name;
  std::string version;
  std::string licence;  // SPDX
  std::string use;
};

std::string Joined(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

// What the program is linked with, as it was built or is at hand; licences as the projects state
// them.
std::vector<Library> Libraries() {
  const PJ_INFO proj = proj_info();
  return {
      {"opencv", CV_VERSION, "Apache-2.0", "pictures, line detectors"},
      {"embree", RTC_VERSION_STRING, "Apache-2.0", "rays"},
      {"gdal", GDALVersionInfo("RELEASE_NAME"), "MIT", "rasters, stores, web"},
      {"proj", proj.version, "MIT", "reference systems"},
      {"ceres", CERES_VERSION_STRING, "BSD-3-Clause", "least squares"},
      {"eigen",
       Joined(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION),
       "MPL-2.0",
       "linear algebra"},
      {"pagmo", RIDGELINE_PAGMO_VERSION, "LGPL-3.0-or-later OR GPL-3.0-or-later", "samplers"},
      {"nlohmann_json",
       Joined(
           NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH),
       "MIT",
       "JSON"},
      {"cli11", CLI11_VERSION, "BSD-3-Clause", "command line"},
      {"expat", RIDGELINE_EXPAT_VERSION, "MIT", "XML"},
      {"zlib", RIDGELINE_ZLIB_VERSION, "Zlib", "unpacking"},
      {"plotly.js", "", "MIT", "plots of reports, where npm was at hand"}};
}

// The libraries whose versions results depend on.
constexpr std::size_t kShort = 5;

int RunVersion(const Context& context, bool verbose) {
  const std::vector<Library> libraries = Libraries();
  nlohmann::ordered_json json = {{"ridgeline", VersionNumber()}};
  std::string text =
      VersionText() + (verbose ? "  Apache-2.0" : "");
  for (std::size_t i = 0; i < (verbose ? libraries.size() : kShort); ++i) {
    const Library& library = libraries[i];
    text += "\n" + library.name;
    if (!library.version.empty()) text += " " + library.version;
    if (verbose) {
      text += "  " + library.licence + "  (" + library.use + ")";
      json["libraries"].push_back({{"name", library.name},
                                   {"version", library.version},
                                   {"licence", library.licence},
                                   {"use", library.use}});
    } else {
      json[library.name] = library.version;
    }
  }
  context.Print(context.json ? json.dump(2) : text);
  return kExitOk;
}

}  // namespace

void AddVersionCommand(CLI::App& app, Context& context) {
  auto verbose = std::make_shared<bool>(false);
  CLI::App* command = AddCommand(
      app,
      context,
      {"version", "Versions of ridgeline and its libraries.", "ridgeline version --verbose"},
      [verbose](Context& c) { return RunVersion(c, *verbose); });
  command->add_flag("--verbose", *verbose, "All libraries, with their licences");
}

}  // namespace ridgeline
