// SPDX-License-Identifier: Apache-2.0
#include "own_parts.h"

#include <algorithm>
#include <cctype>

#include "arrays.h"
#include "base/error.h"

namespace ridgeline::python {

void RequireName(const std::string& kind, const std::string& name) {
  const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
  if (!is_word) throw InputError("", kind, "\"" + name + "\"", "a name of letters, digits and _");
}

std::string NameOf(py::handle part, const std::string& given) {
  if (!given.empty()) return given;
  return py::hasattr(part, "__name__") ? std::string(py::str(part.attr("__name__"))) : "";
}

void RequireCallable(const std::string& name, py::handle value) {
  if (PyCallable_Check(value.ptr()) == 0) {
    throw InputError("", name, Described(value), "a function");
  }
}

}  // namespace ridgeline::python
