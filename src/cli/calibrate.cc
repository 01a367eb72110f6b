// SPDX-License-Identifier: Apache-2.0
#include "cli/calibrate.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "calibrate/checkerboard.h"
#include "cli/command.h"
#include "cli/frame_source.h"
#include "cli/out_folder.h"
#include "cli/progress.h"

namespace ridgeline {
namespace {

struct CalibrateArguments {
  std::string frames;
  std::string board = "9x6";
  std::string out;
  int every = 0;  // 0: so that some 150 frames are looked at
  CheckerboardOptions options;
};

void ParseBoard(const std::string& text, CheckerboardOptions& options) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &options.columns, &options.rows, &end) != 2 ||
      static_cast<std::size_t>(end) != text.size()) {
    throw InputError("--board", "", '"' + text + '"', "inner corners, e.g. 9x6");
  }
}

int RunCalibrate(CalibrateArguments arguments, const Context& context) {
  ParseBoard(arguments.board, arguments.options);
  arguments.options.Validate();
  CheckFileToWrite("--out", arguments.out);
  const std::unique_ptr<FrameSource> source = OpenFrames(arguments.frames);
  constexpr std::size_t kFrames = 150;
  const std::size_t step =
      arguments.every > 0 ? static_cast<std::size_t>(arguments.every)
                          : std::max<std::size_t>(1, source->size() / kFrames);
  std::vector<BoardView> views;
  cv::Size size;
  {
    Progress progress(context, "Looking for the board", (source->size() + step - 1) / step, "frames");
    for (std::size_t i = 0; i < source->size(); i += step) {
      const cv::Mat picture = source->Read(i);
      progress.Advance();
      if (picture.empty()) continue;
      if (size.empty()) size = picture.size();
      if (picture.size() != size) {
        throw InputError(source->id(i), "", "a picture of another size", "one size of all frames");
      }
      if (auto view = FindBoard(picture, source->id(i), arguments.options)) {
        views.push_back(std::move(*view));
      }
    }
  }
  const Calibration found = CalibrateCamera(views, size.width, size.height, arguments.options);
  const nlohmann::ordered_json camera = {{"model", found.camera.model},
                                         {"width", found.camera.width},
                                         {"height", found.camera.height},
                                         {"params", found.camera.params}};
  WriteFileAtomically(arguments.out, camera.dump(2) + "\n");
  constexpr double kGoodCover = 0.6;
  if (found.covered < kGoodCover) {
    context.Warn("the board covers little of the picture: its corners' distortion is a guess");
  }
  if (context.json) {
    context.Print(nlohmann::ordered_json{{"camera", camera},
                                         {"rms_px", found.rms_px},
                                         {"sigma_px", found.sigma_px},
                                         {"covered", found.covered},
                                         {"frames", found.frames},
                                         {"frame_rms_px", found.frame_rms_px}}
                      .dump(2));
    return kExitOk;
  }
  char line[200];
  std::snprintf(line,
                sizeof line,
                ": %s, %zu of %zu boards, %.2f px rms, focal length %.1f px (sigma %.1f px), the "
                "board covers %.0f %% of the picture",
                found.camera.model.c_str(),
                found.frames.size(),
                views.size(),
                found.rms_px,
                found.camera.params[0],
                found.sigma_px[0],
                100.0 * found.covered);
  context.Print(arguments.out + line);
  return kExitOk;
}

}  // namespace

void AddCalibrateCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = AddCommand(
      app,
      context,
      {"calibrate",
       "Makes a camera file from a film or pictures of a checkerboard.",
       "ridgeline calibrate board.mp4 --board 9x6 --out camera.json"},
      [arguments](Context& c) { return RunCalibrate(*arguments, c); });
  command->add_option("frames", arguments->frames, "Film, or folder of pictures")->required();
  command->add_option("--board", arguments->board, "Inner corners of the board, across x down")
      ->capture_default_str()
      ->type_name("CxR");
  command->add_option("--lens", arguments->options.model, "opencv (k1 k2 p1 p2), radial or pinhole")
      ->capture_default_str();
  command->add_option("--views", arguments->options.max_views, "Most frames used")
      ->capture_default_str();
  command->add_option("--every", arguments->every, "Every how many frames are looked at [auto]")
      ->check(CLI::Range(1, 100000));
  command->add_option("--out", arguments->out, "Camera file to write (JSON)")
      ->required()
      ->type_name("FILE");
}

}  // namespace ridgeline
