// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace ridgeline::python {

namespace py = pybind11;

// Something with Python objects in it that threads without the interpreter's lock may hold and let
// go.
template <typename Parts>
std::shared_ptr<const Parts> Hold(Parts parts) {
  return {new Parts(std::move(parts)), [](const Parts* held) {
            const py::gil_scoped_acquire lock;
            delete held;
          }};
}
using Held = std::shared_ptr<const py::object>;

// The Python side of plug-ins of one kind, by name; a name that is set again stands for the new
// parts from then on. Thread-safe.
template <typename Parts>
class OwnParts {
 public:
  bool Has(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    return parts_.count(name) > 0;
  }
  std::shared_ptr<const Parts> Get(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    return parts_.at(name);
  }
  void Set(const std::string& name, Parts parts) {
    std::shared_ptr<const Parts> held = Hold(std::move(parts));  // outlives the lock
    const std::lock_guard lock(mutex_);
    std::swap(parts_[name], held);
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Parts>> parts_;
};

// Those of a kind: made once and never destroyed, since the interpreter ends before the library.
template <typename Parts>
OwnParts<Parts>& OwnPartsOf() {
  static auto* parts = new OwnParts<Parts>;
  return *parts;
}

// A name that files and --set can write. Throws InputError.
void RequireName(const std::string& kind, const std::string& name);

// The name of a function or class, unless one is given.
std::string NameOf(py::handle part, const std::string& given);

// Throws InputError unless the value can be called.
void RequireCallable(const std::string& name, py::handle value);

}  // namespace ridgeline::python
