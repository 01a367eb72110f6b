// SPDX-License-Identifier: Apache-2.0
#include "batch.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <cmath>

#include "arrays.h"
#include "base/error.h"
#include "callback.h"
#include "camera/intrinsics.h"

namespace ridgeline::python {
namespace {

const Batch& Open(const Batch& batch) {
  if (batch.picture != nullptr) return batch;
  throw InputError("", "batch", "used after its call", "arrays taken from it during the call");
}

const PreparedFor& Open(const PreparedFor& picture) {
  if (picture.picture != nullptr) return picture;
  throw InputError("", "picture", "used after its call", "arrays taken from it during the call");
}

CameraIntrinsics CameraOfPicture(const PictureEvidence& picture) {
  const PinholeCamera& p = picture.camera();
  return {"PINHOLE", p.width, p.height, {p.fx, p.fy, p.cx, p.cy}};
}

py::array Rotations(const Batch& batch) {
  std::vector<double> values;
  for (const Pose& pose : Open(batch).poses) {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> r = pose.cam_from_world.toRotationMatrix();
    values.insert(values.end(), r.data(), r.data() + 9);
  }
  return ArrayOf(std::move(values), {static_cast<py::ssize_t>(batch.poses.size()), 3, 3});
}

py::array Quaternions(const Batch& batch) {
  std::vector<double> values;
  for (const Pose& pose : Open(batch).poses) {
    const Eigen::Vector4d& q = pose.cam_from_world.coeffs();
    values.insert(values.end(), {q.x(), q.y(), q.z(), q.w()});
  }
  return ArrayOf(std::move(values), {static_cast<py::ssize_t>(batch.poses.size()), 4});
}

Eigen::Vector3d Center(const Batch& batch) {
  return Open(batch).poses.front().center_in_world + batch.scene->model().origin_in_world;
}

void Project(const Batch& batch,
             std::vector<float>& rows,
             std::vector<std::int32_t>& pose_of,
             std::vector<std::uint8_t>& kinds) {
  std::vector<ProjectedSegment> segments;
  for (std::size_t i = 0; i < batch.poses.size(); ++i) {
    ProjectPieces(batch.view->visible, batch.picture->camera(), batch.poses[i], segments);
    for (const ProjectedSegment& s : segments) {
      rows.insert(rows.end(), {s.a.x(), s.a.y(), s.b.x(), s.b.y()});
      pose_of.push_back(static_cast<std::int32_t>(i));
      kinds.push_back(static_cast<std::uint8_t>(batch.view->kinds[s.piece]));
    }
  }
}

// The visible edges in the picture of every pose, one below the other.
py::tuple Segments(const Batch& batch) {
  std::vector<float> rows;
  std::vector<std::int32_t> pose_of;
  std::vector<std::uint8_t> kinds;
  {
    const Batch& open = Open(batch);
    const py::gil_scoped_release unlocked;
    Project(open, rows, pose_of, kinds);
  }
  const auto count = static_cast<py::ssize_t>(pose_of.size());
  return py::make_tuple(ArrayOf(std::move(rows), {count, 4}),
                        ArrayOf(std::move(pose_of), {count}),
                        ArrayOf(std::move(kinds), {count}));
}

py::array SkylineDirections(const Batch& batch) {
  std::vector<float> values;
  for (const Eigen::Vector3f& d : Open(batch).view->skyline) {
    values.insert(values.end(), {d.x(), d.y(), d.z()});
  }
  return ArrayOf(std::move(values), {static_cast<py::ssize_t>(batch.view->skyline.size()), 3});
}

template <typename T>
void CopyTo(const py::array& array, std::span<double> values) {
  const T* from = static_cast<const T*>(array.data());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(from[i]);
}

void CopyResult(py::handle result, const std::string& name, std::span<double> values) {
  const std::string expected = "(" + std::to_string(values.size()) + ",) float64";
  py::array array = py::array::ensure(result);
  if (!array) {
    PyErr_Clear();
    throw InputError("", name, "a result " + Described(result), expected);
  }
  array = py::array::ensure(array, py::array::c_style);
  const bool is_double = py::isinstance<py::array_t<double>>(array);
  const bool is_float = py::isinstance<py::array_t<float>>(array);
  if (array.ndim() != 1 || array.shape(0) != static_cast<py::ssize_t>(values.size()) ||
      !(is_double || is_float)) {
    throw InputError("", name, "a result " + Described(array), expected);
  }
  if (is_double) {
    CopyTo<double>(array, values);
  } else {
    CopyTo<float>(array, values);
  }
  for (const double value : values) {
    if (std::isnan(value)) {
      throw InputError("", name, "nan in a result", "numbers; -inf: nothing of the model in view");
    }
  }
}

}  // namespace

void CallWithBatch(py::handle fn, Batch batch, const std::string& name, std::span<double> values) {
  WithPython([&] {
    const auto lent = std::make_shared<Batch>(std::move(batch));
    const auto close = [&] { *lent = Batch{}; };
    try {
      CopyResult(fn(py::cast(lent)), name, values);
    } catch (...) {
      close();
      throw;
    }
    close();
  });
}

py::object CallPrepare(py::handle prepare, const PreparedFor& picture) {
  if (prepare.is_none()) return py::none();
  const auto lent = std::make_shared<PreparedFor>(picture);
  py::object prepared = prepare(py::cast(lent));
  *lent = PreparedFor{};
  return prepared;
}

void BindBatch(py::module_& module) {
  py::class_<PreparedFor, std::shared_ptr<PreparedFor>>(
      module, "PictureView", "The picture that an own score or cue is made for; lent for one call.")
      .def_property_readonly(
          "bgr", [](const PreparedFor& p) { return ArrayOf(Open(p).picture->bgr().clone()); },
          "(height, width, 3) uint8: the reduced, undistorted picture.")
      .def_property_readonly(
          "foliage",
          [](const PreparedFor& p) { return ArrayOf(Open(p).picture->foliage().clone()); },
          "(height, width) uint8, 255 where leaves hide what is behind.")
      .def_property_readonly(
          "lines", [](const PreparedFor& p) { return ArrayOf(Open(p).picture->segments()); },
          "(n, 5) float32: x0, y0, x1, y1 [px], strength.")
      .def_property_readonly(
          "camera", [](const PreparedFor& p) { return CameraOfPicture(*Open(p).picture); });
  py::class_<Batch, std::shared_ptr<Batch>>(module, "Batch", R"(Poses of one place to be judged; lent for one call.

The arrays it gives are copies and may be kept.)")
      .def("__len__", [](const Batch& b) { return Open(b).poses.size(); })
      .def_property_readonly("prepared", [](const Batch& b) { return Open(b).prepared; },
                             "What prepare() returned for this picture; None without one.")
      .def_property_readonly("center", &Center, "(3,) float64: the place, world [m].")
      .def_property_readonly("rotations", &Rotations,
                             "(n, 3, 3) float64: cam_from_world of each pose.")
      .def_property_readonly("quats_xyzw", &Quaternions, "(n, 4) float64.")
      .def("segments", &Segments, R"(The model's visible edges in the picture under every pose.

Returns:
    (segments (m, 4) float32 x0, y0, x1, y1 [px], pose (m,) int32 index of the pose in this batch,
    rising, kind (m,) uint8 index into EDGE_KINDS).)")
      .def_property_readonly("skyline_directions", &SkylineDirections,
                             "(k, 3) float32: unit vectors (east, north, height) to the model's "
                             "skyline, by azimuth.")
      .def_property_readonly(
          "camera", [](const Batch& b) { return CameraOfPicture(*Open(b).picture); });
}

}  // namespace ridgeline::python
