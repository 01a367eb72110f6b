// SPDX-License-Identifier: Apache-2.0
#include "study/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "eval/metrics.h"
#include "study/study_files.h"
#include "study/study_summary.h"
#include "support/street_study.h"

namespace ridgeline {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Study : public ::testing::Test {
 protected:
  StudyOptions Options(int threads = 0) const {
    StudyOptions options;
    options.classes = {10, 25};
    options.threads = threads;
    return options;
  }
  static BenchQueries Source(const Dataset& dataset) {
    return {PerturbedProtocol("3,3,0,8"), dataset, {}};
  }
  std::vector<ScoreStudy> Studies(const std::vector<std::string>& names, int threads = 0) const {
    const std::vector<std::size_t> queries = {0};
    return RunStudy(Source(street_.dataset()),
                    queries,
                    street_.localizer(),
                    ChooseScores(names, street_.localizer().options().score),
                    Options(threads),
                    {});
  }
  std::string ErrorOfQueries(const std::vector<std::string>& ids) const {
    try {
      StudyQueries(street_.dataset(), ids);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  ::ridgeline::testing::StreetStudy street_;
};

TEST_F(Study, MapsEveryScoreOfTheFactoryAndEveryCue) {
  const std::vector<std::string> names = StudyScoreNames();
  const std::vector<ScoreStudy> studies = Studies({"all"});
  ASSERT_EQ(studies.size(), names.size());
  const Pose truth = *street_.dataset().queries[0].truth;
  for (std::size_t s = 0; s < studies.size(); ++s) {
    const ScoreStudy& study = studies[s];
    ASSERT_TRUE(study.figures.has_value()) << names[s];
    const PoseError error = ErrorOf(study.minimum, truth);
    EXPECT_NEAR(study.figures->minimum_m, error.translation_m, 1e-6) << names[s];
    EXPECT_NEAR(study.figures->minimum_deg, error.rotation_deg, 1e-6) << names[s];
    EXPECT_EQ(study.map.columns, 7);
    EXPECT_EQ(study.heading_deg.size(), 9u);
    // The least energy over headings and over positions is the same.
    const float least = *std::min_element(study.map.energies.begin(), study.map.energies.end());
    EXPECT_NEAR(
        *std::min_element(study.heading_energy.begin(), study.heading_energy.end()), least, 1e-6)
        << names[s];
    ASSERT_EQ(study.sampled.size(), 25u) << names[s];
    for (const SampledPose& pose : study.sampled) {
      EXPECT_EQ(pose.after, pose.evaluation <= 10 ? 10 : 25);
      EXPECT_LE(pose.translation_m, std::hypot(6.0, 6.0) + 1e-9);
      EXPECT_GE(pose.energy, 0.0);
      EXPECT_LE(pose.energy, 1.0);
    }
  }
}

TEST_F(Study, FindsTheTruthOfAPlainPictureWithTheDefaultScore) {
  const ScoreStudy study = Studies({}).front();
  EXPECT_LE(study.figures->minimum_m, 2.0);
  EXPECT_LE(study.figures->minimum_deg, 2.0);
  EXPECT_EQ(study.figures->better_share, 0.0);
  EXPECT_GT(study.visible_edges, 10);
  EXPECT_GT(study.picture_lines, 10);
}

TEST_F(Study, APictureThatShowsNothingHasNoFiguresAndAReason) {
  Dataset dataset = street_.dataset();
  dataset.queries[0].image = dataset.queries[0].image.parent_path() / "black.png";
  cv::imwrite(dataset.queries[0].image.string(), cv::Mat::zeros(240, 320, CV_8UC3));
  const std::vector<std::size_t> queries = {0};
  const std::vector<ScoreChoice> scores =
      ChooseScores({"all"}, street_.localizer().options().score);
  const std::vector<ScoreStudy> studies =
      RunStudy(Source(dataset), queries, street_.localizer(), scores, Options(), {});
  ASSERT_EQ(studies.size(), scores.size());
  for (std::size_t s = 0; s < studies.size(); ++s) {
    EXPECT_FALSE(studies[s].figures.has_value()) << scores[s].name;
    EXPECT_THAT(studies[s].reason, HasSubstr("picture")) << scores[s].name;
    for (const float energy : studies[s].map.energies) EXPECT_EQ(energy, 1.0f) << scores[s].name;
  }
  EXPECT_THAT(FiguresCsv({dataset, scores, {}}, studies), HasSubstr("no lines"));
}

TEST_F(Study, IsTheSameOnAnyNumberOfThreads) {
  const ScoreStudy one = Studies({"evidence"}, 1).front();
  const ScoreStudy many = Studies({"evidence"}, 8).front();
  EXPECT_EQ(one.map.energies, many.map.energies);
  EXPECT_EQ(one.figures->better_share, many.figures->better_share);
  ASSERT_EQ(one.sampled.size(), many.sampled.size());
  for (std::size_t i = 0; i < one.sampled.size(); ++i) {
    EXPECT_EQ(one.sampled[i].energy, many.sampled[i].energy);
  }
}

TEST_F(Study, ALevelThatChangesNothingGivesTheStudyItself) {
  const std::vector<Variation> variations = {ParseVariation("heights=0"),
                                             ParseVariation("focal=0,-20")};
  const std::vector<std::size_t> queries = {0};
  const std::vector<ScoreChoice> scores =
      ChooseScores({"evidence"}, street_.localizer().options().score);
  const std::vector<VariedStudy> varied = RunVariations(
      Source(street_.dataset()), queries, street_.localizer(), scores, variations, Options(), {});
  ASSERT_EQ(varied.size(), 3u);
  const ScoreStudy plain = Studies({"evidence"}).front();
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(varied[i].study.figures->minimum, plain.figures->minimum);
    EXPECT_EQ(varied[i].study.figures->rank_correlation, plain.figures->rank_correlation);
  }
  EXPECT_NE(varied[2].study.figures->rank_correlation, plain.figures->rank_correlation);
  const auto levels = LevelSummariesOf(varied, scores);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[2].level, 1u);
}

TEST_F(Study, BadInputIsNamed) {
  EXPECT_EQ(StudyQueries(street_.dataset(), {}), std::vector<std::size_t>{0});
  EXPECT_THAT(ErrorOfQueries({"street, 2"}), AllOf(HasSubstr("--query"), HasSubstr("street, 1")));
  EXPECT_THAT(ErrorOfQueries({"unknown"}), HasSubstr("queries[1].truth: got none"));
  Dataset without = street_.dataset();
  without.queries.erase(without.queries.begin());
  EXPECT_THROW(StudyQueries(without, {}), InputError);
  EXPECT_THROW(ChooseScores({"evidense"}, {}), InputError);
  StudyOptions options;
  options.classes = {50, 20};
  EXPECT_THROW(options.Validate(), InputError);
}

TEST_F(Study, ACueIsTheEvidenceWithItsWeightAlone) {
  ScoreOptions base;
  base.weights["sky"] = 6.0;
  base.weights["facade_colours"] = 0.0;
  const auto choices = ChooseScores({"sky", "line_energy", "sky", "facade_colours"}, base);
  ASSERT_EQ(choices.size(), 3u);
  EXPECT_EQ(choices[0].options.name, "evidence");
  EXPECT_EQ(choices[0].options.weights, (std::map<std::string, double>{{"sky", 6.0}}));
  EXPECT_EQ(choices[1].options.name, "line_energy");
  EXPECT_EQ(choices[2].options.weights, (std::map<std::string, double>{{"facade_colours", 1.0}}));
}

TEST(StudySummary, CountsQueriesWithoutFiguresAsNotFound) {
  std::vector<ScoreStudy> studies(4);
  const double minima[3] = {1.0, 4.0, 20.0};
  for (int i = 0; i < 3; ++i) {
    studies[i].figures.emplace();
    studies[i].figures->minimum_m = minima[i];
    studies[i].set = i == 0 ? "a" : "b";
  }
  studies[3].set = "b";
  const std::vector<ScoreChoice> scores = {{"evidence", {}}};
  const auto summaries = SummariesOf(studies, scores, "town");
  ASSERT_EQ(summaries.size(), 3u);  // a, all, b
  EXPECT_EQ(summaries[1].set, "all");
  EXPECT_EQ(summaries[1].queries, 4);
  EXPECT_EQ(summaries[1].with_figures, 3);
  EXPECT_DOUBLE_EQ(summaries[1].recall[0], 0.25);
  EXPECT_DOUBLE_EQ(summaries[1].recall[1], 0.5);
  EXPECT_DOUBLE_EQ(summaries[1].median[0], 4.0);
}

TEST(StudySummary, GroupsByEnergyAreOfEqualSize) {
  std::vector<ScoreStudy> studies(2);
  for (int i = 0; i < 9; ++i) {
    // Energies 0.8, 0.7, ..., 0; errors 10 and 20 times the energy.
    studies[i % 2].sampled.push_back({i + 1, 10, 0.8 - 0.1 * i, 8.0 - i, 8.0 - i, 16.0 - 2.0 * i});
  }
  studies[0].sampled.push_back({11, 20, -1.0, 99.0, 99.0, 99.0});  // too late
  const auto groups = ByEnergy(studies, 0, 10, 3);
  ASSERT_EQ(groups.size(), 3u);
  for (int g = 0; g < 3; ++g) {
    EXPECT_NEAR(groups[g].energy, 0.1 + 0.3 * g, 1e-9);
    EXPECT_NEAR(groups[g].translation_m, 1.0 + 3.0 * g, 1e-9);
    EXPECT_NEAR(groups[g].rotation_deg, 2.0 + 6.0 * g, 1e-9);
  }
  EXPECT_EQ(ByEnergy(studies, 0, 2, 12).size(), 2u);
  EXPECT_TRUE(ByEnergy(studies, 1, 10, 3).empty());
}

}  // namespace
}  // namespace ridgeline
