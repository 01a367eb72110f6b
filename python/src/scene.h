// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "projection/scene.h"

namespace ridgeline::python {

// A scene whose pointer keeps all that it needs alive.
struct SharedScene {
  std::shared_ptr<const Scene> scene;
};

}  // namespace ridgeline::python
