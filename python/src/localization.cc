// SPDX-License-Identifier: Apache-2.0
// What a localization gives: pose, covariance, confidence, modes, map.
#include "localization.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cstdio>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "eval/pose_json.h"
#include "options.h"

namespace ridgeline::python {
namespace {

py::array Cells(const SharedMap& shared, const std::vector<float>& values) {
  const auto columns = static_cast<py::ssize_t>(shared.map->columns);
  const auto number = static_cast<py::ssize_t>(sizeof(float));
  return View(values.data(),
              {static_cast<py::ssize_t>(shared.map->rows), columns},
              {columns * number, number},
              CapsuleOf(shared.map));
}

py::array Axis(double first, double spacing, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first + spacing * i);
  return ArrayOf(std::move(values), {count});
}

void BindMap(py::module_& module) {
  py::class_<SharedMap>(module, "EnergyMap", R"(Energy over positions, the least over heights and orientations.

Rows run from south to north, columns from west to east: plot with origin="lower" and `extent`.)")
      .def_property_readonly(
          "energies", [](const SharedMap& m) { return Cells(m, m.map->energies); },
          "(rows, columns) float32 in [0, 1], 0 best; NaN: no camera can stand there. A view.")
      .def_property_readonly(
          "headings_deg", [](const SharedMap& m) { return Cells(m, m.map->headings_deg); },
          "(rows, columns) float32, the best heading at each position [deg]. A view.")
      .def_property_readonly(
          "east",
          [](const SharedMap& m) { return Axis(m.map->first.x(), m.map->spacing_m, m.map->columns); },
          "(columns,) float64, world [m].")
      .def_property_readonly(
          "north",
          [](const SharedMap& m) { return Axis(m.map->first.y(), m.map->spacing_m, m.map->rows); },
          "(rows,) float64, world [m].")
      .def_property_readonly("spacing_m", [](const SharedMap& m) { return m.map->spacing_m; })
      .def_property_readonly(
          "extent",
          [](const SharedMap& m) {
            const double half = 0.5 * m.map->spacing_m;
            const Eigen::Vector2d last =
                m.map->first + m.map->spacing_m * Eigen::Vector2d(m.map->columns - 1, m.map->rows - 1);
            return py::make_tuple(m.map->first.x() - half,
                                  last.x() + half,
                                  m.map->first.y() - half,
                                  last.y() + half);
          },
          "(west, east, south, north) of the cells' edges [m], for matplotlib's imshow.")
      .def("__repr__", [](const SharedMap& m) {
        return "EnergyMap(" + std::to_string(m.map->rows) + " x " + std::to_string(m.map->columns) +
               ")";
      });
}

py::list ModesOf(const FoundPose& found) {
  py::list modes;
  for (const PoseMode& mode : found.result.modes) modes.append(py::make_tuple(mode.pose, mode.energy));
  return modes;
}

py::list BuildingsOf(const FoundPose& found) {
  py::list rows;
  for (const BuildingFit& fit : found.result.goodness.buildings) {
    py::dict row;
    row["id"] = found.world->model.buildings[fit.building].id;
    row["explained"] = fit.explained();
    row["information_nat"] = fit.information();
    row["roof_shift_m"] = fit.roof_shift_m;
    row["roof_gain_nat"] = fit.roof_gain;
    rows.append(row);
  }
  return rows;
}

py::dict TimesOf(const FoundPose& found) {
  py::dict times;
  for (const StageTime& time : found.result.times) {
    const py::str name(time.name);
    times[name] = time.seconds + (times.contains(name) ? times[name].cast<double>() : 0.0);
  }
  return times;
}

py::object MapOf(const FoundPose& found) {
  if (found.result.map.energies.empty()) return py::none();
  return py::cast(SharedMap{std::make_shared<EnergyMap>(found.result.map)});
}

py::object ProtectionOf(const FoundPose& found) {
  if (!found.result.protection) return py::none();
  return py::make_tuple(found.result.protection->position_m, found.result.protection->heading_deg);
}

std::string ReprOf(const FoundPose& found) {
  char text[120];
  std::snprintf(text,
                sizeof text,
                "Localization(%s, confidence %.2f%s)",
                NameOf(found.result.status),
                found.result.confidence,
                found.result.pose ? "" : ", no pose");
  return text;
}

}  // namespace

