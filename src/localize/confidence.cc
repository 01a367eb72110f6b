// SPDX-License-Identifier: Apache-2.0
#include "localize/confidence.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {

void OutcomeModel::Visit(OptionVisitor& v) {
  v.Field("offset", offset, AnyNumber());
  v.Field("explained", explained, AnyNumber());
  v.Field("above_background", above_background, AnyNumber());
  v.Field("information", information, AnyNumber());
  v.Field("mass_power", mass_power, NotNegative());
}

double OutcomeModel::Probability(double posterior_mass,
                                 const Goodness& goodness,
                                 std::optional<double> background_nat) const {
  // The bounds that the weights were learned with.
  constexpr double kLeastExplained = -0.5;
  constexpr double kMostExplained = 1.5;
  constexpr double kLeastShare = -0.5;
  constexpr double kMostShare = 1.2;
  // Three of four right answers have more.
  constexpr double kUnknownShare = 0.6;
  constexpr double kLeastInformationNat = 5.0;
  // Edges that can tell more than this are as good as any.
  constexpr double kInformationNat = 15.0;
  // A place that stands out, but not by its edges, stands out for another reason.
  const double share =
      std::min(goodness.explained(),
               background_nat
                   ? *background_nat / std::max(goodness.information(), kLeastInformationNat)
                   : kUnknownShare);
  const double logit =
      offset + explained * std::clamp(goodness.explained(), kLeastExplained, kMostExplained) +
      above_background * std::clamp(share, kLeastShare, kMostShare) +
      information * std::min(0.0, goodness.information() - kInformationNat);
  return std::pow(std::clamp(posterior_mass, 0.0, 1.0), mass_power) / (1.0 + std::exp(-logit));
}

void ConfidenceOptions::Visit(OptionVisitor& v) {
  v.Field("abstain_below", abstain_below, Closed(0.0, 1.0));
  v.Field("doubtful_below", doubtful_below, Closed(0.0, 1.0));
  v.Group("right", [this](OptionVisitor& g) { right.Visit(g); });
  v.Group("near", [this](OptionVisitor& g) { near.Visit(g); });
  v.Field("alert_limit_m", alert_limit_m, NotNegative());
  v.Field("temperature", temperature, Positive());
  v.Field("floor_m", floor_m, Positive());
  v.Field("floor_deg", floor_deg, Positive());
}

}  // namespace ridgeline
