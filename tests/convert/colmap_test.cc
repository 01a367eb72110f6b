// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "convert/colmap_model.h"
#include "convert/dataset_formats.h"
#include "convert/dataset_json.h"
#include "convert_test_folder.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using Colmap = testing::ConvertTest;

// The examples of colmap.github.io/format.html.
constexpr const char* kCameras =
    "# Camera list with one line of data per camera:\n"
    "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
    "# Number of cameras: 3\n"
    "1 SIMPLE_PINHOLE 3072 2304 2559.81 1536 1152\n"
    "2 PINHOLE 3072 2304 2560.56 2560.56 1536 1152\n"
    "3 SIMPLE_RADIAL 3072 2304 2559.69 1536 1152 -0.0218531\n";
constexpr const char* kImages =
    "# Image list with two lines of data per image:\n"
    "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
    "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
    "# Number of images: 2, mean observations per image: 2\n"
    "1 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P1180141.JPG\n"
    "2362.39 248.498 58396 1784.7 268.254 59027 1784.7 268.254 -1\n"
    "2 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 3 a b/P1180142.JPG\n"
    "\n";

TEST_F(Colmap, ReadsThePublishedExample) {
  Write("cameras.txt", kCameras);
  Write("images.txt", kImages);
  const Dataset dataset = ReadInput(folder_, "", {});
  ASSERT_EQ(dataset.queries.size(), 2u);
  const Query& first = dataset.queries[0];
  EXPECT_EQ(first.id, "P1180141");
  EXPECT_EQ(first.camera->model, "SIMPLE_PINHOLE");
  EXPECT_EQ(first.camera->params, (std::vector<double>{2559.81, 1536, 1152}));
  // -R^T t, worked out apart.
  EXPECT_NEAR(first.truth->center_in_world.x(), 3.796946771262922, 1e-12);
  EXPECT_NEAR(first.truth->center_in_world.y(), -0.3613809409194601, 1e-12);
  EXPECT_NEAR(first.truth->center_in_world.z(), -1.034815703684591, 1e-12);
  EXPECT_EQ(dataset.queries[1].image, "a b/P1180142.JPG");
  EXPECT_EQ(dataset.queries[1].camera->model, "SIMPLE_RADIAL");
}

TEST_F(Colmap, OriginIsAddedToPositions) {
  Write("cameras.txt", kCameras);
  Write("images.txt", kImages);
  ConvertOptions options;
  options.origin = Eigen::Vector3d(691000.0, 5336000.0, 500.0);
  const Dataset dataset = ReadColmapModel(folder_, options);
  EXPECT_NEAR(dataset.queries[0].truth->center_in_world.x(), 691003.796946771, 1e-8);
  EXPECT_NEAR(dataset.queries[0].truth->center_in_world.z(), 498.965184296, 1e-8);
}

constexpr const char* kDataset = R"({
 "name": "town",
 "crs": "EPSG:25832",
 "model": [
  "town.gml"
 ],
 "queries": [
  {
   "id": "000",
   "image": "images/000.jpg",
   "camera": {
    "model": "OPENCV",
    "width": 640,
    "height": 480,
    "params": [
     500.25,
     501.125,
     320.1,
     240.3,
     -0.1,
     0.01,
     0.001,
     -0.0002
    ]
   },
   "truth": {
    "position": [
     690909.2150001,
     5336040.5004322,
     517.123
    ],
    "cam_from_world_wxyz": [
     0.6973729805502833,
     0.6814451761392594,
     0.16165585339794697,
     -0.15221952232591396
    ]
   }
  }
 ]
}
)";

TEST_F(Colmap, DatasetComesBackToTheLastByte) {
  Write("dataset.json", kDataset);
  Dataset dataset = ReadInput(folder_ / "dataset.json", "", {});
  dataset.queries[0].image = "images/000.jpg";
  EXPECT_EQ(WriteOutput(dataset, "colmap", {}, folder_ / "model"), 1u);
  Dataset back = ReadInput(folder_ / "model", "", {});
  back.name = "town";
  back.model = {folder_ / "town.gml"};
  back.queries[0].image = folder_ / back.queries[0].image;
  EXPECT_EQ(DatasetJson(back, folder_), kDataset);
}

