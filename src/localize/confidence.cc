// SPDX-License-Identifier: Apache-2.0
#include "localize/confidence.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace ridgeline {
namespace {

void RequirePositive(const char* name, double value) {
  if (value > 0.0) return;
  throw InputError("", std::string("confidence.") + name, std::to_string(value), "> 0");
}

void RequireShare(const char* name, double value) {
  if (value >= 0.0 && value <= 1.0) return;
  throw InputError("", std::string("confidence.") + name, std::to_string(value), "[0, 1]");
}

}  // namespace

void OutcomeModel::Visit(OptionVisitor& v) {
  v.Field("offset", offset);
  v.Field("mass", mass);
  v.Field("explained", explained);
  v.Field("observed", observed);
}

double OutcomeModel::Probability(double posterior_mass, const Goodness& goodness) const {
  constexpr double kEdge = 1e-3;  // a mass is not known better than that
  constexpr double kMostObserved = 15.0;
  constexpr double kMostExplained = 1.5;
  const double p = std::clamp(posterior_mass, kEdge, 1.0 - kEdge);
  const double logit = offset + mass * std::log(p / (1.0 - p)) +
                       explained * std::clamp(goodness.explained(), -0.5, kMostExplained) +
                       observed * std::clamp(goodness.observed, -5.0, kMostObserved);
  return 1.0 / (1.0 + std::exp(-logit));
}

void ConfidenceOptions::Visit(OptionVisitor& v) {
  v.Field("abstain_below", abstain_below);
  v.Field("doubtful_below", doubtful_below);
  v.Group("right", [this](OptionVisitor& g) { right.Visit(g); });
  v.Group("gross", [this](OptionVisitor& g) { gross.Visit(g); });
  v.Field("alert_limit_m", alert_limit_m);
  v.Field("temperature", temperature);
  v.Field("floor_m", floor_m);
  v.Field("floor_deg", floor_deg);
}

void ConfidenceOptions::Validate() const {
  RequireShare("abstain_below", abstain_below);
  RequireShare("doubtful_below", doubtful_below);
  if (!(alert_limit_m >= 0.0)) {
    throw InputError("", "confidence.alert_limit_m", std::to_string(alert_limit_m), ">= 0");
  }
  RequirePositive("temperature", temperature);
  RequirePositive("floor_m", floor_m);
  RequirePositive("floor_deg", floor_deg);
}

}  // namespace ridgeline
