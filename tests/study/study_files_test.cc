// SPDX-License-Identifier: Apache-2.0
#include "study/study_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace ridgeline {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class StudyFiles : public ::testing::Test {
 protected:
  StudyFiles() {
    Query query;
    query.id = "a,\"b\"";
    query.truth.emplace();
    dataset_.queries = {query};
    scores_ = {{"skyline_l1", {}}};
    scores_[0].options.name = "skyline_l1";
    study_.map.columns = 2;
    study_.map.rows = 1;
    study_.map.first = {690000.0, 5335000.0};
    study_.map.energies = {0.25f, NAN};
    study_.map.headings_deg = {90.0f, NAN};
  }
  static long Lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

  Dataset dataset_;
  std::vector<ScoreChoice> scores_;
  ScoreStudy study_;
};

TEST_F(StudyFiles, WhatIsNotDefinedIsAnEmptyField) {
  EXPECT_EQ(MapCsv(study_.map),
            "east,north,energy,heading_deg\n690000.000,5335000.000,0.250000,90.000\n"
            "690001.000,5335000.000,,\n");
  const StudyNames names{dataset_, scores_, {}};
  const std::string csv = FiguresCsv(names, std::vector<ScoreStudy>{study_});
  EXPECT_EQ(Lines(csv), 2);
  EXPECT_THAT(csv, HasSubstr("\n\"a,\"\"b\"\"\",,skyline_l1,,,"));
}

TEST_F(StudyFiles, RowsHaveAsManyFieldsAsTheHeader) {
  const StudyNames names{dataset_, scores_, {}};
  dataset_.queries[0].id = "a";
  study_.figures.emplace();
  study_.sampled = {{1, 50, 0.5, 1.0, 1.0, 2.0}};
  study_.heading_deg = {10.0};
  study_.heading_energy = {0.5};
  study_.by_distance = {{0.0, 1.0, 3, 0.5, 2.0, 1.0}};
  const std::vector<ScoreStudy> studies = {study_};
  for (const std::string& csv :
       {FiguresCsv(names, studies),
        HeadingsCsv(names, studies),
        ProfilesCsv(names, studies),
        SampledCsv(names, studies),
        SummaryCsv(FindProtocol("known-tilt"), SummariesOf(studies, scores_, "town"))}) {
    const std::string header = csv.substr(0, csv.find('\n'));
    const std::string row = csv.substr(header.size() + 1);
    EXPECT_EQ(Lines(csv), 2) << csv;
    EXPECT_EQ(std::count(header.begin(), header.end(), ','),
              std::count(row.begin(), row.end(), ','))
        << csv;
  }
}

TEST_F(StudyFiles, TheSkylinesDistanceIsGivenInPixels) {
  // energy = d / (d + 20)
  EXPECT_NEAR(SkylineDistanceOf(0.25, scores_[0].options), 20.0 / 3.0, 1e-9);
  ExploredMap explored{study_.map, {1.0f, NAN}, {2.0f, NAN}};
  const std::string csv = ExploredCsv(explored, scores_[0]);
  EXPECT_THAT(csv, StartsWith("east,north,energy,heading_deg,pitch_deg,roll_deg,l1_px\n"));
  EXPECT_THAT(csv, HasSubstr(",0.250000,90.000,1.000,2.000,6.667\n"));
}

TEST_F(StudyFiles, JsonHasNullForWhatIsNotDefined) {
  study_.figures.emplace();
  const std::string json =
      StudySummaryJson("town",
                       FindProtocol("known-tilt"),
                       SummariesOf(std::vector<ScoreStudy>{study_}, scores_, "town"));
  EXPECT_THAT(json, HasSubstr("\"better_share\": null"));
  EXPECT_THAT(json, HasSubstr("\"2m_2deg\": 1.0"));
}

}  // namespace
}  // namespace ridgeline
