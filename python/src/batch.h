// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "projection/scene.h"
#include "score/picture_evidence.h"
#include "score/position_view.h"

namespace ridgeline::python {

namespace py = pybind11;

// What an own score or cue is called with: poses at one place, and what is seen from there. Lent
// for one call; the arrays that it gives are copies, which may be kept.
struct Batch {
  const PictureEvidence* picture = nullptr;  // null: the call is over
  const Scene* scene = nullptr;
  const PositionView* view = nullptr;
  std::span<const Pose> poses;  // local frame
  py::object prepared;
};

// What prepare() of an own score or cue is called with; lent likewise.
struct PreparedFor {
  const PictureEvidence* picture = nullptr;
  const Scene* scene = nullptr;
};

// Calls fn(batch) and copies what it returns, (poses,) floating point, to `values`. Takes the
// interpreter's lock. Throws CallbackFailure: what fn raised, or an InputError naming `name`.
void CallWithBatch(py::handle fn, Batch batch, const std::string& name, std::span<double> values);

// Calls prepare(picture), if it is no None; likewise.
py::object CallPrepare(py::handle prepare, const PreparedFor& picture);

void BindBatch(py::module_& module);

}  // namespace ridgeline::python
