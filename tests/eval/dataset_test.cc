// SPDX-License-Identifier: Apache-2.0
#include "eval/dataset.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/perturb.h"

namespace ridgeline {
namespace {

constexpr const char* kGood = R"({
  "name": "town", "crs": "EPSG:25832", "model": ["town.gml"], "dtm": "dtm.tif",
  "queries": [{"id": "000", "image": "images/000.jpg", "set": "street",
    "camera": {"model": "PINHOLE", "width": 640, "height": 480, "params": [500, 500, 320, 240]},
    "prior": {"position": [690896.1, 5335940.9], "heading_deg": -10},
    "truth": {"position": [690896.6, 5335941.1, 517.0], "cam_from_world_wxyz": [0.5, -0.5, 0.5, -0.5]}}]
})";

std::filesystem::path Write(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("ridgeline_dataset_" + std::to_string(::getpid()) + ".json");
  WriteFileAtomically(path, text);
  return path;
}

std::string Replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string MessageOf(const std::string& text) {
  try {
    ReadDataset(Write(text));
  } catch (const InputError& e) {
    return std::string(e.what()).substr(std::string(e.what()).find(".json: ") + 7);
  }
  return "no error";
}

TEST(Dataset, ReadsAllParts) {
  const Dataset dataset = ReadDataset(Write(kGood));
  EXPECT_EQ(dataset.name, "town");
  ASSERT_EQ(dataset.queries.size(), 1u);
  const Query& query = dataset.queries[0];
  EXPECT_EQ(query.image.parent_path().parent_path(), dataset.file.parent_path());
  EXPECT_EQ(query.prior->heading_deg, 350.0);
  EXPECT_FALSE(query.prior->height_in_world.has_value());
  EXPECT_FALSE(query.prior->pitch_deg.has_value());
  EXPECT_EQ(query.truth->center_in_world.z(), 517.0);
}

TEST(Dataset, BadInputIsNamedByItsPlace) {
  EXPECT_EQ(MessageOf(Replaced("\"heading_deg\": -10", "\"heading_deg\": 412.5")),
            "queries[0].prior.heading_deg: got 412.5, expected a number in [-360, 360]");
  EXPECT_EQ(MessageOf(Replaced("\"heading_deg\"", "\"heding_deg\"")),
            "queries[0].prior.heding_deg: got an unknown key, expected e.g. \"heading_deg\"");
  EXPECT_EQ(MessageOf(Replaced("[690896.1, 5335940.9]", "[690896.1]")),
            "queries[0].prior.position: got 1 numbers, expected [east, north] or [east, north, "
            "height]");
  EXPECT_EQ(MessageOf(Replaced("\"width\": 640", "\"width\": 640.5")),
            "queries[0].camera.width: got 640.5, expected a whole number");
  EXPECT_EQ(MessageOf(Replaced("\"image\"", "\"set\": \"x\", \"lines\"")),
            "queries[0].image: got nothing, expected this key");
  EXPECT_EQ(MessageOf(Replaced("[0.5, -0.5, 0.5, -0.5]", "[0.5, -0.5, 0.5, 0.9]")).substr(0, 44),
            "queries[0].truth.cam_from_world_wxyz: got no");
  EXPECT_EQ(MessageOf(R"({"name": "x", "model": ["a.gml"], "queries": []})"),
            "queries: got an empty list, expected at least one query");
  EXPECT_EQ(MessageOf("{").substr(0, 4), "byte");
}

TEST(Dataset, IdsMustDiffer) {
  std::string text = kGood;
  const std::size_t first = text.find("[{\"id\"") + 1;
  const std::string query = text.substr(first, text.rfind("]") - first);
  text.insert(first, query + ",");
  EXPECT_EQ(MessageOf(text), "queries[1]: got the id \"000\" again, expected ids that differ");
}

TEST(DrawPrior, DependsOnSeedAndIdAloneAndStaysInRange) {
  const Pose truth{CamFromWorld(ViewAngles{350.0, 3.0, -2.0}), {1000.0, 2000.0, 300.0}};
  const Perturbation half{10.0, 5.0, 1.0, 20.0, 4.0, 3.0};
  const PosePrior once = DrawPrior(truth, half, 1, "007");
  EXPECT_EQ(DrawPrior(truth, half, 1, "007").position_in_world, once.position_in_world);
  EXPECT_NE(DrawPrior(truth, half, 2, "007").position_in_world, once.position_in_world);
  EXPECT_NE(DrawPrior(truth, half, 1, "008").position_in_world, once.position_in_world);
  double mean_east = 0.0;
  for (int seed = 0; seed < 2000; ++seed) {
    const PosePrior prior = DrawPrior(truth, half, seed, "007");
    mean_east += (prior.position_in_world.x() - 1000.0) / 2000.0;
    EXPECT_LE(std::abs(prior.position_in_world.x() - 1000.0), 10.0);
    EXPECT_LE(std::abs(prior.position_in_world.y() - 2000.0), 5.0);
    EXPECT_LE(std::abs(*prior.height_in_world - 300.0), 1.0);
    EXPECT_LE(std::abs(HeadingDifferenceDeg(*prior.heading_deg, 350.0)), 20.0 + 1e-9);
    EXPECT_LE(std::abs(*prior.pitch_deg - 3.0), 4.0 + 1e-9);
    EXPECT_LE(std::abs(*prior.roll_deg + 2.0), 3.0 + 1e-9);
  }
  // Standard error of the mean: 10 / sqrt(3) / sqrt(2000) = 0.13; five of them.
  EXPECT_NEAR(mean_east, 0.0, 0.65);
}

TEST(ParsePerturbation, TakesFourOrSixNumbers) {
  EXPECT_EQ(ParsePerturbation("10,10,0,20").heading_deg, 20.0);
  EXPECT_EQ(ParsePerturbation("10,10,10,15,5,4").roll_deg, 4.0);
  for (const char* bad : {"", "10,10,0", "10,10,0,x", "10,10,0,-20", "1,2,3,4,5"}) {
    EXPECT_THROW(ParsePerturbation(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace ridgeline
