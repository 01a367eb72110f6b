// SPDX-License-Identifier: Apache-2.0
#include "landscape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

constexpr const char* kPeriodic = " periodic";

std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

std::vector<double> Numbers(const std::string& line,
                            std::size_t count,
                            const std::string& file,
                            int number) {
  std::vector<double> row;
  for (const std::string& field : Split(line)) {
    char* end = nullptr;
    row.push_back(std::strtod(field.c_str(), &end));
    if (end == field.c_str()) row.clear();
    if (row.empty()) break;
  }
  if (row.size() == count) return row;
  throw InputError(file,
                   "line " + std::to_string(number),
                   "\"" + line + "\"",
                   std::to_string(count) + " numbers");
}

std::vector<double> Distinct(const std::vector<std::vector<double>>& rows, std::size_t column) {
  std::vector<double> values;
  for (const std::vector<double>& row : rows) values.push_back(row[column]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

Landscape::Landscape(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::istringstream stream(ReadFile(path));
  std::string line;
  std::getline(stream, line);
  std::vector<std::string> names = Split(line);
  if (names.size() < 2 || names.back() != "energy") {
    throw InputError(file, "line 1", "\"" + line + "\"", "names of parameters, then energy");
  }
  names.pop_back();
  std::vector<std::vector<double>> rows;
  for (int number = 2; std::getline(stream, line); ++number) {
    rows.push_back(Numbers(line, names.size() + 1, file, number));
  }
  for (std::string& name : names) {
    const std::size_t at = name.find(kPeriodic);
    Parameter parameter;
    parameter.name = name.substr(0, at);
    parameter.periodic = at != std::string::npos;
    box_.parameters.push_back(parameter);
  }
  MakeAxes(rows, file);
}

void Landscape::MakeAxes(const std::vector<std::vector<double>>& rows, const std::string& file) {
  std::size_t total = 1;
  for (std::size_t d = 0; d < box_.Size(); ++d) {
    Parameter& parameter = box_.parameters[d];
    const std::vector<double> values = Distinct(rows, d);
    Axis axis;
    axis.count = values.size();
    axis.periodic = parameter.periodic;
    axis.stride = total;
    if (values.empty()) throw InputError(file, "", "no rows", "grid points");
    axis.first = values.front();
    if (axis.count > 1) axis.spacing = (values.back() - values.front()) / (axis.count - 1.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::abs(values[i] - axis.first - i * axis.spacing) <= 1e-3 * axis.spacing) continue;
      throw InputError(file, parameter.name, std::to_string(values[i]), "equal spacing");
    }
    parameter.lower = axis.first;
    parameter.upper = axis.periodic ? axis.first + axis.count * axis.spacing : values.back();
    total *= axis.count;
    axes_.push_back(axis);
  }
  if (total != rows.size()) {
    throw InputError(file,
                     "",
                     std::to_string(rows.size()) + " rows",
                     std::to_string(total) + ", one per combination of values");
  }
  energies_.assign(total, std::numeric_limits<double>::quiet_NaN());
  least_energy_ = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& row : rows) {
    std::size_t index = 0;
    for (std::size_t d = 0; d < axes_.size(); ++d) {
      index += axes_[d].stride *
               static_cast<std::size_t>(std::lround((row[d] - axes_[d].first) / axes_[d].spacing));
    }
    energies_[index] = row.back();
    if (row.back() < least_energy_) {
      least_energy_ = row.back();
      minimum_.assign(row.begin(), row.end() - 1);
    }
  }
  if (minimum_.empty()) throw InputError(file, "energy", "no finite value", "at least one");
}

// Index of the grid point at or below the value, and the way beyond it in spacings.
std::size_t Landscape::NodeAt(std::size_t d, double value, double* beyond) const {
  const Axis& axis = axes_[d];
  const double last = static_cast<double>(axis.count) - (axis.periodic ? 0.0 : 1.0);
  const double place = std::clamp((value - axis.first) / axis.spacing, 0.0, last);
  const double node = std::min(std::floor(place), static_cast<double>(axis.count) - 1.0);
  *beyond = place - node;
  return static_cast<std::size_t>(node);
}

double Landscape::Energy(std::span<const double> values) const {
  std::vector<std::size_t> nodes(axes_.size());
  std::vector<double> beyond(axes_.size());
  for (std::size_t d = 0; d < axes_.size(); ++d) nodes[d] = NodeAt(d, values[d], &beyond[d]);
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t corner = 0; corner < (std::size_t{1} << axes_.size()); ++corner) {
    double weight = 1.0;
    std::size_t index = 0;
    for (std::size_t d = 0; d < axes_.size(); ++d) {
      const bool upper = (corner >> d & 1) != 0;
      weight *= upper ? beyond[d] : 1.0 - beyond[d];
      std::size_t node = nodes[d] + (upper ? 1 : 0);
      if (node == axes_[d].count) node = axes_[d].periodic ? 0 : node - 1;
      index += axes_[d].stride * node;
    }
    if (weight == 0.0 || !std::isfinite(energies_[index])) continue;
    sum += weight * energies_[index];
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : std::numeric_limits<double>::infinity();
}

bool Landscape::Feasible(std::span<const double> values) const {
  std::size_t index = 0;
  for (std::size_t d = 0; d < axes_.size(); ++d) {
    double beyond = 0.0;
    std::size_t node = NodeAt(d, values[d], &beyond) + (beyond >= 0.5 ? 1 : 0);
    if (node == axes_[d].count) node = axes_[d].periodic ? 0 : node - 1;
    index += axes_[d].stride * node;
  }
  return std::isfinite(energies_[index]);
}

}  // namespace ridgeline
