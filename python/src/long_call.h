// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include "base/stop.h"

namespace ridgeline::python {

// While one lives the calling thread works in the library, and other Python threads go on: no
// Python object may be touched. Ctrl-C ends the work between two of its parts, with
// KeyboardInterrupt.
class LongCall {
 public:
  LongCall();

 private:
  pybind11::gil_scoped_release unlocked_;
  StopCheck check_;
};

}  // namespace ridgeline::python
