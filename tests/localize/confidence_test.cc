// SPDX-License-Identifier: Apache-2.0
#include "localize/confidence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ridgeline {
namespace {

Goodness Explained(double share, double information = 20.0) {
  Goodness goodness;
  goodness.chance = -2.0;
  goodness.expected = -2.0 + information;
  goodness.observed = -2.0 + information * share;
  return goodness;
}

TEST(OutcomeModel, IsALogisticFunctionTimesAPowerOfTheMass) {
  const OutcomeModel model{-3.0, 2.0, 1.0, 0.2, 1.5};
  // -3 + 2 * 0.8 + 14 / 20 = -0.7.
  EXPECT_NEAR(model.Probability(0.64, Explained(0.8), 14.0), 0.512 / (1.0 + std::exp(0.7)), 1e-12);
}

TEST(OutcomeModel, EdgesThatCanTellLittleAreBelievedLess) {
  const OutcomeModel model{-3.0, 2.0, 1.0, 0.2, 1.5};
  // As above, less 0.2 for each nat that is missing of 15.
  EXPECT_NEAR(model.Probability(0.64, Explained(0.8, 12.5), 0.7 * 12.5),
              0.512 / (1.0 + std::exp(1.2)),
              1e-12);
  EXPECT_NEAR(model.Probability(0.64, Explained(0.8, 15.0), 6.0),
              model.Probability(0.64, Explained(0.8, 150.0), 60.0),
              1e-12);
}

TEST(OutcomeModel, StandingOutWithoutTheEdgesCountsNoMoreThanTheEdges) {
  const OutcomeModel model{-3.0, 2.0, 4.0, 0.2, 1.5};
  EXPECT_NEAR(model.Probability(1.0, Explained(0.3), 40.0),
              model.Probability(1.0, Explained(0.3), 0.3 * 20.0),
              1e-12);
}

TEST(OutcomeModel, NothingCanMakeUpForAPoseElsewhereInTheBox) {
  const OutcomeModel& right = ConfidenceOptions{}.right;
  EXPECT_LT(right.Probability(0.3, Explained(3.0), 1000.0), 0.31);
  EXPECT_EQ(right.Probability(0.0, Explained(3.0), 1000.0), 0.0);
}

TEST(OutcomeModel, EvidenceNeverSpeaksAgainstAnAnswer) {
  const ConfidenceOptions options;
  for (const OutcomeModel& model : {options.right, options.near}) {
    double last = 0.0;
    for (double x = -1.0; x <= 3.0; x += 0.25) {
      const double p = model.Probability(0.95, Explained(0.5 * x), 10.0 * x);
      EXPECT_GE(p, last);
      EXPECT_LE(p, 1.0);
      last = p;
    }
    EXPECT_GT(last, 0.9);
  }
}

// The two are learned apart.
TEST(OutcomeModel, WhatIsWithinTwoMetresIsAboutAsSurelyWithinFive) {
  const ConfidenceOptions options;
  for (double mass = 0.1; mass <= 1.0; mass += 0.1) {
    for (double share = 0.0; share <= 1.5; share += 0.25) {
      for (double nats = -5.0; nats <= 30.0; nats += 5.0) {
        const Goodness goodness = Explained(share);
        EXPECT_GE(options.near.Probability(mass, goodness, nats) + 0.05,
                  options.right.Probability(mass, goodness, nats))
            << mass << " " << share << " " << nats;
      }
    }
  }
}

}  // namespace
}  // namespace ridgeline
