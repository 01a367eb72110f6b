// SPDX-License-Identifier: Apache-2.0
// Pictures of public reports of faults, each with its right value; skipped where they are absent.
// tests/camera has the same kinds on inputs of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "input/picture_input.h"
#include "support/source_folder.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

const fs::path kCases = fs::path(kSourceFolder) / "../shared/cases";
const Crs kUtm32{25832, 0};

class PictureCase : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(kCases)) GTEST_SKIP() << "needs " << kCases;
  }
  PictureInput Read(const std::string& picture, const std::string& dtm = "") {
    Query query;
    query.image = kCases / picture;
    PictureReader pictures;
    return ReadPictureInput(query,
                            kUtm32,
                            dtm.empty() ? std::nullopt : std::optional<fs::path>(kCases / dtm),
                            {},
                            pictures);
  }
  double Focal(const std::string& picture) { return Read(picture).camera->params.front(); }
};

TEST_F(PictureCase, FocalLengths) {
  EXPECT_NEAR(Focal("06-dji-calibrated-focal/resized.jpg"), 916.7, 0.1);
  EXPECT_NEAR(Focal("06-dji-calibrated-focal/millimetres.jpg"), 912.0, 1.0);
  const std::string plane = "07-focal-plane-of-edited-pictures/";
  EXPECT_NEAR(Focal(plane + "turned.jpg"), 2884.0, 1.0);
  EXPECT_NEAR(Focal(plane + "resized_width_rewritten.jpg"), 2170.0, 1.0);
  EXPECT_NEAR(Focal(plane + "no_pixel_dimension.jpg"), 1594.0, 1.0);
  EXPECT_THAT(Read(plane + "absurd.jpg").notes,
              AllOf(Contains(HasSubstr("a field of view of 179")),
                    Contains(HasSubstr("26 mm equivalent assumed"))));
  EXPECT_NEAR(Focal("12-digital-zoom/zoom2_equivalent_24.jpg"), 1416.0, 1.0);
  EXPECT_NEAR(Focal("12-digital-zoom/zoom2_plane.jpg"), 2639.0, 1.0);
}

TEST_F(PictureCase, AnglesOfAutel) {
  const PictureInput autel = Read("10-autel-pitch-in-pix4d-tags/autel.jpg");
  EXPECT_FALSE(autel.prior->heading_deg.has_value());
  EXPECT_FALSE(autel.prior->pitch_deg.has_value());
  EXPECT_THAT(autel.notes, Contains(HasSubstr("upside down")));
  const PictureInput book = Read("10-autel-pitch-in-pix4d-tags/by_the_book.jpg");
  // Meridian convergence at 49 N, 8.4 E is -0.453 deg.
  EXPECT_NEAR(book.prior->heading_deg.value(), 30.453, 1e-3);
  EXPECT_NEAR(book.prior->pitch_deg.value(), -20.0, 1e-6);
}

TEST_F(PictureCase, HeightsOfDrones) {
  const std::string folder = "11-drone-height-not-dji/";
  const PictureInput autel = Read(folder + "auteld.jpg", folder + "flat.tif");
  EXPECT_EQ(autel.prior->height_in_world, 230.0);
  EXPECT_GE(autel.height_m, 30.0);
  EXPECT_THAT(autel.notes, Contains(HasSubstr("120 m above the terrain")));
  const PictureInput parrot = Read(folder + "parrot.jpg", folder + "flat.tif");
  EXPECT_EQ(parrot.prior->height_in_world, 230.0);
  EXPECT_NEAR(parrot.prior->heading_deg.value(), 30.453, 1e-3);
  EXPECT_NEAR(parrot.prior->pitch_deg.value(), -20.0, 1e-6);
  const PictureInput skydio = Read(folder + "skydio.jpg", folder + "flat.tif");
  EXPECT_NEAR(skydio.prior->height_in_world.value(), 135.0, 0.01);  // 25 m above take-off
  EXPECT_NEAR(skydio.prior->heading_deg.value(), 30.453, 1e-3);
}

TEST_F(PictureCase, GnssDoubts) {
  EXPECT_THAT(Read("19-gnss-doubts/nolonref.jpg").notes, Contains(HasSubstr("east assumed")));
  EXPECT_THAT(Read("19-gnss-doubts/datum.jpg").notes, Contains(HasSubstr("datum TOKYO")));
}

}  // namespace
}  // namespace ridgeline
