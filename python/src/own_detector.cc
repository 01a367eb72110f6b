// SPDX-License-Identifier: Apache-2.0
// Line detectors written in Python: plug-ins like those of detector_table.h.
#include <list>

#include "arrays.h"
#include "bindings.h"
#include "callback.h"
#include "lines/detector_table.h"
#include "own_parts.h"

namespace ridgeline::python {
namespace {

// What register_detector() was given.
struct DetectorParts {
  py::object fn;
};

std::vector<cv::Vec4f> Detect(const cv::Mat& gray, const LineDetectionOptions& options) {
  const auto parts = OwnPartsOf<DetectorParts>().Get(options.detector);
  return WithPython([&] {
    std::vector<cv::Vec4f> lines;
    const std::vector<LineSegment> segments =
        SegmentsOf(parts->fn(ArrayOf(gray.clone())), "detector \"" + options.detector + "\"");
    // The table's detectors give pixel centres whole numbers, as OpenCV.
    for (const LineSegment& s : segments) {
      lines.push_back({s.a.x() - 0.5f, s.a.y() - 0.5f, s.b.x() - 0.5f, s.b.y() - 0.5f});
    }
    return lines;
  });
}

struct OwnDetectorPlugin {
  std::string name;
  DetectorPlugin plugin{};
};

std::string Register(py::object fn, const std::string& given_name) {
  const std::string name = NameOf(fn, given_name);
  RequireName("detector", name);
  RequireCallable("detector", fn);
  auto& parts = OwnPartsOf<DetectorParts>();
  if (!parts.Has(name)) {
    static auto* plugins = new std::list<OwnDetectorPlugin>;
    OwnDetectorPlugin& added = plugins->emplace_back();
    added.name = name;
    added.plugin = {.name = added.name.c_str(), .detect = Detect};
    try {
      AddDetector(added.plugin);
    } catch (...) {
      plugins->pop_back();
      throw;
    }
  }
  parts.Set(name, DetectorParts{std::move(fn)});
  return name;
}

}  // namespace

void BindOwnDetectors(py::module_& module) {
  module.def("register_detector", &Register, py::arg("fn"), py::kw_only(), py::arg("name") = "",
             R"(Makes a function a line detector, like those of detectors().

Localizations with {"lines.detector": NAME} and detect_lines() use it; directions, short segments and
joints are seen to as for the others.

Args:
    fn: fn(gray) -> (n, 4) or (n, 5) float32 or float64: x0, y0, x1, y1 [px, the first pixel's
        centre is (0.5, 0.5)]; gray is (height, width) uint8.
    name: None: the function's own.
Returns:
    The name. A name registered again stands for the new function.)");
}

}  // namespace ridgeline::python
