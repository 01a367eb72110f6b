// SPDX-License-Identifier: Apache-2.0
#include "bindings.h"

PYBIND11_MODULE(_ridgeline, module) {
  using namespace ridgeline::python;
  module.doc() = "ridgeline's library; import the package `ridgeline`, which holds all of it.";
  module.attr("__version__") = RIDGELINE_VERSION;
  BindErrors(module);
  BindOptions(module);
  BindCameras(module);
  BindPoses(module);
  BindWorld(module);
  BindDatasets(module);
  BindPictures(module);
  BindScene(module);
  BindLocalization(module);
  BindScores(module);
  BindLocalizer(module);
  BindSamplers(module);
  BindBench(module);
  BindStudy(module);
  BindTrack(module);
  BindSynth(module);
  BindOwnScores(module);
  BindOwnCues(module);
  BindOwnSamplers(module);
  BindOwnDetectors(module);
}
