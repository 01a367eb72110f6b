// SPDX-License-Identifier: Apache-2.0
#include "convert/egeniouss.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "camera/pose.h"
#include "convert/dataset_formats.h"
#include "convert_test_folder.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A benchmark of three pictures; the rotation of a.jpg is written out by hand.
class Egeniouss : public ::ridgeline::testing::ConvertTest {
 protected:
  Egeniouss() {
    Write("lod2/city.gml", "");
    Write("metadata/camera_parameters.txt", "fx 70\nfy 70\ncx 24\ncy 32\n");
    for (const char* picture : {"val/a.jpg", "val/b.jpg", "test/c.jpg"}) {
      std::filesystem::create_directories((folder_ / "query_images" / picture).parent_path());
      cv::imwrite((folder_ / "query_images" / picture).string(), cv::Mat::zeros(64, 48, CV_8UC3));
    }
    // Looking north, level: the photo's x is east, its y up, its z (backward) south.
    Write("query_images/val_gt_poses.txt",
          "# IMAGE_NAME qw qx qy qz UTMx UTMy alt\n"
          "a.jpg 0.7071067811865476 0.7071067811865476 0 0 604000.5 5790000.25 76.5\n");
    Write("query_images/val_android_poses.txt",
          "a.jpg 1 0 0 0 604003 5790004 120\nb.jpg 1 0 0 0 604010 5790011 121\n");
    Write("query_images/test_android_poses.csv", "c.jpg 1 0 0 0 604020 5790021 122\n");
  }
};

TEST_F(Egeniouss, FoldersGiveCamerasTruthsAndPositions) {
  EXPECT_EQ(FormatOfInput(folder_), "egeniouss");
  const Dataset dataset = ReadInput(folder_, "", {});
  ASSERT_EQ(dataset.queries.size(), 3u);
  ASSERT_EQ(dataset.model.size(), 1u);
  EXPECT_EQ(dataset.model[0].filename(), "lod2");
  const Query& a = dataset.queries[0];
  EXPECT_EQ(a.id, "a");
  EXPECT_EQ(a.set, "val");
  EXPECT_EQ(a.image, "query_images/val/a.jpg");
  EXPECT_EQ(a.camera->width, 48);
  ASSERT_TRUE(a.truth.has_value());
  EXPECT_EQ(a.truth->center_in_world, Eigen::Vector3d(604000.5, 5790000.25, 76.5));
  const ViewAngles angles = ViewAnglesOf(a.truth->cam_from_world);
  EXPECT_NEAR(HeadingDifferenceDeg(angles.heading_deg, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(angles.pitch_deg, 0.0, 1e-9);
  EXPECT_NEAR(angles.roll_deg, 0.0, 1e-9);
  // The phone's heading is known to be wrong, its height is the receiver's.
  EXPECT_EQ(a.prior->position_in_world, Eigen::Vector2d(604003.0, 5790004.0));
  EXPECT_FALSE(a.prior->height_in_world.has_value());
  EXPECT_FALSE(a.prior->heading_deg.has_value());
  EXPECT_FALSE(dataset.queries[1].truth.has_value());
  EXPECT_EQ(dataset.queries[2].set, "test");
  EXPECT_FALSE(dataset.queries[2].truth.has_value());
}

TEST_F(Egeniouss, OneOfTheTwoSetsAlone) {
  const Dataset dataset = ReadInput(folder_ / "query_images" / "test", "", {});
  ASSERT_EQ(dataset.queries.size(), 1u);
  EXPECT_EQ(dataset.queries[0].image, "c.jpg");
  EXPECT_EQ(dataset.model.size(), 1u);
}

TEST_F(Egeniouss, CommasNamesWithoutEndingsAndHeadersAreTaken) {
  Write("query_images/val_gt_poses.txt",
        "image_name,qw,qx,qy,qz,x,y,z\nb,1,0,0,0,604000,5790000,80\n");
  const Dataset dataset = ReadInput(folder_, "", {});
  ASSERT_TRUE(dataset.queries[1].truth.has_value());
  // Its camera looks straight down, the top of the picture to the north.
  EXPECT_NEAR(ViewAnglesOf(dataset.queries[1].truth->cam_from_world).pitch_deg, -90.0, 1e-6);
}

TEST_F(Egeniouss, SubmissionsHaveTheFormOfTheTruths) {
  const std::string text = EgenioussPoses(ReadInput(folder_, "", {}));
  EXPECT_THAT(text, StartsWith("# IMAGE_NAME qw qx qy qz UTMx UTMy alt\na.jpg 0.70710678"));
  EXPECT_THAT(text, HasSubstr(" 604000.5 5790000.25 76.5\n"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("b.jpg")));
}

TEST_F(Egeniouss, AnswersReplaceTheTruthsSoThatNoneIsSubmitted) {
  Dataset dataset = ReadInput(folder_, "", {});
  Write("results.csv", "query,e,n,h,qw,qx,qy,qz\na,,,,,,,\nb,604010,5790011,77,0.5,0.5,0.5,0.5\n");
  Merge(ReadInput(folder_ / "results.csv", "", {}), true, dataset);
  const std::string text = EgenioussPoses(dataset);
  EXPECT_THAT(text, ::testing::Not(HasSubstr("a.jpg")));
  EXPECT_THAT(text, HasSubstr("\nb.jpg "));
}

TEST_F(Egeniouss, BadListsAreNamedByLine) {
  Write("query_images/val_gt_poses.txt", "a.jpg 1 0 0 0 604000 5790000\n");
  EXPECT_EQ(Message([&] { ReadInput(folder_, "", {}); }),
            "query_images/val_gt_poses.txt: line 1: got 7 columns, expected image_name qw qx qy qz "
            "UTM_east UTM_north altitude");
  Write("query_images/val_gt_poses.txt", "a.jpg 1 1 0 0 604000 5790000 70\n");
  EXPECT_THAT(Message([&] { ReadInput(folder_, "", {}); }), HasSubstr("unit quaternion"));
}

TEST_F(Egeniouss, WhatIsWrittenIsReadAgain) {
  Dataset dataset = ReadInput(folder_, "", {});
  for (Query& query : dataset.queries) {
    query.image = folder_ / query.image;
    const double id = query.id[0];
    query.truth = Pose{CamFromWorld(ViewAngles{id, 3.0, -2.0}), {604000.0 + id, 5790000.0, 70.0}};
  }
  const std::filesystem::path written = folder_ / "written";
  std::filesystem::create_directories(written);
  WriteEgenioussFolder(dataset, 1, written);
  const Dataset again = ReadInput(written, "", {});
  ASSERT_EQ(again.queries.size(), 3u);
  EXPECT_EQ(again.queries[0].camera->params, dataset.queries[0].camera->params);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.queries[i].set, "val");
    EXPECT_LT((again.queries[i].truth->center_in_world - dataset.queries[i].truth->center_in_world)
                  .norm(),
              1e-9);
    EXPECT_LT(RotationDistanceDeg(again.queries[i].truth->cam_from_world,
                                  dataset.queries[i].truth->cam_from_world),
              1e-9);
  }
  EXPECT_EQ(again.queries[2].set, "test");
  EXPECT_FALSE(again.queries[2].truth.has_value());
  EXPECT_TRUE(again.queries[2].prior.has_value());
}

}  // namespace
}  // namespace ridgeline
