// SPDX-License-Identifier: Apache-2.0
// Exceptions: what the program says of bad input, Python says in the same words.
#include "base/error.h"

#include "bindings.h"
#include "callback.h"
#include "long_call.h"

namespace ridgeline::python {
namespace {

constexpr const char* kInputErrorDoc =
    "Input that cannot be used; a ValueError. Its text is that of the program: \"file: field: got X, "
    "expected Y\".\n\n"
    "Attributes: file (str) and field (str), empty where they are not known.";

PyObject* input_error = nullptr;  // lives as long as the interpreter

void RaiseInputError(const InputError& error) {
  py::object raised = py::reinterpret_borrow<py::object>(input_error)(error.what());
  raised.attr("file") = error.file();
  raised.attr("field") = error.field();
  PyErr_SetObject(input_error, raised.ptr());
}

}  // namespace

LongCall::LongCall()
    : check_([] {
        WithPython([] {
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        });
      }) {}

void BindErrors(py::module_& module) {
  py::dict members;
  members["file"] = "";
  members["field"] = "";
  input_error = PyErr_NewExceptionWithDoc(
      "ridgeline.InputError", kInputErrorDoc, PyExc_ValueError, members.ptr());
  module.attr("InputError") = py::reinterpret_borrow<py::object>(input_error);
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const InputError& error) {
      RaiseInputError(error);
    }
  });
  // Asked before the others, which then get the cause.
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const CallbackFailure& failure) {
      std::rethrow_exception(failure.cause);
    }
  });
}

}  // namespace ridgeline::python
