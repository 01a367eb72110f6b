// SPDX-License-Identifier: Apache-2.0
// Priors, queries and datasets.
#include "datasets.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "input/dataset.h"
#include "poses.h"
#include "world.h"

namespace ridgeline::python {
namespace {

PosePrior MadePrior(py::handle position,
                    std::optional<double> height,
                    std::optional<double> heading_deg,
                    std::optional<double> pitch_deg,
                    std::optional<double> roll_deg) {
  const auto place = DoublesOf(position, "prior.position", {2});
  PosePrior prior{{place.at(0), place.at(1)}, height, heading_deg, pitch_deg, roll_deg};
  const std::pair<const char*, std::optional<double>> parts[] = {{"height", height},
                                                                 {"heading_deg", heading_deg},
                                                                 {"pitch_deg", pitch_deg},
                                                                 {"roll_deg", roll_deg}};
  for (const auto& [name, value] : parts) {
    if (value && !std::isfinite(*value)) {
      throw InputError("", std::string("prior.") + name, std::to_string(*value), "a finite number");
    }
  }
  return prior;
}

PosePrior OfPose(const Pose& pose) {
  const ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  return {pose.center_in_world.head<2>(),
          pose.center_in_world.z(),
          angles.heading_deg,
          angles.pitch_deg,
          angles.roll_deg};
}

void BindPrior(py::module_& module) {
  py::class_<PosePrior>(module, "Prior", R"(What is known of a pose before looking at the picture.

Args:
    position: (2,) east, north [m].
    height: of the camera [m]; None: the terrain and a camera height.
    heading_deg: clockwise from grid north; None: any.
    pitch_deg, roll_deg: None: level.)")
      .def(py::init(&MadePrior),
           py::arg("position"),
           py::arg("height") = py::none(),
           py::arg("heading_deg") = py::none(),
           py::arg("pitch_deg") = py::none(),
           py::arg("roll_deg") = py::none())
      .def_static("of_pose", &OfPose, py::arg("pose"), "All of a pose.")
      .def_static("read", [](py::handle path) { return ReadPrior(PathOf(path)); }, py::arg("path"),
                  "From a JSON file like a dataset's \"prior\".")
      .def_readonly("position", &PosePrior::position_in_world)
      .def_readonly("height", &PosePrior::height_in_world)
      .def_readonly("heading_deg", &PosePrior::heading_deg)
      .def_readonly("pitch_deg", &PosePrior::pitch_deg)
      .def_readonly("roll_deg", &PosePrior::roll_deg);
}

void BindQuery(py::module_& module) {
  py::class_<Query>(module, "Query", "One picture of a dataset, with what is known of it.")
      .def_readonly("id", &Query::id)
      .def_readonly("set", &Query::set)
      .def_property_readonly("image", [](const Query& q) { return q.image.string(); }, "Path.")
      .def_readonly("camera", &Query::camera, "None: the picture's own EXIF.")
      .def_readonly("prior", &Query::prior, "None: the picture's own EXIF and XMP.")
      .def_readonly("truth", &Query::truth, "Pose; None: not known.")
      .def("__repr__", [](const Query& q) { return "Query(\"" + q.id + "\")"; });
}

const Query& Item(const Dataset& dataset, const py::object& key) {
  if (py::isinstance<py::str>(key)) {
    return dataset.queries[FindQuery(dataset, key.cast<std::string>(), "query")];
  }
  auto index = key.cast<py::ssize_t>();
  const auto size = static_cast<py::ssize_t>(dataset.queries.size());
  if (index < 0) index += size;
  if (index < 0 || index >= size) throw py::index_error();
  return dataset.queries[static_cast<std::size_t>(index)];
}

}  // namespace

PosePrior PriorOf(py::handle value) {
  if (py::isinstance<PosePrior>(value)) return value.cast<PosePrior>();
  if (py::isinstance<Pose>(value)) return OfPose(value.cast<Pose>());
  throw InputError("", "prior", Described(value), "a ridgeline.Prior or a Pose");
}

void BindDatasets(py::module_& module) {
  BindPrior(module);
  BindQuery(module);
  py::class_<Dataset>(module, "Dataset", R"(A set of queries against one model: a dataset.json.

Args:
    path: of the dataset.json.
Raises:
    InputError: file and field of what is missing, unknown, of a wrong type or out of range.)")
      .def(py::init([](py::handle path) { return ReadDataset(PathOf(path)); }), py::arg("path"))
      .def_readonly("name", &Dataset::name)
      .def_readonly("crs", &Dataset::crs)
      .def_property_readonly("file", [](const Dataset& d) { return d.file.string(); })
      .def_property_readonly("model",
                             [](const Dataset& d) {
                               std::vector<std::string> paths;
                               for (const auto& path : d.model) paths.push_back(path.string());
                               return paths;
                             })
      .def_property_readonly("dtm",
                             [](const Dataset& d) -> std::optional<std::string> {
                               if (!d.dtm) return std::nullopt;
                               return d.dtm->string();
                             })
      .def_readonly("queries", &Dataset::queries)
      .def("__len__", [](const Dataset& d) { return d.queries.size(); })
      .def("__getitem__", &Item, py::arg("key"), py::return_value_policy::reference_internal,
           "A query by its number or its id.")
      .def("__repr__", [](const Dataset& d) {
        return "Dataset(\"" + d.name + "\", " + std::to_string(d.queries.size()) + " queries)";
      });
}

}  // namespace ridgeline::python
