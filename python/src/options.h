// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "base/options.h"
#include "localize/localizer_options.h"

namespace ridgeline::python {

namespace py = pybind11;

// A Python value as JSON text.
std::string JsonOf(py::handle value);
// JSON text as Python values.
py::object FromJson(const std::string& text);

// Sets the keys of a dict: "search.east_m": 20, or nested. Throws InputError for unknown ones, as
// the program's --set.
void SetAll(const py::dict& values, const VisitOptions& visit);

// Localizer options of what Python code gives for them: None (the defaults), an Options, a dict or
// the path of a configuration file. Validated.
LocalizerOptions OptionsOf(py::handle value);

}  // namespace ridgeline::python
