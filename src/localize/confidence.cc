// SPDX-License-Identifier: Apache-2.0
#include "localize/confidence.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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
  v.Field("explained", explained);
  v.Field("above_background", above_background);
  v.Field("mass_power", mass_power);
}

double OutcomeModel::Probability(double posterior_mass,
                                 const Goodness& goodness,
                                 std::optional<double> background_nat) const {
  constexpr double kMostExplained = 1.5;
  constexpr double kLeastNat = -10.0;
  constexpr double kMostNat = 25.0;
  // Of right answers where it is known, about.
  constexpr double kUnknownNat = 10.0;
  const double logit =
      offset + explained * std::clamp(goodness.explained(), -0.5, kMostExplained) +
      above_background * std::clamp(background_nat.value_or(kUnknownNat), kLeastNat, kMostNat);
  return std::pow(std::clamp(posterior_mass, 0.0, 1.0), mass_power) / (1.0 + std::exp(-logit));
}

void ConfidenceOptions::Visit(OptionVisitor& v) {
  v.Field("abstain_below", abstain_below);
  v.Field("doubtful_below", doubtful_below);
  v.Group("right", [this](OptionVisitor& g) { right.Visit(g); });
  v.Group("near", [this](OptionVisitor& g) { near.Visit(g); });
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
  for (const auto& [name, power] : {std::pair{"right.mass_power", right.mass_power},
                                    std::pair{"near.mass_power", near.mass_power}}) {
    if (power >= 0.0) continue;
    throw InputError("", std::string("confidence.") + name, std::to_string(power), ">= 0");
  }
  RequirePositive("temperature", temperature);
  RequirePositive("floor_m", floor_m);
  RequirePositive("floor_deg", floor_deg);
}

}  // namespace ridgeline
