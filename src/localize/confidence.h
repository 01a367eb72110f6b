// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/options.h"
#include "localize/goodness.h"

namespace ridgeline {

// The probability of an outcome of an answer, from what is known of it without the truth: that the
// picture is from the box at all, a logistic regression on the share of the edges that is seen, on
// how far the box stands above the background for what the edges in view can tell, and on whether
// they can tell much (few edges agree with many places), times a power of the posterior mass, that it
// is from there and not from elsewhere in the box:
// P = mass^mass_power / (1 + exp(-(offset + explained * Goodness::explained() +
//                                  above_background * min(nats / information(), explained()) +
//                                  information * min(0, Goodness::information() - 15)))).
// Learned by scripts/learn_confidence.py (docs/confidence.md).
struct OutcomeModel {
  double offset = 0.0;
  double explained = 0.0;
  double above_background = 0.0;
  double information = 0.0;       // [1 / nat]
  double mass_power = 1.0;

  void Visit(OptionVisitor& v);
  // @param background_nat  How far the box stands above the background; nullopt: not known.
  double Probability(double posterior_mass,
                     const Goodness& goodness,
                     std::optional<double> background_nat) const;
};

struct ConfidenceOptions {
  // Answers below this confidence are withheld; those below the other are doubtful.
  double abstain_below = 0.15;
  double doubtful_below = 0.6;
  // That an answer is within 2 m and 2 degrees, and that it is within 5 m and 5 degrees; for scores
  // that judge no buildings the confidence is the posterior mass.
  OutcomeModel right{-3.85, 3.2, 3.8, 0.35, 1.9};
  OutcomeModel near{-4.75, 4.5, 4.7, 0.39, 0.6};
  // Answers whose protection level is above this are withheld [m]; 0: none are.
  double alert_limit_m = 0.0;
  // Above 1 the posterior is wider than the log ratios say, below it narrower (docs/confidence.md).
  double temperature = 0.6;
  // Least standard deviations, of what the map cannot resolve.
  double floor_m = 0.5;
  double floor_deg = 0.5;

  void Visit(OptionVisitor& v);
};

}  // namespace ridgeline
