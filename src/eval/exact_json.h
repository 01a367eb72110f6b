// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "camera/pose_prior.h"
#include "localize/localization.h"
#include "localize/pose_space.h"

// Values as JSON that reads back to the last bit: for files that take the place of a computation.
// Not part of the installed interface's promises; included by .cc files only.
namespace ridgeline::exact {

using Json = nlohmann::ordered_json;

// JSON has no infinities.
inline Json Of(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}
inline double DoubleOf(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const std::string text = json.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  return text == "inf" ? infinity : -infinity;
}

template <typename Number>
Json Of(const std::vector<Number>& values) {
  Json list = Json::array();
  for (const Number value : values) list.push_back(Of(static_cast<double>(value)));
  return list;
}
template <typename Number>
std::vector<Number> ListOf(const Json& json) {
  std::vector<Number> values;
  for (const Json& value : json) values.push_back(static_cast<Number>(DoubleOf(value)));
  return values;
}

inline Json Of(const std::optional<double>& value) { return value ? Of(*value) : Json(nullptr); }
inline std::optional<double> OptionalOf(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(DoubleOf(json));
}

template <typename Derived>
Json Of(const Eigen::MatrixBase<Derived>& matrix) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) list.push_back(Of(double(matrix(i, j))));
  }
  return list;
}
template <typename Matrix>
Matrix MatrixOf(const Json& json) {
  Matrix matrix;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      matrix(i, j) = DoubleOf(json.at(static_cast<std::size_t>(i * matrix.cols() + j)));
    }
  }
  return matrix;
}

Json Of(const Pose& pose);
Pose PoseOf(const Json& json);
Json Of(const PosePrior& prior);
PosePrior PriorOf(const Json& json);
Json Of(const PoseSpaceOptions& ranges);
PoseSpaceOptions RangesOf(const Json& json);
Json Of(const EnergyMap& map);
EnergyMap MapOf(const Json& json);

}  // namespace ridgeline::exact
