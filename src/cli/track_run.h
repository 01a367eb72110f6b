// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cli/command.h"
#include "cli/context.h"
#include "cli/track_input.h"
#include "localize/localizer_options.h"
#include "track/track_options.h"
#include "track/track_smoother.h"

namespace ridgeline {

// Everything that `ridgeline track` is told.
struct TrackRequest {
  TrackArguments input;
  std::string out;      // folder
  std::string report;   // HTML file
  std::string film;     // .mp4 or .webm
  std::string nmea;     // file, "-": standard output
  std::string jsonl;    // the same
  std::uint64_t seed = 1;
  ConfigArguments config;
  LocalizerOptions localizer;
  TrackOptions track;
  SmootherOptions smoother;
  SensorOptions sensors;

  void Visit(OptionVisitor& v);
};

// Tracks, and writes what was asked for. Returns the exit code: abstained if no frame was tracked.
int RunTrack(TrackRequest& request, const Context& context);

}  // namespace ridgeline
