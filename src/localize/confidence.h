// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"
#include "localize/goodness.h"

namespace ridgeline {

// Logistic regression of an outcome of an answer on what is known of it without the truth:
// logit P = offset + mass * logit(posterior mass) + explained * (share of the edges seen) +
// observed * min(evidence of the edges, 15 nat). Learned by scripts/learn_confidence.py
// (docs/confidence.md).
struct OutcomeModel {
  double offset = 0.0;
  double mass = 0.0;
  double explained = 0.0;
  double observed = 0.0;

  void Visit(OptionVisitor& v);
  double Probability(double posterior_mass, const Goodness& goodness) const;
};

struct ConfidenceOptions {
  // Answers below this confidence are withheld; those below the other are doubtful.
  double abstain_below = 0.15;
  double doubtful_below = 0.6;
  // That an answer is within 2 m and 2 degrees, and that it is off by more than 5 m or 5 degrees;
  // for scores that judge no buildings the confidence is the posterior mass.
  OutcomeModel right{-6.33, 0.55, 1.68, 0.39};
  OutcomeModel gross{8.07, -0.54, -3.08, -0.46};
  // Answers whose protection level is above this are withheld [m]; 0: none are.
  double alert_limit_m = 0.0;
  // Widens the posterior, since samples of a picture are correlated.
  double temperature = 1.15;
  // Least standard deviations, of what the map cannot resolve.
  double floor_m = 0.5;
  double floor_deg = 0.5;

  void Visit(OptionVisitor& v);
};

}  // namespace ridgeline
