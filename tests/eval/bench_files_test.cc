// SPDX-License-Identifier: Apache-2.0
#include "eval/bench_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/error.h"

namespace ridgeline {
namespace {

RunRecord Answer() {
  RunRecord run;
  run.query = "a,\"b\"";
  run.seed = 3;
  run.status = "ok";
  run.pose = Pose{CamFromWorld(ViewAngles{30.0, 0.0, 0.0}), {690000.25, 5335000.5, 517.0}};
  run.energy = 0.25;
  run.confidence = 0.75;
  run.evaluations = 12;
  run.seconds = 1.5;
  return run;
}

TEST(ResultsCsv, QuotesNamesAndLeavesUnknownFieldsEmpty) {
  RunRecord abstained;
  abstained.query = "c";
  abstained.status = "abstained";
  const std::vector<RunRecord> runs = {Answer(), abstained};
  const std::string csv = ResultsCsv(runs);
  EXPECT_THAT(csv, testing::HasSubstr("\n\"a,\"\"b\"\"\",3,ok,0.250000,0.750000,690000.2500,"));
  EXPECT_THAT(csv, testing::HasSubstr("\nc,0,abstained,1.000000,0.000000,,,,,,,,,,,0,0.000\n"));
}

TEST(SummaryJson, WithoutTruthErrorsAreNullAndNotZero) {
  RunRecord run = Answer();
  run.confidence = 0.95;
  const auto json =
      nlohmann::json::parse(SummaryJson("d", "default", Protocol{}, std::vector<RunRecord>{run}));
  EXPECT_EQ(json["runs_with_truth"], 0);
  EXPECT_TRUE(json["recall"].is_null());
  EXPECT_TRUE(json["translation_error_m"].is_null());
  EXPECT_TRUE(json["coverage_95"].is_null());
  EXPECT_DOUBLE_EQ(json["confidence_0.9"]["share"].get<double>(), 1.0);

  run.has_truth = true;
  run.error = PoseError{0.3, 0.3, 0.1};
  const auto known =
      nlohmann::json::parse(SummaryJson("d", "default", Protocol{}, std::vector<RunRecord>{run}));
  EXPECT_DOUBLE_EQ(known["recall"]["2m_2deg"].get<double>(), 1.0);
}

TEST(PosesCsv, OwnResultsAreReadBack) {
  RunRecord run = Answer();
  run.query = "q";
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("ridgeline_poses_" + std::to_string(::getpid()) + ".csv");
  WriteFileAtomically(path, ResultsCsv(std::vector<RunRecord>{run}));
  const auto poses = ReadPosesCsv(path);
  ASSERT_EQ(poses.count("q"), 1u);
  const Pose& pose = poses.at("q");
  EXPECT_LT((pose.center_in_world - run.pose->center_in_world).norm(), 1e-4);
  EXPECT_LT(RotationDistanceDeg(pose.cam_from_world, run.pose->cam_from_world), 1e-6);
}

TEST(PosesCsv, BadFilesAreNamed) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("ridgeline_poses_" + std::to_string(::getpid()) + ".csv");
  for (const char* bad :
       {"query,e,n\n", "query,e,n,h,qw,qx,qy,qz\n", "query,e,n,h,qw,qx,qy,qz\na,1,2,x,1,0,0,0\n",
        "query,e,n,h,qw,qx,qy,qz\na,1,2,3,1,0,0,0\na,4,5,6,1,0,0,0\n"}) {
    WriteFileAtomically(path, bad);
    EXPECT_THROW(ReadPosesCsv(path), InputError) << bad;
  }
}

TEST(PosesText, TranslationIsColmapsAboutTheOrigin) {
  const Eigen::Vector3d origin(690000.0, 5335000.0, 500.0);
  RunRecord run = Answer();
  run.query = "q";
  const std::string text = PosesText(std::vector<RunRecord>{run}, origin);
  const Eigen::Vector3d t = -(run.pose->cam_from_world * (run.pose->center_in_world - origin));
  char expected[100];
  std::snprintf(expected, sizeof(expected), "%.5f %.5f %.5f\n", t.x(), t.y(), t.z());
  EXPECT_THAT(text, testing::EndsWith(expected));
  EXPECT_THAT(text, testing::HasSubstr("# origin 690000.0 5335000.0 500.0"));
}

}  // namespace
}  // namespace ridgeline
