// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "convert/angle_table.h"
#include "convert/dataset_formats.h"
#include "convert/globe_files.h"
#include "convert/lod_loc.h"
#include "convert/opensfm.h"
#include "convert/results.h"
#include "convert/trajectory.h"
#include "convert/visual_localization.h"
#include "convert_test_folder.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using Convert = testing::ConvertTest;

// The demo of LoD-Loc (github.com/VictorZoo/LoD-Loc, dataset/DEMO/demo).
constexpr const char* kIntrinsic =
    "DJI_20231018114619_0636_D.JPG PINHOLE 5280 3956 3778.423095703125 3767.391845703125 "
    "2663.6240401795367 1919.7213540791272\n";
constexpr const char* kGps =
    "DJI_20231018114619_0636_D.JPG 0.35306918920414804 0.858736326443373 0.343470025741748 "
    "-0.14121760052567597 -72.86584684160385 -31.816965929176988 179.76924574480518\n";
constexpr const char* kTruth =
    "DJI_20231018114619_0636_D.JPG 0.3564665175946537 0.8594507026104173 0.3351269772960607 "
    "-0.1482093812982367 -70.67835236499236 -21.375015244964203 190.49998384991895\n"
    "DJI_20230513163714_0033_T.JPG 0.3564665175946537 0.8594507026104173 0.3351269772960607 "
    "-0.1482093812982367 -70.67835236499236 -21.375015244964203 190.49998384991895\n";

TEST_F(Convert, LodLocsOwnDemo) {
  Write("demo/intrinsic.txt", kIntrinsic);
  Write("demo/GPS_pose.txt", kGps);
  Write("demo/GT_pose.txt", kTruth);
  const Dataset dataset = ReadInput(folder_ / "demo", "", {});
  ASSERT_EQ(dataset.queries.size(), 1u);
  const Query& query = dataset.queries[0];
  EXPECT_EQ(query.id, "DJI_20231018114619_0636_D");
  EXPECT_EQ(query.image, "Query_image/DJI_20231018114619_0636_D.JPG");
  EXPECT_EQ(query.camera->height, 3956);
  // -R^T t, worked out apart.
  const Eigen::Vector3d center(155.7981597179315, -60.760518847033495, 117.37826627837481);
  EXPECT_LT((query.truth->center_in_world - center).norm(), 1e-9);
  // The receiver is some metres off, and about as high.
  EXPECT_NEAR(query.prior->position_in_world.x(), center.x(), 20.0);
  EXPECT_NEAR(query.prior->height_in_world.value(), center.z(), 20.0);
  EXPECT_LT(query.prior->pitch_deg.value(), -20.0);
  EXPECT_NEAR(HeadingDifferenceDeg(query.prior->heading_deg.value(),
                                   ViewAnglesOf(query.truth->cam_from_world).heading_deg),
              0.0,
              5.0);
  std::filesystem::remove(folder_ / "demo/GT_pose.txt");
  EXPECT_FALSE(ReadLodLoc(folder_ / "demo", {}).queries[0].truth.has_value());
  Write("demo/intrinsic.txt", "a.jpg PINHOLE 10 10 1\n");
  EXPECT_EQ(Message([&] { ReadLodLoc(folder_ / "demo", {}); }),
            "demo/intrinsic.txt: line 1.params: got 1 numbers, expected 4 for PINHOLE");
}

