// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "base/option_groups.h"
#include "projection/scene.h"
#include "score/picture_evidence.h"
#include "score/score.h"
#include "score/score_options.h"

namespace ridgeline {

// What a score is made for; must outlive it.
struct ScoreContext {
  const PictureEvidence& picture;
  const Scene& scene;
  const ScoreOptions& options;
};

// How a score joins the table (score_table.cc). It is documented beside its class, with its source.
struct ScorePlugin {
  const char* name;                // what ScoreOptions::name calls it
  void (*declare)(OptionGroups&);  // adds its options
  std::unique_ptr<Score> (*make)(const ScoreContext&);
};

}  // namespace ridgeline
