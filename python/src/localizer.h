// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "input/world.h"
#include "localize/localizer.h"

namespace ridgeline::python {

// A localizer with the world that it needs.
struct OwnedLocalizer {
  OwnedLocalizer(std::shared_ptr<const World> owned, const LocalizerOptions& options)
      : world(std::move(owned)), localizer(world->model, world->dtm, options) {}

  std::shared_ptr<const World> world;
  Localizer localizer;
};

// What Python holds.
struct SharedLocalizer {
  std::shared_ptr<const OwnedLocalizer> owned;
  const Localizer& localizer() const { return owned->localizer; }
};

}  // namespace ridgeline::python
