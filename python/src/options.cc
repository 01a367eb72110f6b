// SPDX-License-Identifier: Apache-2.0
// Options of a localization: the keys of the program's --set and configuration files.
#include "options.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "bindings.h"

namespace ridgeline::python {
namespace {

VisitOptions VisitOf(LocalizerOptions& options) {
  return [&options](OptionVisitor& v) { options.Visit(v); };
}

std::string TextOfFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream || !std::filesystem::is_regular_file(path)) {
    throw InputError(path, "", "no file that can be read", "a configuration file");
  }
  return text.str();
}

py::object ValueAt(const LocalizerOptions& options, const std::string& path) {
  LocalizerOptions copy = options;
  py::object value = FromJson(OptionsToJson(VisitOf(copy)));
  std::istringstream keys(path);
  for (std::string key; std::getline(keys, key, '.');) {
    if (!py::isinstance<py::dict>(value) || !value.contains(key)) {
      SetOption(path + "=null", VisitOf(copy));  // says which key is nearest
      throw py::key_error(path);
    }
    value = value[py::str(key)];
  }
  return value;
}

// The keys of a dict below a path.
void SetBelow(const std::string& prefix, const py::dict& values, const VisitOptions& visit) {
  for (const auto& [key, value] : values) {
    const std::string path = prefix + std::string(py::str(key));
    if (py::isinstance<py::dict>(value)) {
      SetBelow(path + ".", py::reinterpret_borrow<py::dict>(value), visit);
    } else {
      SetOption(path + "=" + JsonOf(value), visit);
    }
  }
}

}  // namespace

std::string JsonOf(py::handle value) {
  return py::str(py::module_::import("json").attr("dumps")(value));
}

py::object FromJson(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

void SetAll(const py::dict& values, const VisitOptions& visit) { SetBelow("", values, visit); }

LocalizerOptions OptionsOf(py::handle value) {
  LocalizerOptions options;
  if (py::isinstance<LocalizerOptions>(value)) {
    options = value.cast<LocalizerOptions>();
  } else if (py::isinstance<py::dict>(value)) {
    SetAll(py::reinterpret_borrow<py::dict>(value), VisitOf(options));
  } else if (!value.is_none()) {
    const std::string path = py::str(py::module_::import("os").attr("fspath")(value));
    OptionsFromJson(TextOfFile(path), path, VisitOf(options));
  }
  options.Validate();
  return options;
}

void BindOptions(py::module_& module) {
  py::class_<LocalizerOptions>(module, "Options", R"(Everything that can be set about a localization.

The keys are those of `ridgeline options`, of configuration files and of --set, by path:
options["search.east_m"] = 20. Own scores and cues join when they are registered: make options
after that.

Args:
    values: None (the defaults), a dict ({"search.east_m": 20} or nested), the path of a JSON
        configuration file, or other Options, which are copied.
Raises:
    InputError: an unknown key (with the nearest known one), a wrong type, a value out of range.)")
      .def(py::init([](py::object values) { return OptionsOf(values); }),
           py::arg("values") = py::none())
      .def("__getitem__", &ValueAt, py::arg("path"))
      .def(
          "__setitem__",
          [](LocalizerOptions& options, const std::string& path, py::object value) {
            LocalizerOptions changed = options;
            py::dict one;
            one[py::str(path)] = value;
            SetAll(one, VisitOf(changed));
            changed.Validate();
            options = changed;
          },
          py::arg("path"),
          py::arg("value"))
      .def(
          "update",
          [](LocalizerOptions& options, const py::dict& values) {
            LocalizerOptions changed = options;
            SetAll(values, VisitOf(changed));
            changed.Validate();
            options = changed;
          },
          py::arg("values"),
          "Sets several keys at once, all or none.")
      .def("json",
           [](LocalizerOptions& options) { return OptionsToJson(VisitOf(options)); },
           "All options as the text of a configuration file.")
      .def("to_dict",
           [](LocalizerOptions& options) { return FromJson(OptionsToJson(VisitOf(options))); },
           "All options as nested dicts.")
      .def("copy", [](const LocalizerOptions& options) { return options; })
      .def("__repr__", [](LocalizerOptions& options) {
        return "Options(score=\"" + options.score.name + "\", search=\"" + options.search.method +
               "\", lines=\"" + options.lines.detector + "\")";
      });
}

}  // namespace ridgeline::python
