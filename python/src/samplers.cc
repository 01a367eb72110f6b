// SPDX-License-Identifier: Apache-2.0
// Samplers in ask / tell form.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "arrays.h"
#include "base/error.h"
#include "bindings.h"
#include "callback.h"
#include "optim/sampler.h"
#include "optim/sampler_table.h"
#include "options.h"

namespace ridgeline::python {
namespace {

// Rows (name, lower, upper[, periodic]).
SearchBox BoxOf(const py::list& rows) {
  SearchBox box;
  for (const py::handle& item : rows) {
    const std::string name = "box[" + std::to_string(box.Size()) + "]";
    if (!py::isinstance<py::tuple>(item) && !py::isinstance<py::list>(item)) {
      throw InputError("", name, Described(item), "(name, lower, upper[, periodic])");
    }
    const auto row = py::reinterpret_borrow<py::sequence>(item);
    if (row.size() != 3 && row.size() != 4) {
      throw InputError("", name, std::to_string(row.size()) + " values", "3 or 4");
    }
    box.parameters.push_back({row[0].cast<std::string>(),
                              row[1].cast<double>(),
                              row[2].cast<double>(),
                              row.size() == 4 && row[3].cast<bool>()});
  }
  return box;
}

std::vector<double> ValuesOf(py::handle value, const std::string& name, std::size_t size) {
  const auto array = DoublesOf(value, name, {static_cast<py::ssize_t>(size)});
  return {array.data(), array.data() + array.size()};
}

std::unique_ptr<Sampler> Made(const std::string& name,
                              const py::list& box,
                              std::uint64_t seed,
                              const py::dict& set,
                              const py::object& feasible,
                              py::handle start) {
  SamplerOptions options;
  options.name = name;
  SetAll(set, [&options](OptionVisitor& v) { options.Visit(v); });
  SearchProblem problem;
  problem.box = BoxOf(box);
  if (!start.is_none()) problem.start = ValuesOf(start, "start", problem.box.Size());
  if (!feasible.is_none()) {
    problem.feasible = [feasible](std::span<const double> values) {
      py::array_t<double> point(static_cast<py::ssize_t>(values.size()), values.data());
      return feasible(point).cast<bool>();
    };
  }
  return MakeSampler(options, problem, seed);
}

py::array ValuesArray(const Trial& trial) {
  return ArrayOf(trial.values, {static_cast<py::ssize_t>(trial.values.size())});
}

void Tell(Sampler& sampler, Trial trial, double energy) {
  trial.SetEnergy(energy);
  sampler.Tell(trial);
}

void Add(Sampler& sampler, py::handle values, double energy) {
  Trial trial;
  trial.values = ValuesOf(values, "values", sampler.box().Size());
  trial.SetEnergy(energy);
  sampler.Tell(trial);
}

py::dict Params(const Sampler& sampler, const Trial& trial) {
  py::dict params;
  for (std::size_t i = 0; i < trial.values.size(); ++i) {
    params[py::str(sampler.box().parameters[i].name)] = trial.values[i];
  }
  return params;
}

void BindTrial(py::module_& module) {
  py::class_<Trial>(module, "Trial", "A point that a sampler proposes.")
      .def_readonly("index", &Trial::index, "Running number, from 0.")
      .def_property_readonly("values", &ValuesArray,
                             "(parameters,) float64, in the order and the units of the box.")
      .def("__repr__", [](const Trial& trial) {
        return "Trial(" + std::to_string(trial.index) + ")";
      });
}

}  // namespace

void BindSamplers(py::module_& module) {
  BindTrial(module);
  py::class_<Sampler>(module, "Sampler", R"(A sampler in ask / tell form: minimises a function of a box.

    sampler = ridgeline.Sampler("tpe", space.box, seed=1)
    for trial in sampler.ask(8):
        sampler.tell(trial, energy(trial.values))

The proposals follow from name, box, options, seed and the order of asks and tells. Not thread-safe.

Args:
    name: one of samplers(), own ones too.
    box: list of (name, lower, upper[, periodic]); lower == upper: fixed.
    seed: of the random numbers.
    options: keys of "search.sampler", e.g. {"tpe.candidates": 24}.
    feasible: called with (parameters,) float64; False: the point is not proposed.
    start: first guess, (parameters,).
Raises:
    InputError: an unknown name or key, a box that cannot be used.)")
      .def(py::init(&Made), py::arg("name"), py::arg("box"), py::kw_only(), py::arg("seed") = 1,
           py::arg("options") = py::dict(), py::arg("feasible") = py::none(),
           py::arg("start") = py::none())
      .def("ask", &Sampler::Ask, py::arg("count") = 1,
           "Up to `count` Trials; fewer if the sampler waits for results or has ended.")
      .def("tell", &Tell, py::arg("trial"), py::arg("energy"),
           "The result of a Trial: finite; inf: not admissible; nan: failed.")
      .def("add", &Add, py::arg("values"), py::arg("energy"),
           "A result for a point of one's own, which TPE and GP samplers learn from.")
      .def("params", &Params, py::arg("trial"), "The values of a Trial by name.")
      .def_property_readonly("ended", &Sampler::Ended, "Whether no proposals will come any more.");
  module.def("samplers", &SamplerNames, "Names of the samplers, own ones last.");
}

}  // namespace ridgeline::python
