// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/bench.h"
#include "input/dataset.h"
#include "input/picture_input.h"
#include "input/read_picture.h"
#include "input/world.h"
#include "localize/localizer.h"

namespace ridgeline {

// One picture to be localized: what `ridgeline localize` and the Python package do, with the same
// results.
struct LocalizeTask {
  Dataset dataset;  // of one query
  LocalizerOptions options;
  // Turns the picture's own magnetic heading [deg], east positive; absent: by the World Magnetic
  // Model.
  std::optional<double> declination_deg;
  // Segments of another detector, for options.lines.detector = "file"; empty: the query's.
  std::string lines;

  const Query& query() const { return dataset.queries.front(); }
  Query& query() { return dataset.queries.front(); }
};

// Gives the query the camera and the prior that its picture tells where it has none, widens the
// search to how far a picture's own prior may be off, and notes all that among the query's
// assumptions. Throws InputError if neither gives a position, and for a declination without use.
void CompleteTask(LocalizeTask& task, PictureReader& pictures);

// The world around the task's prior; of one without a terrain model it notes what stands for it.
World ReadWorldOf(LocalizeTask& task);

// Throws InputError if there is no place for a camera in the search box: said before the search,
// since the user can mend it.
void CheckPlace(const LocalizeTask& task, const Localizer& localizer);

// Localizes the completed task.
BenchRun RunTask(const LocalizeTask& task,
                 const Localizer& localizer,
                 std::uint64_t seed,
                 int threads,
                 PictureReader& pictures);

}  // namespace ridgeline
