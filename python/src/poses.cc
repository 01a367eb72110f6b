// SPDX-License-Identifier: Apache-2.0
// Poses as in pycolmap: cam_from_world, quaternions in the order x, y, z, w.
#include "poses.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstdio>
#include <tuple>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "eval/metrics.h"

namespace ridgeline::python {
namespace {

using Rotation = Eigen::Quaterniond;

// A unit quaternion as it is to the last bit; one that is off by rounding made one.
Rotation RotationOf(const double* xyzw, const std::string& name) {
  const Rotation q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  const double norm = q.norm();
  if (std::abs(norm - 1.0) > 1e-3) {
    throw InputError("", name, "a length of " + std::to_string(norm), "a unit quaternion x, y, z, w");
  }
  return std::abs(norm - 1.0) < 1e-9 ? q : q.normalized();
}

Eigen::Vector3d VectorOf(py::handle value, const std::string& name) {
  const auto array = DoublesOf(value, name, {3});
  return Eigen::Map<const Eigen::Vector3d>(array.data());
}

Pose MadePose(py::handle quat_xyzw, py::handle center, py::handle translation) {
  if (center.is_none() == translation.is_none()) {
    throw InputError("",
                     "pose",
                     center.is_none() ? "neither center nor translation" : "center and translation",
                     "one of the two");
  }
  Pose pose;
  pose.cam_from_world = RotationOf(DoublesOf(quat_xyzw, "quat_xyzw", {4}).data(), "quat_xyzw");
  pose.center_in_world = center.is_none() ? Eigen::Vector3d(-(pose.cam_from_world.conjugate() *
                                                              VectorOf(translation, "translation")))
                                          : VectorOf(center, "center");
  return pose;
}

Pose FromAngles(py::handle center, double heading_deg, double pitch_deg, double roll_deg) {
  for (const double angle : {heading_deg, pitch_deg, roll_deg}) {
    if (!std::isfinite(angle)) {
      throw InputError("", "angles", std::to_string(angle), "finite numbers [deg]");
    }
  }
  return {CamFromWorld(ViewAngles{heading_deg, pitch_deg, roll_deg}), VectorOf(center, "center")};
}

Eigen::Matrix<double, 3, 4> MatrixOf(const Pose& pose) {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << pose.cam_from_world.toRotationMatrix(), pose.ColmapTranslation();
  return matrix;
}

std::shared_ptr<PoseList> MadePoses(py::handle quats, py::handle centers) {
  const auto q = DoublesOf(quats, "quats_xyzw", {-1, 4});
  const auto c = DoublesOf(centers, "centers", {q.shape(0), 3});
  auto poses = std::make_shared<PoseList>(static_cast<std::size_t>(q.shape(0)));
  for (std::size_t i = 0; i < poses->size(); ++i) {
    (*poses)[i] = {RotationOf(q.data() + 4 * i, "quats_xyzw[" + std::to_string(i) + "]"),
                   Eigen::Map<const Eigen::Vector3d>(c.data() + 3 * i)};
  }
  return poses;
}

std::shared_ptr<PoseList> PosesFromAngles(py::handle centers, py::handle angles) {
  const auto c = DoublesOf(centers, "centers", {-1, 3});
  const auto a = DoublesOf(angles, "angles_deg", {c.shape(0), 3});
  auto poses = std::make_shared<PoseList>(static_cast<std::size_t>(c.shape(0)));
  for (std::size_t i = 0; i < poses->size(); ++i) {
    const double* angle = a.data() + 3 * i;
    (*poses)[i] = {CamFromWorld(ViewAngles{angle[0], angle[1], angle[2]}),
                   Eigen::Map<const Eigen::Vector3d>(c.data() + 3 * i)};
  }
  return poses;
}

py::array AnglesOf(const PoseList& poses) {
  std::vector<double> angles;
  for (const Pose& pose : poses) {
    const ViewAngles view = ViewAnglesOf(pose.cam_from_world);
    angles.insert(angles.end(), {view.heading_deg, view.pitch_deg, view.roll_deg});
  }
  return ArrayOf(std::move(angles), {static_cast<py::ssize_t>(poses.size()), 3});
}

py::array TranslationsOf(const PoseList& poses) {
  std::vector<double> translations;
  for (const Pose& pose : poses) {
    const Eigen::Vector3d t = pose.ColmapTranslation();
    translations.insert(translations.end(), {t.x(), t.y(), t.z()});
  }
  return ArrayOf(std::move(translations), {static_cast<py::ssize_t>(poses.size()), 3});
}

py::array ErrorsOf(const PoseList& poses, const Pose& truth) {
  std::vector<double> errors;
  for (const Pose& pose : poses) {
    const PoseError error = ErrorOf(pose, truth);
    errors.insert(errors.end(), {error.translation_m, error.horizontal_m, error.rotation_deg});
  }
  return ArrayOf(std::move(errors), {static_cast<py::ssize_t>(poses.size()), 3});
}

Pose Item(const PoseList& poses, py::ssize_t index) {
  const auto size = static_cast<py::ssize_t>(poses.size());
  if (index < 0) index += size;
  if (index < 0 || index >= size) throw py::index_error();
  return poses[static_cast<std::size_t>(index)];
}

std::string ReprOf(const Pose& pose) {
  const ViewAngles view = ViewAnglesOf(pose.cam_from_world);
  char text[200];
  std::snprintf(text,
                sizeof text,
                "Pose(east %.2f, north %.2f, height %.2f m; heading %.2f, pitch %.2f, roll %.2f deg)",
                pose.center_in_world.x(),
                pose.center_in_world.y(),
                pose.center_in_world.z(),
                view.heading_deg,
                view.pitch_deg,
                view.roll_deg);
  return text;
}

void BindPose(py::module_& module) {
  py::class_<Pose>(module, "Pose", R"(A pose in the world frame: cam_from_world, as in pycolmap.

World: easting, northing, height [m] of the model's system. Camera axes: x right, y down, z
forward: x_cam = R (x_world - center) = R x_world + translation. Quaternions are unit quaternions
in the order x, y, z, w, as pycolmap's Rotation3d.quat. Heading is clockwise from grid north, pitch
up, roll clockwise seen from behind the camera [deg].

Args:
    quat_xyzw: (4,) float64.
    center: (3,) float64, the projection centre [m]; or
    translation: (3,) float64, COLMAP's [m].
Raises:
    InputError: wrong shapes or dtypes, numbers that are not finite, no unit quaternion.)")
      .def(py::init(&MadePose),
           py::arg("quat_xyzw"),
           py::kw_only(),
           py::arg("center") = py::none(),
           py::arg("translation") = py::none())
      .def_static("from_view_angles", &FromAngles, py::arg("center"), py::arg("heading_deg"),
                  py::arg("pitch_deg") = 0.0, py::arg("roll_deg") = 0.0)
      .def_static("of", [](py::handle value) { return PoseOf(value); }, py::arg("rigid3d"),
                  "Of an object with rotation.quat (x, y, z, w) and translation, such as a "
                  "pycolmap.Rigid3d that is cam_from_world.")
      .def_property_readonly(
          "quat_xyzw",
          [](const Pose& p) -> Eigen::Vector4d { return p.cam_from_world.coeffs(); },
          "(4,) float64: x, y, z, w of cam_from_world.")
      .def_property_readonly(
          "center", [](const Pose& p) { return p.center_in_world; }, "(3,) float64 [m].")
      .def_property_readonly("translation", &Pose::ColmapTranslation,
                             "(3,) float64 [m]: x_cam = R x_world + translation.")
      .def_property_readonly(
          "heading_deg", [](const Pose& p) { return ViewAnglesOf(p.cam_from_world).heading_deg; })
      .def_property_readonly(
          "pitch_deg", [](const Pose& p) { return ViewAnglesOf(p.cam_from_world).pitch_deg; })
      .def_property_readonly(
          "roll_deg", [](const Pose& p) { return ViewAnglesOf(p.cam_from_world).roll_deg; })
      .def_property_readonly(
          "omega_phi_kappa_deg",
          [](const Pose& p) {
            const OmegaPhiKappa a = OmegaPhiKappaOf(p.cam_from_world);
            return std::make_tuple(a.omega_deg, a.phi_deg, a.kappa_deg);
          },
          "Photogrammetric angles as Pix4D, Metashape and ODM write them.")
      .def("matrix", &MatrixOf, "cam_from_world, (3, 4) float64, as pycolmap's Rigid3d.matrix().")
      .def(
          "error",
          [](const Pose& pose, const Pose& truth) {
            const PoseError e = ErrorOf(pose, truth);
            return std::make_tuple(e.translation_m, e.horizontal_m, e.rotation_deg);
          },
          py::arg("truth"),
          "(distance [m], its horizontal part [m], angle [deg]) to another pose.")
      .def("__repr__", &ReprOf);
}

void BindPoseList(py::module_& module) {
  py::class_<PoseList, std::shared_ptr<PoseList>>(module, "Poses", R"(Many poses in the world frame.

Args:
    quats_xyzw: (n, 4) float64, unit quaternions of cam_from_world in the order x, y, z, w.
    centers: (n, 3) float64, projection centres [m].
Raises:
    InputError: wrong shapes, dtypes or layout, numbers that are not finite, no unit quaternion.)")
      .def(py::init(&MadePoses), py::arg("quats_xyzw"), py::arg("centers"))
      .def(py::init([](const py::list& poses) {
             return std::make_shared<PoseList>(*PosesOf(poses));
           }),
           py::arg("poses"),
           "Of a list of Pose.")
      .def_static("from_view_angles", &PosesFromAngles, py::arg("centers"), py::arg("angles_deg"),
                  "centers (n, 3) float64 [m]; angles (n, 3) float64: heading, pitch, roll [deg].")
      .def_property_readonly(
          "quats_xyzw",
          [](py::object self) { return QuaternionsOf(self.cast<const PoseList&>(), self); },
          "(n, 4) float64, a view.")
      .def_property_readonly(
          "centers",
          [](py::object self) { return CentersOf(self.cast<const PoseList&>(), self); },
          "(n, 3) float64 [m], a view.")
      .def_property_readonly("translations", &TranslationsOf, "(n, 3) float64 [m], COLMAP's.")
      .def_property_readonly("angles_deg", &AnglesOf, "(n, 3) float64: heading, pitch, roll.")
      .def("errors", &ErrorsOf, py::arg("truth"),
           "(n, 3) float64: distance [m], its horizontal part [m], angle [deg] to a pose.")
      .def("__len__", [](const PoseList& poses) { return poses.size(); })
      .def("__getitem__", &Item, py::arg("index"))
      .def("__repr__", [](const PoseList& poses) {
        return "Poses(" + std::to_string(poses.size()) + ")";
      });
}

}  // namespace

std::shared_ptr<const PoseList> PosesOf(py::handle value, const std::string& name) {
  if (py::isinstance<PoseList>(value)) return value.cast<std::shared_ptr<PoseList>>();
  auto poses = std::make_shared<PoseList>();
  if (py::isinstance<Pose>(value)) {
    poses->push_back(value.cast<Pose>());
    return poses;
  }
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) {
    throw InputError("", name, Described(value), "ridgeline.Poses, a Pose or a list of them");
  }
  for (const py::handle& item : value) {
    poses->push_back(PoseOf(item, name + "[" + std::to_string(poses->size()) + "]"));
  }
  return poses;
}

