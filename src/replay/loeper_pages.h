// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "input/dataset.h"
#include "replay/loeper_figures.h"
#include "replay/loeper_replay.h"
#include "replay/replay_page.h"

namespace ridgeline {

// Fig. 2 and 3 at one pose. @param name  of the picture and the pose, e.g. "street_000, true pose".
void AddLoeperFigures(const LoeperFigures& figures, const std::string& name, ReplayPage& page);

// Fig. 5 (and its twin with rotation errors) of the first `pictures` queries, in the smallest box
// of X, Y and the widest of heading, as the paper shows it; Table 1 of all queries; samples.csv and
// results.csv.
void AddLoeperResults(const Dataset& dataset,
                      std::span<const LoeperMethod> methods,
                      std::span<const LoeperRun> runs,
                      const LoeperReplayOptions& options,
                      std::size_t pictures,
                      ReplayPage& page);

}  // namespace ridgeline
