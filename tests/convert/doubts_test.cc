// SPDX-License-Identifier: Apache-2.0
// Poses of other programs that can be read and are doubtful, or are in no world.
#include "convert/doubts.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "convert/dataset_formats.h"
#include "convert_test_folder.h"

namespace ridgeline {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Doubts : public testing::ConvertTest {
 protected:
  // Rows of "name,easting,northing,height,omega,phi,kappa".
  Dataset Table(const std::string& rows) {
    Write("opk.csv", "image,easting,northing,height,omega,phi,kappa\n" + rows);
    ConvertOptions options;
    options.crs = "EPSG:25832";
    return ReadInput(folder_ / "opk.csv", "opk", options);
  }
  std::vector<std::string> Of(const std::string& rows) {
    return DoubtsOf(Table(rows), Eigen::Vector3d::Zero());
  }
};

TEST_F(Doubts, LevelTiltedAndDownwardCamerasAreNone) {
  EXPECT_THAT(Of("a.jpg,654239,5412023,400,90,-40,3\n"
                 "b.jpg,654249,5412023,400,70,20,-8\n"
                 "c.jpg,654259,5412023,500,2,-1,170\n"),
              IsEmpty());
}

TEST_F(Doubts, AnglesInRadians) {
  EXPECT_THAT(Of("a.jpg,654239,5412023,400,1.5708,-0.7,0.05\n"
                 "b.jpg,654249,5412023,400,1.45,0.35,3.1\n"),
              ElementsAre(HasSubstr("all 2 poses look straight down")));
}

// omega of -90 is a level camera on its head: what comes out where y and z axes are exchanged.
TEST_F(Doubts, PicturesUpsideDown) {
  EXPECT_THAT(Of("a.jpg,654239,5412023,400,90,0,0\nb.jpg,654249,5412023,400,-90,12,0\n"
                 "c.jpg,654250,5412023,400,-80,12,0\n"),
              ElementsAre(AllOf(HasSubstr("2 of 3 poses (the first: b) are upside down"),
                                HasSubstr("the camera axes"))));
}

TEST_F(Doubts, PosesThatWereNeverWritten) {
  EXPECT_THAT(Of("a.jpg,654239,5412023,400,90,0,0\nb.jpg,0,0,0,90,10,0\n"),
              ElementsAre(HasSubstr("1 of 2 poses (the first: b) stand at 0, 0, 0")));
  const Eigen::Vector3d origin(654000.0, 5412000.0, 400.0);
  EXPECT_THAT(DoubtsOf(Table("a.jpg,654239,5412023,400,90,0,0\nb.jpg,654000,5412000,400,90,1,0\n"),
                       origin),
              ElementsAre(HasSubstr("(the first: b) stand at 0, 0, 0")));
}

TEST_F(Doubts, RotationsThatWereNeverWritten) {
  Write("cameras.txt", "1 PINHOLE 640 480 500 500 320 240\n");
  Write("images.txt",
        "1 1 0 0 0 -654000 -5412000 -400 1 a.jpg\n\n"
        "2 0.707106781 0.707106781 0 0 -654010 400 -5412000 1 b.jpg\n\n");
  EXPECT_THAT(DoubtsOf(ReadInput(folder_, "colmap", {}), Eigen::Vector3d::Zero()),
              ElementsAre(HasSubstr("1 of 2 poses (the first: a) have the rotation 1, 0, 0, 0")));
}

TEST_F(Doubts, DegreesAndOnePlaceForAll) {
  EXPECT_THAT(Of("a.jpg,11.1,48.8,400,90,0,0\n"),
              ElementsAre(HasSubstr("degrees of longitude and latitude")));
  EXPECT_THAT(Of("a.jpg,654239,5412023,400,90,0,0\nb.jpg,654239,5412023,400,90,10,0\n"),
              ElementsAre("all 2 poses stand in one place"));
}

TEST_F(Doubts, APlaceInNoWorldIsAnError) {
  EXPECT_EQ(Message([&] { Table("a.jpg,1e300,5412023,400,90,0,0\n"); }),
            "opk.csv: picture a.jpg: position: got 1e+300, expected east and north in metres, "
            "below 1e8");
  EXPECT_THAT(Message([&] { Table("a.jpg,654239,5412023,400,90,-1e20,0\n"); }),
              HasSubstr("opk.csv: line 2: got \"-1e20\", expected an angle in degrees for phi"));
  EXPECT_THAT(Message([&] { Table("a.jpg,654239,5412023,1e6,90,0,0\n"); }),
              HasSubstr("got the height 1000000"));
}

}  // namespace
}  // namespace ridgeline
