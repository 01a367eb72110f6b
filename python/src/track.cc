// SPDX-License-Identifier: Apache-2.0
// Poses of the frames of a sequence, corrected by their skylines.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "cameras.h"
#include "localize/localizer.h"
#include "long_call.h"
#include "options.h"
#include "poses.h"
#include "scene.h"
#include "track/skyline_tracker.h"

namespace ridgeline::python {
namespace {

struct OwnedTracker {
  std::shared_ptr<const Scene> scene;
  SkylineTracker tracker;
};

std::unique_ptr<OwnedTracker> Made(const SharedScene& scene, const py::dict& set) {
  SkylineTrackOptions options;
  SetAll(set, [&options](OptionVisitor& v) { options.Visit(v); });
  CheckOptions(options);
  if (options.extractor == "file") {
    throw InputError("", "extractor", "\"file\"", "path or canny; `ridgeline skyline` reads files");
  }
  return std::unique_ptr<OwnedTracker>(
      new OwnedTracker{scene.scene, SkylineTracker(*scene.scene, options)});
}

py::dict Track(OwnedTracker& self, py::handle image, py::handle camera, py::handle sensors) {
  const Eigen::Vector3d origin = self.scene->model().origin_in_world;
  const cv::Mat picture = PictureOf(image);
  const CameraIntrinsics intrinsics = CameraOf(camera);
  Pose start = PoseOf(sensors, "sensors");
  start.center_in_world -= origin;
  SkylineFrame frame;
  {
    const LongCall call;
    frame = self.tracker.Track(
        UndistortImage(BgrOf(picture), intrinsics), intrinsics.Pinhole(), start);
  }
  const auto in_world = [&](Pose pose) {
    pose.center_in_world += origin;
    return pose;
  };
  py::dict result;
  result["status"] = NameOf(frame.match.status);
  result["reason"] = frame.match.reason;
  result["pose"] = frame.match.pose ? py::cast(in_world(*frame.match.pose)) : py::none();
  result["best"] = in_world(frame.match.best);
  result["heading_sigma_deg"] = frame.match.heading_sigma_deg;
  result["distance_px"] =
      py::make_tuple(frame.by_sensors.used_px, frame.at_best.used_px);
  result["milliseconds"] = frame.times.Total();
  return result;
}

}  // namespace

void BindTrack(py::module_& module) {
  py::class_<OwnedTracker>(module, "SkylineTracker", R"(Corrects poses of a sequence by the skyline, frame by frame.

Keeps what it learned from the last frame; not thread-safe.

Args:
    scene: Scene, which is kept.
    options: keys of `ridgeline skyline`'s configuration, e.g. {"match.method": "3d"}.)")
      .def(py::init(&Made), py::arg("scene"), py::arg("options") = py::dict())
      .def("track", &Track, py::arg("image"), py::arg("camera"), py::arg("sensors"),
           R"(The pose of the next frame.

Args:
    image: path, or (height, width[, 3 or 4]) uint8 or uint16, blue, green, red.
    camera: Camera.
    sensors: Pose by the sensors, world frame.
Returns:
    dict of status ("ok" or why not), reason, pose (None unless "ok"), best (Pose, believed or not),
    heading_sigma_deg, distance_px (before, after) at 640 px, milliseconds.)");
}

}  // namespace ridgeline::python
