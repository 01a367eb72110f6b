// SPDX-License-Identifier: Apache-2.0
// Invented towns, for demonstrations and tests.
#include <filesystem>

#include "base/error.h"
#include "bindings.h"
#include "long_call.h"
#include "options.h"
#include "synth/town_dataset.h"
#include "world.h"

namespace ridgeline::python {
namespace {

std::string Town(py::handle folder, const py::dict& set, int threads) {
  TownDatasetOptions options;
  SetAll(set, [&options](OptionVisitor& v) { options.Visit(v); });
  CheckOptions(options);
  const std::filesystem::path path = PathOf(folder);
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    throw InputError("", "folder", path.string() + ", which exists", "a new folder");
  }
  std::filesystem::create_directories(path, error);
  if (error) throw InputError("", "folder", path.string() + ": " + error.message(), "a new folder");
  const LongCall call;
  WriteTownDataset(options, path, threads, [](std::size_t, std::size_t) {});
  return (path / "dataset.json").string();
}

}  // namespace

void BindSynth(py::module_& module) {
  module.def("synth", &Town, py::arg("folder"), py::arg("options") = py::dict(), py::kw_only(),
             py::arg("threads") = 0, R"(Writes an invented town as a dataset: model, terrain, pictures with truths.

Args:
    folder: a new one.
    options: keys of `ridgeline synth --set`, e.g. {"town.seed": 1, "street": 4, "drone": 0}.
Returns:
    Path of its dataset.json.)");
}

}  // namespace ridgeline::python
