// SPDX-License-Identifier: Apache-2.0
#include "eval/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "eval/bench_files.h"
#include "eval/comparison_files.h"
#include "eval/results_csv.h"

namespace ridgeline {
namespace {

using ::testing::HasSubstr;

RunRecord Answered(const std::string& query, int seed, double error_m) {
  RunRecord run;
  run.query = query;
  run.seed = seed;
  run.status = "ok";
  run.energy = 0.1;
  run.confidence = 0.8;
  run.pose = Pose{Eigen::Quaterniond::Identity(), {100.0 + error_m, 200.0, 3.0}};
  run.error = PoseError{error_m, error_m, 0.0};
  run.has_truth = true;
  run.seconds = 1.0 + error_m;
  return run;
}

RunRecord Withheld(const std::string& query, int seed) {
  RunRecord run = Answered(query, seed, 0.0);
  run.status = "abstained";
  run.pose.reset();
  run.error.reset();
  return run;
}

const ComparedFigure& FigureNamed(const Comparison& comparison, const std::string& name) {
  for (const ComparedFigure& figure : comparison.figures) {
    if (figure.name == name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}

// Binomial tails by hand: 1 of 6 is 7/64, 0 of 5 is 1/32; both sides.
TEST(SignTest, HandComputed) {
  EXPECT_NEAR(SignTest(1, 6), 2.0 * 7.0 / 64.0, 1e-12);
  EXPECT_NEAR(SignTest(0, 5), 2.0 / 32.0, 1e-12);
  EXPECT_EQ(SignTest(3, 6), 1.0);
  EXPECT_EQ(SignTest(0, 0), 1.0);
}

// Ten photos of one seed: b is right on six where a is not, a on one where b is not.
TEST(Compare, McNemarOfOneSeedIsTheTextbooks) {
  System a{"a", {}, true};
  System b{"b", {}, true};
  for (int i = 0; i < 10; ++i) {
    const std::string id = "q" + std::to_string(i);
    a.records.push_back(Answered(id, 1, i < 6 ? 5.0 : 1.0));
    b.records.push_back(Answered(id, 1, i == 9 ? 5.0 : 1.0));
  }
  const Comparison comparison = Compare(a, b);
  const ComparedFigure& recall = FigureNamed(comparison, "recall 2m_2deg");
  EXPECT_DOUBLE_EQ(recall.a, 0.4);
  EXPECT_DOUBLE_EQ(recall.b, 0.9);
  EXPECT_DOUBLE_EQ(recall.difference, 0.5);
  EXPECT_NEAR(recall.mcnemar_p, SignTest(1, 7), 1e-12);
  // Six of +1, one of -1, three of 0: the mean of ten such draws has a deviation of 0.21.
  EXPECT_NEAR(recall.ci95.lower, 0.5 - 1.96 * 0.2, 0.15);
  EXPECT_NEAR(recall.ci95.upper, 0.5 + 1.96 * 0.2, 0.15);
  EXPECT_EQ(Compare(a, b).figures[0].ci95.lower, comparison.figures[0].ci95.lower);
}

TEST(Compare, JoinsQueryAndSeed) {
  System a{"a", {Answered("q", 1, 1.0), Answered("q", 2, 3.0), Answered("p", 1, 1.0)}, true};
  System b{"b", {Answered("q", 2, 1.0), Answered("q", 3, 1.0), Answered("p", 1, 1.0)}, true};
  const Comparison comparison = Compare(a, b);
  ASSERT_EQ(comparison.pairs.size(), 2u);
  EXPECT_EQ(comparison.pairs[1].query, "q");
  EXPECT_EQ(comparison.pairs[1].seed, 2);
  EXPECT_EQ(comparison.pairs[1].a->error->translation_m, 3.0);
  EXPECT_THAT(comparison.unpaired,
              ::testing::ElementsAre("q, seed 1: only of a", "q, seed 3: only of b"));
  b.records.push_back(Answered("p", 1, 2.0));
  EXPECT_THROW(Compare(a, b), InputError);
  EXPECT_THROW(Compare(a, {"c", {Answered("x", 1, 1.0)}, true}), InputError);
}

// Another system's one pose stands beside every seed, in either order.
TEST(Compare, PosesWithoutSeedsStandBesideEverySeed) {
  const System ours{"ours", {Answered("q", 1, 1.0), Answered("q", 2, 3.0)}, true};
  RunRecord pose = Answered("q", 1, 0.5);
  pose.is_searched = false;
  pose.confidence = pose.seconds = NAN;
  RunRecord other = pose;
  other.query = "unknown";
  const System theirs{"theirs", {pose, other}, false};
  for (const bool first : {true, false}) {
    const Comparison comparison = first ? Compare(theirs, ours) : Compare(ours, theirs);
    EXPECT_EQ(comparison.pairs.size(), 2u);
    EXPECT_THAT(comparison.unpaired, ::testing::ElementsAre("unknown: only of theirs"));
    // What one of them does not say is not compared.
    const ComparedFigure& confidence = FigureNamed(comparison, "mean confidence");
    EXPECT_EQ(confidence.queries, 0);
    EXPECT_TRUE(std::isnan(confidence.difference));
    EXPECT_EQ(FigureNamed(comparison, "recall 2m_2deg").queries, 1);
  }
}

// Equal answers on eight photos do not prove that there is no difference.
TEST(Compare, NoDifferenceSeenIsNotAPoint) {
  System a{"a", {}, true};
  for (int i = 0; i < 8; ++i) a.records.push_back(Answered("q" + std::to_string(i), 1, 1.0));
  System b = a;
  b.name = "b";
  const ComparedFigure recall = FigureNamed(Compare(a, b), "recall 2m_2deg");
  EXPECT_EQ(recall.difference, 0.0);
  EXPECT_NEAR(recall.ci95.upper, WilsonInterval(0.0, 8).upper, 1e-12);
  EXPECT_NEAR(recall.ci95.lower, -WilsonInterval(0.0, 8).upper, 1e-12);
}

TEST(Compare, NamesDisagreements) {
  const RunRecord right = Answered("q", 1, 1.0);
  const RunRecord wrong = Answered("q", 1, 9.0);
  const RunRecord none = Withheld("q", 1);
  const auto of = [](const RunRecord& a, const RunRecord& b) {
    return DisagreementOf({"q", 1, &a, &b});
  };
  EXPECT_EQ(of(right, right), Disagreement::kNone);
  EXPECT_EQ(of(right, wrong), Disagreement::kOnlyA);
  EXPECT_EQ(of(none, right), Disagreement::kOnlyB);
  EXPECT_EQ(of(none, wrong), Disagreement::kOneAnswers);
  EXPECT_EQ(of(none, none), Disagreement::kNone);
  EXPECT_EQ(of(wrong, Answered("q", 1, 20.0)), Disagreement::kApart);
}

TEST(ResultsCsv, IsReadBackWithItsBlanks) {
  std::vector<RunRecord> runs = {Answered("a, \"b\"", 2, 1.5), Withheld("c", 1)};
  runs.push_back(Answered("given", 1, 0.5));
  runs.back().is_searched = false;
  runs.back().confidence = runs.back().energy = runs.back().seconds = NAN;
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     ("results_" + std::to_string(::getpid()) + ".csv");
  WriteFileAtomically(file, ResultsCsv(runs));
  const std::vector<RunRecord> read = ReadResultsCsv(file);
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(ResultsCsv(read), ResultsCsv(runs));
  EXPECT_EQ(read[0].query, "a, \"b\"");
  EXPECT_FALSE(read[1].pose.has_value());
  EXPECT_FALSE(read[2].is_searched);
  EXPECT_TRUE(std::isnan(read[2].energy));
  WriteFileAtomically(file, "query,seed\na,1\n");
  EXPECT_THROW(ReadResultsCsv(file), InputError);
  std::filesystem::remove(file);
}

TEST(ComparisonFiles, BlanksAreBlank) {
  System a{"a", {Answered("q", 1, 1.0)}, true};
  System b{"b", {Answered("q", 1, 5.0)}, true};
  b.records[0].confidence = NAN;
  const std::vector<Comparison> comparisons = {Compare(a, b)};
  EXPECT_THAT(ComparisonCsv(comparisons), HasSubstr("a,b,mean confidence,,,,,,,,0,0\n"));
  EXPECT_THAT(PairsCsv(comparisons), HasSubstr("only the first is right\n"));
  EXPECT_THAT(ComparisonJson(comparisons), HasSubstr("\"difference\": null"));
}

}  // namespace
}  // namespace ridgeline