PoseSpaceOptions RangesOf(py::handle value, const PoseSpaceOptions& ranges) {
  PoseSpaceOptions changed = ranges;
  if (value.is_none()) return changed;
  if (!py::isinstance<py::dict>(value)) {
    throw InputError("", "ranges", Described(value), "a dict such as {\"east_m\": 10}");
  }
  SetAll(py::reinterpret_borrow<py::dict>(value),
         [&changed](OptionVisitor& v) { changed.Visit(v); });
  CheckOptions(changed, "search");
  return changed;
}

void BindLocalization(py::module_& module) {
  BindMap(module);
  py::class_<FoundPose>(module, "Localization", R"(The answer for one picture.

An answer without a pose (`pose` is None) is an answer: `status` and `reason` say why.)")
      .def_property_readonly(
          "status", [](const FoundPose& f) { return std::string(NameOf(f.result.status)); },
          "\"ok\", \"doubtful\" (a pose, with doubts), or why there is none: \"too_few_lines\", "
          "\"no_visible_model\", \"ambiguous\", \"not_explained\", \"unprotected\".")
      .def_property_readonly("reason", [](const FoundPose& f) { return f.result.reason; })
      .def_property_readonly("doubts", [](const FoundPose& f) { return f.result.doubts; })
      .def_property_readonly("pose", [](const FoundPose& f) { return f.result.pose; },
                             "Pose in the world frame, or None.")
      .def_property_readonly("energy", [](const FoundPose& f) { return f.result.energy; },
                             "Of the best mode, [0, 1], 0 best.")
      .def_property_readonly("confidence", [](const FoundPose& f) { return f.result.confidence; },
                             "Probability that the pose is within 2 m and 2 degrees.")
      .def_property_readonly("posterior_mass",
                             [](const FoundPose& f) { return f.result.posterior_mass; })
      .def_property_readonly(
          "covariance",
          [](const FoundPose& f) -> Eigen::MatrixXd { return f.result.spread.covariance; },
          "(6, 6) float64 of east, north, height [m], heading, pitch, roll [deg].")
      .def_property_readonly("protection_level", &ProtectionOf,
                             "(horizontal [m], heading [deg]) that one answer of a thousand exceeds; "
                             "None: cannot be given.")
      .def_property_readonly("modes", &ModesOf, "[(Pose, energy)], distinct minima, best first.")
      .def_property_readonly("map", &MapOf,
                             "EnergyMap of the search box; None for searches by a sampler.")
      .def_property_readonly("explained",
                             [](const FoundPose& f) { return f.result.goodness.explained(); },
                             "1: the model's edges are seen as they should be, 0: as by chance.")
      .def_property_readonly("buildings", &BuildingsOf,
                             "A dict for each building in view: id, explained, information_nat, "
                             "roof_shift_m, roof_gain_nat.")
      .def_property_readonly("evaluations", [](const FoundPose& f) { return f.result.evaluations; })
      .def_property_readonly("seconds", &TimesOf, "Of each stage, a dict.")
      .def_property_readonly("assumptions",
                             [](const FoundPose& f) {
                               std::vector<std::string> lines;
                               for (const Assumption& a : f.assumptions) lines.push_back(TextOf(a));
                               return lines;
                             })
      .def_property_readonly("notes", [](const FoundPose& f) { return f.result.notes; })
      .def_property_readonly("warnings",
                             [](const FoundPose& f) {
                               std::vector<std::string> lines = f.world->warnings;
                               lines.insert(lines.end(),
                                            f.result.warnings.begin(),
                                            f.result.warnings.end());
                               return lines;
                             },
                             "Of the world and of the search.")
      .def("json",
           [](const FoundPose& f) {
             return PoseJson(f.picture, f.result, f.world->model, f.assumptions);
           },
           "The text of pose.json, which `ridgeline localize --json` prints.")
      .def("__repr__", &ReprOf);
}

}  // namespace ridgeline::python