Pose PoseOf(py::handle value, const std::string& name) {
  if (py::isinstance<Pose>(value)) return value.cast<Pose>();
  if (!py::hasattr(value, "rotation") || !py::hasattr(value, "translation")) {
    throw InputError("",
                     name,
                     Described(value),
                     "a ridgeline.Pose, or what has rotation.quat and translation");
  }
  return MadePose(value.attr("rotation").attr("quat"), py::none(), value.attr("translation"));
}

PoseList Shifted(std::span<const Pose> poses, const Eigen::Vector3d& origin) {
  PoseList shifted(poses.begin(), poses.end());
  for (Pose& pose : shifted) pose.center_in_world -= origin;
  return shifted;
}

py::array QuaternionsOf(std::span<const Pose> poses, py::handle owner) {
  const double* first = poses.empty() ? nullptr : poses.front().cam_from_world.coeffs().data();
  return View(first,
              {static_cast<py::ssize_t>(poses.size()), 4},
              {static_cast<py::ssize_t>(sizeof(Pose)), static_cast<py::ssize_t>(sizeof(double))},
              owner);
}

py::array CentersOf(std::span<const Pose> poses, py::handle owner) {
  const double* first = poses.empty() ? nullptr : poses.front().center_in_world.data();
  return View(first,
              {static_cast<py::ssize_t>(poses.size()), 3},
              {static_cast<py::ssize_t>(sizeof(Pose)), static_cast<py::ssize_t>(sizeof(double))},
              owner);
}

void BindPoses(py::module_& module) {
  BindPose(module);
  BindPoseList(module);
}

}  // namespace ridgeline::python
