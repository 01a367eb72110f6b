// SPDX-License-Identifier: Apache-2.0
// Cameras in COLMAP's words.
#include "cameras.h"

#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "camera/picture_camera.h"
#include "camera/picture_facts.h"
#include "input/dataset.h"
#include "input/read_picture.h"

namespace ridgeline::python {
namespace {

CameraIntrinsics Made(std::string model, int width, int height, std::vector<double> params) {
  CameraIntrinsics camera{std::move(model), width, height, std::move(params)};
  camera.Validate("", "camera");
  return camera;
}

// pycolmap's models are an enumeration, and were a text before.
std::string ModelNameOf(py::handle camera) {
  const py::object model = camera.attr("model");
  return py::str(py::hasattr(model, "name") ? py::object(model.attr("name")) : model);
}

CameraIntrinsics OfPicture(py::handle path) {
  const std::string file = py::str(py::module_::import("os").attr("fspath")(path));
  const PictureFacts facts = ReadPictureFacts(file);
  const cv::Mat stored = ReadPicture(file);
  return ridgeline::CameraOf(facts, stored.cols, stored.rows).camera;
}

py::array ImageFromCamera(const CameraIntrinsics& camera, py::handle points) {
  const auto in = DoublesOf(points, "points_in_camera", {-1, 3});
  py::array_t<double> out({in.shape(0), py::ssize_t{2}});
  const auto from = in.unchecked<2>();
  auto to = out.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < in.shape(0); ++i) {
    Eigen::Vector2d px = Eigen::Vector2d::Constant(std::nan(""));
    if (from(i, 2) > 0.0) px = camera.Distort({from(i, 0) / from(i, 2), from(i, 1) / from(i, 2)});
    to(i, 0) = px.x();
    to(i, 1) = px.y();
  }
  return out;
}

py::array CameraFromImage(const CameraIntrinsics& camera, py::handle points) {
  const auto in = DoublesOf(points, "points_px", {-1, 2});
  py::array_t<double> out({in.shape(0), py::ssize_t{2}});
  const auto from = in.unchecked<2>();
  auto to = out.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < in.shape(0); ++i) {
    const Eigen::Vector2d ray = camera.Undistort({from(i, 0), from(i, 1)});
    to(i, 0) = ray.x();
    to(i, 1) = ray.y();
  }
  return out;
}

py::array Matrix(const CameraIntrinsics& camera) {
  const PinholeCamera p = camera.Pinhole();
  return ArrayOf(std::vector<double>{p.fx, 0.0, p.cx, 0.0, p.fy, p.cy, 0.0, 0.0, 1.0}, {3, 3});
}

CameraIntrinsics PinholeOf(const CameraIntrinsics& camera) {
  const PinholeCamera p = camera.Pinhole();
  return Made("PINHOLE", p.width, p.height, {p.fx, p.fy, p.cx, p.cy});
}

}  // namespace

CameraIntrinsics CameraOf(py::handle value, const std::string& name) {
  if (py::isinstance<CameraIntrinsics>(value)) return value.cast<CameraIntrinsics>();
  for (const char* part : {"model", "width", "height", "params"}) {
    if (!py::hasattr(value, part)) {
      throw InputError("",
                       name,
                       Described(value),
                       "a ridgeline.Camera, or what has model, width, height and params");
    }
  }
  return Made(ModelNameOf(value),
              value.attr("width").cast<int>(),
              value.attr("height").cast<int>(),
              py::list(value.attr("params")).cast<std::vector<double>>());
}

void BindCameras(py::module_& module) {
  py::class_<CameraIntrinsics>(module, "Camera", R"(A camera in COLMAP's words.

Pixel (0, 0) is the upper left corner of the upper left pixel, as in COLMAP; camera axes are x
right, y down, z forward.

Args:
    model: SIMPLE_PINHOLE (f, cx, cy), PINHOLE (fx, fy, cx, cy), SIMPLE_RADIAL (f, cx, cy, k),
        RADIAL (f, cx, cy, k1, k2), OPENCV (fx, fy, cx, cy, k1, k2, p1, p2) or FULL_OPENCV (those
        and k3, k4, k5, k6).
    width, height: of the picture [px].
    params: in COLMAP's order [px; distortion has no unit].
Raises:
    InputError: an unknown model, a wrong number of parameters, or sizes that cannot be meant.)")
      .def(py::init(&Made),
           py::arg("model"),
           py::arg("width"),
           py::arg("height"),
           py::arg("params"))
      .def_static("of", [](py::handle value) { return CameraOf(value); }, py::arg("camera"),
                  "The camera that an object with model, width, height and params describes, such "
                  "as a pycolmap.Camera.")
      .def_static("from_picture", &OfPicture, py::arg("path"),
                  "The camera that a picture's EXIF tells, assumed where it does not.")
      .def_static(
          "read",
          [](py::handle path) {
            return ReadCamera(
                std::string(py::str(py::module_::import("os").attr("fspath")(path))));
          },
          py::arg("path"),
          "From a JSON file {\"model\", \"width\", \"height\", \"params\"}.")
      .def_readonly("model", &CameraIntrinsics::model)
      .def_readonly("width", &CameraIntrinsics::width)
      .def_readonly("height", &CameraIntrinsics::height)
      .def_readonly("params", &CameraIntrinsics::params)
      .def_property_readonly("has_distortion", &CameraIntrinsics::HasDistortion)
      .def("calibration_matrix", &Matrix, "K of the linear part, (3, 3) float64 [px].")
      .def("pinhole", &PinholeOf, "The linear part: the camera of the undistorted picture.")
      .def("img_from_cam", &ImageFromCamera, py::arg("points_in_camera"),
           "Distorted image points, (n, 2) float64 [px], of points (n, 3) float64 in camera axes; "
           "NaN for points behind the camera.")
      .def("cam_from_img", &CameraFromImage, py::arg("points_px"),
           "Rays (x / z, y / z), (n, 2) float64, of distorted image points (n, 2) float64 [px].")
      .def("__repr__", [](const CameraIntrinsics& c) {
        return "Camera(" + std::string(py::repr(py::cast(c.model))) + ", " +
               std::to_string(c.width) + ", " + std::to_string(c.height) + ", " +
               std::string(py::repr(py::cast(c.params))) + ")";
      });
}

}  // namespace ridgeline::python
