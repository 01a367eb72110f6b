// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

// The Python module, one topic a file. Each function adds its topic to the module; the order in
// module.cc is that of the types that later topics use.
namespace ridgeline::python {

namespace py = pybind11;

void BindErrors(py::module_& module);
void BindOptions(py::module_& module);
void BindCameras(py::module_& module);
void BindPoses(py::module_& module);
void BindWorld(py::module_& module);
void BindDatasets(py::module_& module);
void BindPictures(py::module_& module);
void BindScene(py::module_& module);
void BindLocalization(py::module_& module);
void BindLocalizer(py::module_& module);
void BindScores(py::module_& module);
void BindSamplers(py::module_& module);
void BindBench(py::module_& module);
void BindStudy(py::module_& module);
void BindTrack(py::module_& module);
void BindSynth(py::module_& module);
void BindOwnScores(py::module_& module);
void BindOwnCues(py::module_& module);
void BindOwnSamplers(py::module_& module);
void BindOwnDetectors(py::module_& module);

}  // namespace ridgeline::python
