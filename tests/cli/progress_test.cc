// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

TEST(ProgressText, HasRateAndRemainingTime) {
  EXPECT_EQ(ProgressText("Rendering", 0, 40, "pictures", 0.0), "Rendering  0/40 pictures");
  EXPECT_EQ(ProgressText("Rendering", 10, 40, "pictures", 5.0),
            "Rendering  10/40 pictures  2/s  15 s left");
  EXPECT_EQ(ProgressText("Rendering", 10, 40, "pictures", 100.0),
            "Rendering  10/40 pictures  10 s each  5 min 00 s left");
  EXPECT_EQ(ProgressText("Rendering", 40, 40, "pictures", 20.0),
            "Rendering  40/40 pictures  2/s  20 s");
}

TEST(DurationText, ReadsAsPeopleSay) {
  EXPECT_EQ(DurationText(0.2), "0 s");
  EXPECT_EQ(DurationText(59.4), "59 s");
  EXPECT_EQ(DurationText(125.0), "2 min 05 s");
  EXPECT_EQ(DurationText(11400.0), "3 h 10 min");
}

}  // namespace
}  // namespace ridgeline