// Lists in the form of the Aachen Day-Night benchmark: a query's name has a folder, a result's not.
TEST_F(Convert, VisualLocalizationLists) {
  Write("queries.txt",
        "query/night/nexus5x/IMG_20161227_160713.jpg SIMPLE_RADIAL 1600 1200 1469.2 800 600 "
        "-0.0353\n");
  Write("poses.txt", "IMG_20161227_160713.jpg 0.5 0.5 -0.5 0.5 1 2 3\n");
  Dataset dataset = ReadInput(folder_ / "queries.txt", "", {});
  EXPECT_FALSE(dataset.queries[0].truth.has_value());
  Merge(ReadInput(folder_ / "poses.txt", "", {}), false, dataset);
  EXPECT_EQ(dataset.queries[0].camera->params[3], -0.0353);
  // R = [[0, -1, 0], [0, 0, -1], [1, 0, 0]] by hand: c = -R^T t.
  const Pose& pose = *dataset.queries[0].truth;
  const Eigen::Matrix3d r = pose.cam_from_world.toRotationMatrix();
  EXPECT_LT((r * pose.center_in_world + Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  Eigen::Matrix3d by_hand;
  by_hand << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  EXPECT_TRUE(r.isApprox(by_hand, 1e-12)) << r;
}

TEST_F(Convert, BadListsNameFileAndLine) {
  const auto error = [&](const std::string& text) {
    Write("list.txt", text);
    return Message([&] { ReadVisualLocalizationList(folder_ / "list.txt", {}); });
  };
  EXPECT_EQ(error("a.jpg 1 0 0 0 1 2 3\nb.jpg 1 0 0 0 1 2\n"),
            "list.txt: line 2: got 7 columns, expected name qw qx qy qz tx ty tz");
  EXPECT_EQ(error("a.jpg 1 0 0 0 1 2 3\nb.jpg 1 0 0 0 1 2 z\n"),
            "list.txt: line 2: got \"z\", expected a number for tz");
  EXPECT_EQ(error("a.jpg FISHEYE 640 480 1\n").substr(0, 39),
            "list.txt: line 1.model: got \"FISHEYE\", ");
  EXPECT_THAT(error("# empty\n\n"), HasSubstr("list.txt: got an empty list"));
  Write("queries.txt", "a.jpg PINHOLE 640 480 500 500 320 240\n");
  Write("poses.txt", "b.jpg 1 0 0 0 1 2 3\n");
  EXPECT_EQ(Message([&] {
              Dataset dataset = ReadInput(folder_ / "queries.txt", "", {});
              Merge(ReadInput(folder_ / "poses.txt", "", {}), false, dataset);
            }),
            "poses.txt: got the picture \"b.jpg\", expected a picture of queries.txt");
}

std::string Reconstruction(const std::string& camera, const std::string& shot) {
  return "[{\"cameras\": {\"v2 dji\": {" + camera +
         "}}, \"shots\": {\"IMG_1.JPG\": {\"camera\": \"v2 dji\", " + shot +
         "}}, \"points\": {}, \"reference_lla\": {\"latitude\": 48.148912, \"longitude\": "
         "11.567891, \"altitude\": 560.0}}]";
}
constexpr const char* kPerspective =
    "\"projection_type\": \"perspective\", \"width\": 4000, \"height\": 3000, \"focal\": 0.85, "
    "\"k1\": -0.02, \"k2\": 0.003";
// Level, looking north: the axes turned by 90 degrees about x.
constexpr const char* kNorth = "\"rotation\": [1.5707963267948966, 0, 0], ";

TEST_F(Convert, OpenSfmShotsInTheGrid) {
  ConvertOptions options;
  options.crs = "EPSG:25832";
  // 1000 m east, 500 m north, 20 m up: t = -R c with R = [[1,0,0],[0,0,-1],[0,1,0]].
  Write("reconstruction.json",
        Reconstruction(kPerspective, std::string(kNorth) + "\"translation\": [-1000, 20, -500]"));
  const Dataset dataset = ReadInput(folder_ / "reconstruction.json", "", options);
  const Query& query = dataset.queries.at(0);
  EXPECT_EQ(query.id, "IMG_1");
  EXPECT_EQ(query.camera->model, "RADIAL");
  EXPECT_EQ(query.camera->params, (std::vector<double>{3400.0, 2000.0, 1500.0, -0.02, 0.003}));
  // Worked out apart: the ellipsoid by Newton's method, the grid by Krueger's series.
  EXPECT_NEAR(query.truth->center_in_world.x(), 691976.97697, 2e-3);
  EXPECT_NEAR(query.truth->center_in_world.y(), 5336573.58934, 2e-3);
  EXPECT_NEAR(query.truth->center_in_world.z(), 580.09786, 1e-4);
  // True north of the reference is -1.92350 + 0.01001 from grid north at the camera, whose meridian
  // differs by 0.01344 deg * sin(48.15 deg).
  const ViewAngles angles = ViewAnglesOf(query.truth->cam_from_world);
  EXPECT_NEAR(angles.heading_deg, 360.0 - 1.92350 + 0.01001, 2e-4);
  // The ground falls away by 500 m / 6371 km = 0.0045 deg to the north, so that the camera looks up
  // from it, and twice as much to the east, where the vertical leans away from the camera's top.
  EXPECT_NEAR(angles.pitch_deg, 0.0045, 3e-5);
  EXPECT_NEAR(angles.roll_deg, -0.0090, 5e-5);
}

TEST_F(Convert, OpenSfmsBrownCameras) {
  ConvertOptions options;
  options.crs = "EPSG:25832";
  // The example of OpenDroneMap's documentation, as orthority quotes it.
  Write("r.json",
        Reconstruction("\"projection_type\": \"brown\", \"width\": 1368, \"height\": 912, "
                       "\"focal_x\": 0.6664614123723713, \"focal_y\": 0.6664614123723713, \"c_x\": "
                       "-0.0015460447606643697, \"c_y\": 0.004751874732641298, \"k1\": -0.264, "
                       "\"k2\": 0.102, \"p1\": 0.00073, \"p2\": 0.00026, \"k3\": -0.0258",
                       std::string(kNorth) + "\"translation\": [0, 0, 0]"));
  const CameraIntrinsics camera = *ReadOpenSfm(folder_ / "r.json", options).queries[0].camera;
  EXPECT_EQ(camera.model, "FULL_OPENCV");
  // Its formula in normalized coordinates against the camera made of it.
  const double x = 0.3;
  const double y = -0.2;
  const double r2 = x * x + y * y;
  const double d = 1.0 - 0.264 * r2 + 0.102 * r2 * r2 - 0.0258 * r2 * r2 * r2;
  const double u = 0.6664614123723713 * (x * d + 2 * 0.00073 * x * y + 0.00026 * (r2 + 2 * x * x)) -
                   0.0015460447606643697;
  const double v = 0.6664614123723713 * (y * d + 2 * 0.00026 * x * y + 0.00073 * (r2 + 2 * y * y)) +
                   0.004751874732641298;
  const Eigen::Vector2d px = camera.Distort({x, y});
  EXPECT_NEAR(px.x(), 1368 * u + 684.0, 1e-9);
  EXPECT_NEAR(px.y(), 1368 * v + 456.0, 1e-9);
}

TEST_F(Convert, BadReconstructionsNameThePlace) {
  const auto error = [&](const std::string& text, const std::string& crs = "EPSG:25832") {
    Write("r.json", text);
    ConvertOptions options;
    options.crs = crs;
    return Message([&] { ReadOpenSfm(folder_ / "r.json", options); });
  };
  const std::string shot = std::string(kNorth) + "\"translation\": [0, 0, 0]";
  const std::string good = Reconstruction(kPerspective, shot);
  EXPECT_EQ(error(good), "");
  EXPECT_THAT(error(good, ""), HasSubstr("--crs: got nothing, expected a projected system"));
  for (std::size_t tenth = 1; tenth < 10; ++tenth) {
    EXPECT_THAT(error(good.substr(0, good.size() * tenth / 10)),
                HasSubstr("got a file that ends early"));
  }
  EXPECT_THAT(error("{}"), HasSubstr("r.json: got object, expected a list of reconstructions"));
  EXPECT_THAT(error("[{\"cameras\": {}, \"shots\": {}}]"),
              HasSubstr("r.json: [0].reference_lla: got nothing"));
  EXPECT_THAT(
      error(Reconstruction("\"projection_type\": \"fisheye\", \"width\": 9, \"height\": 9", shot)),
      HasSubstr("r.json: [0].cameras.v2 dji.projection_type: got \"fisheye\""));
  EXPECT_EQ(error(Reconstruction(kPerspective, "\"rotation\": [0, 1]")),
            "r.json: [0].shots.IMG_1.JPG.rotation: got [0,1], expected three numbers");
  EXPECT_THAT(error(good, "EPSG:4326"), HasSubstr("a place in the reach of EPSG:4326"));
  // Munich in Japan's, in feet, in web Mercator.
  EXPECT_THAT(error(good, "EPSG:6677"), HasSubstr("a place in the reach of EPSG:6677"));
  EXPECT_THAT(error(good, "EPSG:3857"), HasSubstr("EPSG:3857, whose metres are 1.4"));
}

// Metashape's and Pix4D's headers; level to the north-east, and nadir.
TEST_F(Convert, TablesOfOmegaPhiKappa) {
  Write("metashape.txt",
        "# Cameras (2)\n"
        "#Label,X/Easting,Y/Northing,Z/Altitude,Omega,Phi,Kappa,X_est\n"
        "IMG_1.JPG,691000.5,5336000.25,520.125,90.0,-45.0,0.0,1\n"
        "\"IMG 2.JPG\",691001,5336001,521,0,0,0,2\n");
  const Dataset a = ReadInput(folder_ / "metashape.txt", "", {});
  ASSERT_EQ(a.queries.size(), 2u);
  EXPECT_EQ(a.queries[0].truth->center_in_world, Eigen::Vector3d(691000.5, 5336000.25, 520.125));
  const ViewAngles level = ViewAnglesOf(a.queries[0].truth->cam_from_world);
  EXPECT_NEAR(level.heading_deg, 45.0, 1e-12);
  EXPECT_NEAR(level.pitch_deg, 0.0, 1e-12);
  EXPECT_EQ(a.queries[1].image, "IMG 2.JPG");
  EXPECT_NEAR(ViewAnglesOf(a.queries[1].truth->cam_from_world).pitch_deg, -90.0, 1e-12);
  Write("pix4d.txt",
        "imageName X Y Z Omega Phi Kappa\nIMG_1.JPG 691000.5 5336000.25 520.125 90 -45 0\n");
  const Dataset b = ReadInput(folder_ / "pix4d.txt", "", {});
  EXPECT_EQ(b.queries[0].truth->cam_from_world.coeffs(),
            a.queries[0].truth->cam_from_world.coeffs());
  Write("german.csv", "Name;E;N;H;Kappa;Phi;Omega\r\nIMG_1;1;2;3;0;-45;90\r\n");
  const Dataset c = ReadInput(folder_ / "german.csv", "", {});
  EXPECT_EQ(c.queries[0].truth->cam_from_world.coeffs(),
            a.queries[0].truth->cam_from_world.coeffs());
}

// Tilted by 30 deg from straight down to the four sides, as Pix4D, Metashape, ODM and BINGO write
// it, and three angles at once, against SciPy's from_euler("XYZ") (tests/camera has the matrix).
TEST_F(Convert, OmegaPhiKappaInTheOrderOfOtherPrograms) {
  Write("opk.csv",
        "image,easting,northing,height,omega,phi,kappa\nnorth,1,2,3,30,0,0\neast,1,2,3,0,-30,-90\n"
        "south,1,2,3,-30,0,-180\nwest,1,2,3,0,30,90\nany,1,2,3,24.5,-37.25,68.75\n");
  const Dataset dataset = ReadInput(folder_ / "opk.csv", "", {});
  for (std::size_t i = 0; i < 4; ++i) {
    const ViewAngles view = ViewAnglesOf(dataset.queries[i].truth->cam_from_world);
    EXPECT_NEAR(HeadingDifferenceDeg(view.heading_deg, 90.0 * static_cast<double>(i)), 0.0, 1e-9);
    EXPECT_NEAR(view.pitch_deg, -60.0, 1e-9);
    EXPECT_NEAR(view.roll_deg, 0.0, 1e-9);
  }
  const Eigen::Matrix3d r = dataset.queries[4].truth->cam_from_world.toRotationMatrix();
  EXPECT_TRUE(
      r.row(0).isApprox(Eigen::RowVector3d(0.288501404269, 0.757115012377, 0.586126093744), 1e-10));
  EXPECT_TRUE(r.row(2).isApprox(Eigen::RowVector3d(0.605293988043, 0.330096651592, -0.724330993847),
                                1e-10));
}

TEST_F(Convert, BadTablesNameFileAndLine) {
  const auto error = [&](const std::string& text) {
    Write("t.csv", text);
    return Message([&] { ReadAngleTable(folder_ / "t.csv", {}); });
  };
  EXPECT_EQ(
      error("image,e,n,h,omega,phi\na,1,2,3,4,5\n"),
      "t.csv: line 1: got no column kappa, expected columns image, easting, northing, height, "
      "omega, phi, kappa");
  EXPECT_EQ(error("image,e,n,h,omega,phi,kappa\na,1,2,3,4,5\n"),
            "t.csv: line 2: got 6 columns, expected a number for kappa");
  EXPECT_EQ(error("image,e,n,h,omega,phi,kappa\na,1,2,3,4,5,6\nb,1,2,,4,5,6\n"),
            "t.csv: line 3: got \"\", expected a number for height");
  EXPECT_THAT(error("a,1,2,3\n"), HasSubstr("t.csv: line 1: got no names of columns"));
  EXPECT_THAT(error("image,e,n,h,omega,phi,kappa\n"), HasSubstr("t.csv: got no picture"));
}

// One picture in Munich, level, to grid north-east, rolled clockwise.
Dataset OnePose() {
  Dataset dataset;
  dataset.name = "a & b";
  dataset.crs = "EPSG:25832";
  dataset.file = "dataset.json";
  Query query;
  query.id = "000";
  query.image = "images/000.jpg";
  query.truth =
      Pose{CamFromWorld(ViewAngles{45.0, 10.0, 3.0}), {690994.2687, 5336040.5004, 517.25}};
  dataset.queries.push_back(query);
  return dataset;
}

TEST(GlobeFiles, GeoJsonAsRfc7946) {
  const auto json = nlohmann::json::parse(PosesGeoJson(OnePose()));
  EXPECT_EQ(json["type"], "FeatureCollection");
  const auto& feature = json["features"][0];
  EXPECT_EQ(feature["geometry"]["type"], "Point");
  // Longitude first; from Krueger's series.
  EXPECT_NEAR(feature["geometry"]["coordinates"][0].get<double>(), 11.567891, 3e-8);
  EXPECT_NEAR(feature["geometry"]["coordinates"][1].get<double>(), 48.148912, 3e-8);
  EXPECT_EQ(feature["geometry"]["coordinates"][2], 517.25);
  EXPECT_NEAR(feature["properties"]["heading_deg"].get<double>(), 45.0, 1e-6);
  EXPECT_NEAR(feature["properties"]["true_heading_deg"].get<double>(), 46.91335, 1e-4);
  EXPECT_FALSE(json.contains("crs"));  // RFC 7946 has WGS 84 only
}

TEST(GlobeFiles, KmlsCameraTurnsTheOtherWay) {
  const std::string kml = PosesKml(OnePose());
  EXPECT_THAT(kml, HasSubstr("<tilt>100</tilt><roll>-3</roll>"));
  EXPECT_THAT(kml, HasSubstr("<heading>46.91335"));
  EXPECT_THAT(kml, HasSubstr("<name>a &amp; b</name>"));
  EXPECT_THAT(kml, HasSubstr("<altitudeMode>absolute</altitudeMode>"));
}

TEST(GlobeFiles, NeedASystem) {
  Dataset dataset = OnePose();
  dataset.crs.clear();
  EXPECT_THROW(PosesKml(dataset), InputError);
}

TEST(Trajectory, NumbersAreExact) {
  const Dataset dataset = OnePose();
  std::istringstream text(TumTrajectory(dataset));
  std::string line;
  while (std::getline(text, line) && line.front() == '#') continue;
  std::istringstream numbers(line);
  double time = -1.0;
  Eigen::Vector3d p;
  Eigen::Quaterniond q;
  numbers >> time >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w();
  EXPECT_EQ(time, 0.0);
  EXPECT_EQ(p, dataset.queries[0].truth->center_in_world);
  EXPECT_EQ(q.conjugate().coeffs(), dataset.queries[0].truth->cam_from_world.coeffs());
}

TEST_F(Convert, ResultsOfBenchAndLocalize) {
  Write("results.csv",
        "query,seed,status,energy,confidence,e,n,h,qw,qx,qy,qz,t_err_m\n"
        "000,1,ok,0.1,0.9,691000.5,5336000.25,520.125,0.5,0.5,-0.5,0.5,0.1\n"
        "000,2,ok,0.1,0.9,1,2,3,1,0,0,0,0.1\n"
        "001,1,abstained,0.1,0.1,,,,,,,,\n");
  const Dataset bench = ReadInput(folder_ / "results.csv", "", {});
  ASSERT_EQ(bench.queries.size(), 1u);
  EXPECT_EQ(bench.queries[0].truth->center_in_world.x(), 691000.5);
  // The same pose as bench's poses.txt has it: t = -R (c - origin), R =
  // [[0,-1,0],[0,0,-1],[1,0,0]].
  Write("poses.txt",
        "# origin 691000.0 5336000.0 500.0 (east north height)\n# query seed qw qx qy qz tx ty tz\n"
        "000 1 0.5 0.5 -0.5 0.5 0.25 20.125 -0.5\n");
  const Dataset poses = ReadInput(folder_ / "poses.txt", "", {});
  EXPECT_LT(
      (poses.queries[0].truth->center_in_world - bench.queries[0].truth->center_in_world).norm(),
      1e-8);
  Write("pose.json",
        "{\"picture\": \"a/000.jpg\", \"status\": \"ok\", \"crs\": \"EPSG:25832\", \"pose\": "
        "{\"position\": [691000.5, 5336000.25, 520.125], \"cam_from_world_wxyz\": [0.5, 0.5, -0.5, "
        "0.5]}}");
  const Dataset pose = ReadInput(folder_ / "pose.json", "", {});
  EXPECT_EQ(pose.crs, "EPSG:25832");
  EXPECT_EQ(pose.queries[0].id, "000");
  EXPECT_EQ(pose.queries[0].truth->center_in_world, bench.queries[0].truth->center_in_world);
  Write("none.json", "{\"status\": \"abstained\"}");
  EXPECT_THAT(
      Message([&] { ReadInput(folder_ / "none.json", "", {}); }),
      HasSubstr("none.json: pose: got nothing usable, expected a pose; this run abstained"));
}

TEST_F(Convert, FormatsAreFoundOutOrAskedFor) {
  Write("x.txt", "hello\n");
  EXPECT_THAT(Message([&] { FormatOfInput(folder_ / "x.txt"); }),
              HasSubstr("x.txt: got no format that is known"));
  EXPECT_THAT(Message([&] { FormatOfInput(folder_ / "no.txt"); }), HasSubstr("got no such file"));
  EXPECT_THAT(Message([&] { ReadInput(folder_ / "x.txt", "bundler", {}); }),
              HasSubstr("--from: got \"bundler\", expected one of colmap"));
  EXPECT_THAT(Message([&] { FormatOfOutput("poses.xml"); }), HasSubstr("--out: got poses.xml"));
  EXPECT_EQ(FormatOfOutput("sparse"), "colmap");
}

TEST_F(Convert, EqualNamesInTwoFoldersKeepTheirFolders) {
  Write("l.txt", "a/0.jpg 1 0 0 0 0 0 0\nb/0.jpg 1 0 0 0 0 0 0\nc.jpg 1 0 0 0 0 0 0\n");
  const Dataset dataset = ReadInput(folder_ / "l.txt", "", {});
  EXPECT_EQ(dataset.queries[0].id, "a/0");
  EXPECT_EQ(dataset.queries[1].id, "b/0");
  EXPECT_EQ(dataset.queries[2].id, "c");
  Write("l.txt", "a.jpg 1 0 0 0 0 0 0\na.jpg 1 0 0 0 0 0 0\n");
  EXPECT_THAT(Message([&] { ReadInput(folder_ / "l.txt", "", {}); }),
              HasSubstr("the picture a.jpg again"));
}

}  // namespace
}  // namespace ridgeline
