// SPDX-License-Identifier: Apache-2.0
// What pictures show by themselves: straight lines and the skyline.
#include <pybind11/stl.h>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "cameras.h"
#include "lines/detector_table.h"
#include "lines/line_detector.h"
#include "localize/localizer.h"
#include "long_call.h"
#include "options.h"
#include "skyline/skyline_extractor.h"

namespace ridgeline::python {
namespace {

py::array Detect(py::handle image, const std::string& detector, const py::dict& set) {
  LineDetectionOptions options;
  options.detector = detector;
  SetAll(set, [&](OptionVisitor& v) { options.Visit(v); });
  CheckOptions(options, "lines");
  if (options.detector == kLinesFromFile) FindDetector(options.detector);
  const cv::Mat picture = PictureOf(image);
  std::vector<LineSegment> segments;
  {
    const LongCall call;
    segments = DetectLines(picture, options);
  }
  return ArrayOf(std::move(segments));
}

py::dict ExtractedSkyline(py::handle image, const py::dict& set) {
  SkylineOptions options;
  SetAll(set, [&](OptionVisitor& v) { options.Visit(v); });
  CheckOptions(options, "skyline");
  const cv::Mat picture = PictureOf(image);
  Skyline skyline;
  {
    const LongCall call;
    skyline = ExtractSkyline(BgrOf(picture), options);
  }
  const auto count = static_cast<py::ssize_t>(skyline.size());
  std::vector<double> x;
  std::vector<std::uint8_t> state;
  for (std::size_t i = 0; i < skyline.size(); ++i) {
    x.push_back(skyline.XOf(i));
    state.push_back(static_cast<std::uint8_t>(skyline.columns[i]));
  }
  py::dict arrays;
  arrays["x_px"] = ArrayOf(std::move(x), {count});
  arrays["y_px"] = ArrayOf(std::move(skyline.y_px), {count});
  arrays["confidence"] = ArrayOf(std::move(skyline.confidence), {count});
  arrays["state"] = ArrayOf(std::move(state), {count});
  return arrays;
}

}  // namespace

void BindPictures(py::module_& module) {
  module.def("read_picture", [](py::handle path) { return ArrayOf(PictureOf(path)); },
             py::arg("path"),
             R"(A picture as the program reads it: stored rows and columns, blue, green, red.

Returns:
    (height, width[, channels]) uint8 or uint16.
Raises:
    InputError: a file that does not decode or ends early.)");
  module.def(
      "undistort",
      [](py::handle image, py::handle camera) {
        const cv::Mat picture = PictureOf(image);
        return ArrayOf(UndistortImage(picture, CameraOf(camera)).clone());
      },
      py::arg("image"),
      py::arg("camera"),
      "The picture resampled so that camera.pinhole() describes it.");
  module.def("detect_lines", &Detect, py::arg("image"), py::arg("detector") = "lsd",
             py::arg("options") = py::dict(), R"(Straight lines of a picture.

Args:
    image: path, or (height, width[, 3 or 4]) uint8 or uint16, blue, green, red.
    detector: one of detectors(), own ones too.
    options: {"min_length_px": 12, "max_gap_px": 0, ...}, the keys of "lines".
Returns:
    (n, 5) float32: x0, y0, x1, y1 [px, the first pixel's centre is (0.5, 0.5)], strength [grey
    values / px]. The brighter side lies to the right of the way from the first end to the second.)");
  module.def("detect_skyline", &ExtractedSkyline, py::arg("image"),
             py::arg("options") = py::dict(), R"(The skyline of a picture, by column.

Returns:
    dict of x_px (n,) float64, y_px (n,) float32 (boundary between sky and the rest), confidence
    (n,) float32 in [0, 1], state (n,) uint8 (0 seen, 1 above the picture, 2 below it, 3 unknown).)");
  module.def("detectors", &DetectorNames, "Names of the line detectors, own ones last.");
}

}  // namespace ridgeline::python
