// SPDX-License-Identifier: Apache-2.0
#include "optim/search_box.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <sstream>

#include "base/error.h"

namespace ridgeline {
namespace {

std::string Interval(const Parameter& parameter) {
  std::ostringstream text;
  text << "[" << parameter.lower << ", " << parameter.upper << "]";
  return text.str();
}

}  // namespace

bool SearchBox::Contains(std::span<const double> values) const {
  if (values.size() != parameters.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= parameters[i].lower && values[i] <= parameters[i].upper)) return false;
  }
  return true;
}

double SearchBox::Difference(std::size_t index, double from, double to) const {
  const Parameter& parameter = parameters[index];
  const double difference = to - from;
  if (!parameter.periodic || parameter.Fixed()) return difference;
  return std::remainder(difference, parameter.upper - parameter.lower);
}

std::vector<double> SearchBox::Center() const {
  std::vector<double> center;
  for (const Parameter& parameter : parameters) {
    center.push_back(parameter.lower + 0.5 * (parameter.upper - parameter.lower));
  }
  return center;
}

void SearchBox::Validate() const {
  if (parameters.empty()) throw InputError("", "search", "no parameters", "at least one");
  std::set<std::string> names;
  for (const Parameter& parameter : parameters) {
    if (parameter.name.empty())
      throw InputError("", "search", "a parameter without name", "a name");
    const std::string field = "search." + parameter.name;
    if (!names.insert(parameter.name).second) {
      throw InputError("", field, "the name twice", "different names");
    }
    if (!std::isfinite(parameter.lower) || !std::isfinite(parameter.upper) ||
        !std::isfinite(parameter.upper - parameter.lower)) {
      throw InputError("", field, Interval(parameter), "finite bounds");
    }
    if (parameter.lower > parameter.upper) {
      throw InputError("", field, Interval(parameter), "lower <= upper");
    }
  }
}

UnitCube::UnitCube(const SearchBox& box) : box_(box) {
  for (std::size_t i = 0; i < box.Size(); ++i) {
    if (box.parameters[i].Fixed()) continue;
    free_.push_back(i);
    periodic_.push_back(box.parameters[i].periodic);
    names_.push_back(box.parameters[i].name);
  }
}

std::vector<double> UnitCube::ToBox(std::span<const double> unit) const {
  assert(unit.size() == free_.size());
  std::vector<double> values;
  for (const Parameter& parameter : box_.parameters) values.push_back(parameter.lower);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Parameter& parameter = box_.parameters[free_[k]];
    const double value = parameter.lower + unit[k] * (parameter.upper - parameter.lower);
    values[free_[k]] = std::clamp(value, parameter.lower, parameter.upper);
  }
  return values;
}

std::vector<double> UnitCube::ToUnit(std::span<const double> values) const {
  assert(values.size() == box_.Size());
  std::vector<double> unit;
  for (const std::size_t i : free_) {
    const Parameter& parameter = box_.parameters[i];
    const double u = (values[i] - parameter.lower) / (parameter.upper - parameter.lower);
    unit.push_back(std::clamp(u, 0.0, 1.0));
  }
  return unit;
}

}  // namespace ridgeline