TEST_F(Colmap, ModelComesBackExactly) {
  Write("dataset.json", kDataset);
  Dataset dataset = ReadInput(folder_ / "dataset.json", "", {});
  dataset.queries[0].image = "images/000.jpg";
  WriteOutput(dataset, "colmap", {}, folder_ / "one");
  const Dataset again = ReadInput(folder_ / "one", "", {});
  WriteOutput(again, "colmap", {}, folder_ / "two");
  const Pose a = *ReadColmapModel(folder_ / "one", {}).queries[0].truth;
  const Pose b = *ReadColmapModel(folder_ / "two", {}).queries[0].truth;
  EXPECT_EQ(Text("one/cameras.txt"), Text("two/cameras.txt"));
  EXPECT_EQ(a.cam_from_world.coeffs(), b.cam_from_world.coeffs());
  // World coordinates of 5e6 m have steps of 1e-9 m.
  EXPECT_LT((a.center_in_world - b.center_in_world).norm(), 3e-9);
}

TEST_F(Colmap, EqualCamerasAreOne) {
  Write("cameras.txt", kCameras);
  Write("images.txt", kImages);
  Dataset dataset = ReadInput(folder_, "", {});
  dataset.queries[1].camera = dataset.queries[0].camera;
  WriteOutput(dataset, "colmap", {}, folder_ / "out");
  EXPECT_THAT(Text("out/cameras.txt"), HasSubstr("# Number of cameras: 1\n"));
}

TEST_F(Colmap, BadInputNamesFileAndLine) {
  const auto error = [&](const std::string& cameras, const std::string& images) {
    Write("cameras.txt", cameras);
    Write("images.txt", images);
    return Message([&] { ReadColmapModel(folder_, {}); });
  };
  EXPECT_EQ(error("1 THIN_PRISM_FISHEYE 10 10 1 2 3\n", kImages),
            "cameras.txt: line 1.model: got \"THIN_PRISM_FISHEYE\", expected one of "
            "SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV");
  EXPECT_EQ(error("\n1 PINHOLE 640 480 500 500 320\n", kImages),
            "cameras.txt: line 2.params: got 3 numbers, expected 4 for PINHOLE");
  EXPECT_EQ(error("1 PINHOLE 640 480 500 x 320 240\n", kImages),
            "cameras.txt: line 1: got \"x\", expected a number for PARAMS");
  EXPECT_EQ(error("1 PINHOLE 640\n", kImages),
            "cameras.txt: line 1: got 3 columns, expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]");
  EXPECT_EQ(error("", kImages), "cameras.txt: got no camera, expected one line per camera");
  EXPECT_EQ(error(kCameras, "1 1 0 0 0 0 0 0 7 a.jpg\n\n"),
            "images.txt: line 1: got camera 7, expected a camera of cameras.txt");
  EXPECT_EQ(error(kCameras, "1 1 0 0 0 0 0 0 1\n\n"),
            "images.txt: line 1: got 9 columns, expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID "
            "NAME");
  EXPECT_EQ(error(kCameras, "1 1 0 0 0 0 0 nan 1 a.jpg\n\n"),
            "images.txt: line 1: got \"nan\", expected a number for TZ");
  EXPECT_EQ(
      error(kCameras, "1 1 1 0 0 0 0 0 1 a.jpg\n\n"),
      "images.txt: line 1: got a quaternion of norm 1.414214, expected a unit quaternion qw qx "
      "qy qz");
  // A model whose empty lines were removed: the second picture would be taken for points.
  EXPECT_THAT(error(kCameras, "1 1 0 0 0 0 0 0 1 a.jpg\n2 1 0 0 0 0 0 0 1 b.jpg\n"),
              HasSubstr("images.txt: line 2: got 10 columns, expected the points of the picture "
                        "above"));
  EXPECT_EQ(error(kCameras, "# nothing\n"),
            "images.txt: got no picture, expected two lines per picture");
}

// Cut off anywhere, it is an error or a model of whole pictures; never a wrong pose.
TEST_F(Colmap, TruncatedAtEveryByte) {
  Write("cameras.txt", kCameras);
  const std::string images = kImages;
  for (std::size_t size = 0; size < images.size(); ++size) {
    Write("images.txt", images.substr(0, size));
    try {
      const Dataset dataset = ReadColmapModel(folder_, {});
      EXPECT_NEAR(dataset.queries[0].truth->center_in_world.x(), 3.796946771262922, 1e-12);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("images.txt"));
    }
  }
}

TEST_F(Colmap, CameraIsNeeded) {
  Write("dataset.json", kDataset);
  Dataset dataset = ReadInput(folder_ / "dataset.json", "", {});
  dataset.queries[0].camera.reset();
  EXPECT_EQ(Message([&] { WriteOutput(dataset, "colmap", {}, folder_ / "model"); }),
            "dataset.json: query 000: got no camera, expected a camera, which COLMAP's models need "
            "(--camera FILE)");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "model"));
}

}  // namespace
}  // namespace ridgeline
