// SPDX-License-Identifier: Apache-2.0
#include "camera/magnetic_declination.h"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

struct Published {
  double year;
  double latitude_deg;
  double longitude_deg;
  double declination_deg;
};

// The test values that NOAA publishes with the WMM2025, those at height 0, to their two decimals.
TEST(MagneticDeclination, EqualsThePublishedTestValues) {
  constexpr Published kPublished[] = {
      {2025.0, 80.0, 0.0, 1.28},
      {2025.0, 0.0, 120.0, -0.16},
      {2025.0, -80.0, 240.0, 68.78},
      {2027.5, 80.0, 0.0, 2.59},
      {2027.5, 0.0, 120.0, -0.24},
      {2027.5, -80.0, 240.0, 68.49},
  };
  for (const Published& p : kPublished) {
    EXPECT_NEAR(
        MagneticDeclinationDeg(p.latitude_deg, p.longitude_deg, p.year), p.declination_deg, 0.0051)
        << p.year << " " << p.latitude_deg;
  }
}

// Taken back ten years, against the test values of the WMM2015.
TEST(MagneticDeclination, HoldsRoughlyForOlderPictures) {
  EXPECT_NEAR(MagneticDeclinationDeg(80.0, 0.0, 2015.0), -3.85, 0.5);
  EXPECT_NEAR(MagneticDeclinationDeg(0.0, 120.0, 2015.0), 0.57, 0.5);
}

TEST(MagneticDeclination, IsPeriodicInLongitude) {
  EXPECT_NEAR(MagneticDeclinationDeg(48.1, 11.5, 2026.0),
              MagneticDeclinationDeg(48.1, 371.5, 2026.0),
              1e-9);
}

}  // namespace
}  // namespace ridgeline
