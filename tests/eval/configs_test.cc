// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "base/atomic_file.h"
#include "base/options.h"
#include "localize/localizer_options.h"
#include "score/line_energy.h"
#include "support/source_folder.h"

namespace ridgeline {
namespace {

const std::filesystem::path kConfigs = std::filesystem::path(kSourceFolder) / "configs";

TEST(Configs, DefaultIsADumpOfTheDefaults) {
  LocalizerOptions options;
  EXPECT_EQ(ReadFile(kConfigs / "default.json"),
            OptionsToJson([&](OptionVisitor& v) { options.Visit(v); }));
}

TEST(Configs, ThoseOfTheLocalizerAreReadAndValid) {
  for (const char* name :
       {"default.json", "drone.json", "egenioussbench.json", "paper.json", "skyline.json"}) {
    LocalizerOptions options;
    OptionsFromJson(ReadFile(kConfigs / name), name, [&](OptionVisitor& v) { options.Visit(v); });
    EXPECT_NO_THROW(options.Validate()) << name;
  }
}

// Loeper et al., 4.3: X, Y and kappa are searched, nothing else, with no box beyond the one asked for.
TEST(Configs, ThePaperSearchesThreeParametersAtItsOwnSize) {
  LocalizerOptions options;
  OptionsFromJson(
      ReadFile(kConfigs / "paper.json"), "paper.json", [&](OptionVisitor& v) { options.Visit(v); });
  const PoseSpaceOptions& space = options.search.space;
  EXPECT_EQ(space.pitch_deg, 0.0);
  EXPECT_EQ(space.roll_deg, 0.0);
  EXPECT_EQ(space.height_m, 0.0);
  EXPECT_EQ(space.camera_height_range_m, 0.0);  // Z is the terrain's and one offset
  EXPECT_EQ(options.search.widenings, 0);
  EXPECT_EQ(options.score.evidence.work_size_px, 1280);
  // The same pixels in upright and broad pictures.
  const LineEnergyOptions& energy = options.score.groups.Get<LineEnergyOptions>();
  EXPECT_EQ(energy.DistanceLimitPx(960), 10.0);
  EXPECT_EQ(energy.DistanceLimitPx(1280), 10.0);
  // omega = 90, phi = 0 is a level camera, whatever kappa is.
  for (const double kappa : {-170.0, -20.0, 35.0}) {
    const ViewAngles angles = ViewAnglesOf(CamFromWorld(LoeperOmegaPhiKappa{90.0, 0.0, kappa}));
    EXPECT_NEAR(angles.pitch_deg, 0.0, 1e-9);
    EXPECT_NEAR(angles.roll_deg, 0.0, 1e-9);
    EXPECT_NEAR(HeadingDifferenceDeg(angles.heading_deg, -kappa), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace ridgeline
