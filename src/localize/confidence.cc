// SPDX-License-Identifier: Apache-2.0
#include "localize/confidence.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ridgeline {

void OutcomeModel::Visit(OptionVisitor& v) {
  v.Field("offset", offset, AnyNumber());
  v.Field("mass", mass, AnyNumber());
  v.Field("explained", explained, AnyNumber());
  v.Field("observed", observed, AnyNumber());
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
  v.Field("abstain_below", abstain_below, Closed(0.0, 1.0));
  v.Field("doubtful_below", doubtful_below, Closed(0.0, 1.0));
  v.Group("right", [this](OptionVisitor& g) { right.Visit(g); });
  v.Group("gross", [this](OptionVisitor& g) { gross.Visit(g); });
  v.Field("alert_limit_m", alert_limit_m, NotNegative());
  v.Field("temperature", temperature, Positive());
  v.Field("floor_m", floor_m, Positive());
  v.Field("floor_deg", floor_deg, Positive());
}

}  // namespace ridgeline
