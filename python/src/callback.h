// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <exception>

#include "base/error.h"

namespace ridgeline::python {

// What went wrong in Python code that the library called, or Ctrl-C, on its way through the library.
// No std::exception, which a search takes for the failure of one trial and goes on.
struct CallbackFailure {
  std::exception_ptr cause;
};

// Runs body() with the interpreter's lock; what it throws leaves as a CallbackFailure. The value
// returned must be no Python object.
template <typename Body>
auto WithPython(const Body& body) {
  const pybind11::gil_scoped_acquire lock;
  try {
    return body();
  } catch (const CallbackFailure&) {
    throw;
  } catch (...) {
    throw CallbackFailure{std::current_exception()};
  }
}

}  // namespace ridgeline::python
