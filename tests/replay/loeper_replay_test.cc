// SPDX-License-Identifier: Apache-2.0
#include "replay/loeper_replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "replay/loeper_figures.h"
#include "replay/loeper_pages.h"
#include "replay/loeper_table.h"
#include "score/line_energy.h"
#include "support/source_folder.h"
#include "support/street_study.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

LoeperRun RunOf(std::vector<LoeperSample> samples, std::size_t query = 0) {
  LoeperRun run;
  run.query = query;
  run.side_m = 20.0;
  run.heading_deg = 20.0;
  run.samples = std::move(samples);
  return run;
}

TEST(LoeperMethods, AsPrintedIsTheShippedConfiguration) {
  LocalizerOptions shipped;
  OptionsFromJson(ReadFile(fs::path(kSourceFolder) / "configs/paper.json"),
                  "paper.json",
                  [&](OptionVisitor& v) { shipped.Visit(v); });
  LoeperMethod printed = LoeperMethods().front();
  ASSERT_EQ(printed.name, "printed");
  EXPECT_EQ(OptionsToJson([&](OptionVisitor& v) { printed.options.Visit(v); }),
            OptionsToJson([&](OptionVisitor& v) { shipped.Visit(v); }));
  EXPECT_TRUE(printed.around_truth);
  for (const LoeperMethod& method : LoeperMethods()) EXPECT_NO_THROW(method.options.Validate());
}

TEST(LoeperRun, TheBestAfterFewerIterationsIsAmongTheFirst) {
  const LoeperRun run =
      RunOf({{1, 0.9, 1, 1, 1, 1}, {3, 0.4, 2, 2, 2, 2}, {7, 0.2, 3, 3, 3, 3}});
  EXPECT_EQ(run.BestAfter(2)->iteration, 1);
  EXPECT_EQ(run.BestAfter(5)->iteration, 3);
  EXPECT_EQ(run.BestAfter(200)->iteration, 7);
  EXPECT_EQ(RunOf({}).BestAfter(10), nullptr);
}

// Signed means and deviations, worked out by hand.
TEST(LoeperTable, FiguresOfFourPictures) {
  const std::vector<LoeperRun> runs = {RunOf({{1, 0.1, 1.0, 1.0, 1.5, 1.5}}),
                                       RunOf({{1, 0.1, 4.0, 4.0, -4.5, 4.5}}),
                                       RunOf({{1, 0.1, 10.0, 10.0, -12.0, 12.0}}),
                                       RunOf({})};
  const std::vector<LoeperRow> rows = LoeperTable(runs, std::vector<int>{50});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].pictures, 4);
  EXPECT_NEAR(rows[0].recall[0], 0.25, 1e-12);
  EXPECT_NEAR(rows[0].recall[1], 0.5, 1e-12);
  EXPECT_NEAR(rows[0].recall[2], 0.5, 1e-12);
  EXPECT_NEAR(rows[0].mean_translation_m, 5.0, 1e-12);
  EXPECT_NEAR(rows[0].mean_kappa_deg, -5.0, 1e-12);
  EXPECT_NEAR(rows[0].mean_absolute_kappa_deg, 6.0, 1e-12);
  EXPECT_NEAR(rows[0].mad_translation_m, (4.0 + 1.0 + 5.0) / 3.0, 1e-12);
  EXPECT_NEAR(rows[0].mad_kappa_deg, (6.5 + 0.5 + 7.0) / 3.0, 1e-12);
}

TEST(ProjectedEdges, HaveNoOcclusionAndEndAtTheBorder) {
  const CityModel model = testing::MakeCity({{{0.0, 20.0}, 6.0, 12.0, 0.0, 0.0, 8.0, 8.0},
                                             {{0.0, 40.0}, 6.0, 12.0, 0.0, 0.0, 6.0, 6.0}});
  const PinholeCamera camera{320, 240, 250.0, 250.0, 160.0, 120.0};
  const Pose pose{CamFromWorld(ViewAngles{0.0, 0.0, 0.0}), {0.0, 0.0, 1.6}};
  // All twelve edges of both boxes are before the camera.
  const auto lines = ProjectedEdges(model, camera, pose, 200.0);
  EXPECT_EQ(lines.size(), 24u);
  EXPECT_EQ(ProjectedEdges(model, camera, pose, 30.0).size(), 12u);
  for (const LineSegment& line : lines) {
    for (const Eigen::Vector2f& p : {line.a, line.b}) {
      EXPECT_TRUE(p.x() > -0.01f && p.x() < 320.01f && p.y() > -0.01f && p.y() < 240.01f);
    }
  }
}

class LoeperOnAStreet : public ::testing::Test {
 protected:
  LoeperOnAStreet() {
    methods_ = LoeperMethods();
    options_.sides_m = {4.0};
    options_.headings_deg = {5.0};
    options_.iterations = {4, 8};
  }

  testing::StreetStudy street_;
  std::vector<LoeperMethod> methods_;
  LoeperReplayOptions options_;
};

TEST_F(LoeperOnAStreet, FiguresOfAChosenPicture) {
  const Query& query = street_.dataset().queries.front();
  const PinholeCamera camera = query.camera->Pinhole();
  Pose truth = *query.truth;
  const CityModel& model = street_.localizer().scene().model();
  truth.center_in_world -= model.origin_in_world;
  const cv::Mat picture = cv::imread(query.image.string());
  ZbufferHoughOptions zbuffer;
  std::vector<LineSegment> lines;
  for (const ProjectedSegment& s : ZbufferHoughSegments(model, camera, truth, zbuffer)) {
    lines.push_back({s.a, s.b, 1.0f});
  }
  ASSERT_GT(lines.size(), 5u);
  // A picture whose lines are the model's own: all match, at distance 0.
  const LoeperFigures figures =
      DrawLoeperFigures(picture, lines, model, camera, truth, LineEnergyOptions{}, zbuffer);
  EXPECT_EQ(figures.model_segments, lines.size());
  EXPECT_EQ(figures.matched_model_segments, lines.size());
  EXPECT_GE(figures.pairs, lines.size());
  EXPECT_LT(figures.energy, 0.5);
  for (const cv::Mat* panel : {&figures.edges, &figures.depth, &figures.segments, &figures.matched}) {
    EXPECT_EQ(panel->size(), cv::Size(camera.width, camera.height));
    cv::Mat gray;
    cv::extractChannel(*panel, gray, 0);
    double least = 0.0, most = 0.0;
    cv::minMaxLoc(gray, &least, &most);
    EXPECT_LT(least, most);
  }
}

TEST_F(LoeperOnAStreet, ThePageHasItsTablesAndThePapersNumbers) {
  Dataset dataset = street_.dataset();
  dataset.queries.resize(1);
  const fs::path folder = fs::temp_directory_path() / ("ridgeline_replay_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::vector<LoeperRun> runs;
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    LoeperRun run = RunOf({{1, 0.8, 3.0, 3.0, 2.0, 2.0}, {2, 0.5, 1.0, 1.0, -1.0, 1.0}});
    run.method = m;
    run.side_m = 4.0;
    run.heading_deg = 5.0;
    runs.push_back(run);
  }
  ReplayPage page("Replay", {{"dataset", "<street>"}});
  AddLoeperResults(dataset, methods_, runs, options_, 10, page);
  page.WriteTo(folder);
  const std::string html = ReadFile(folder / "index.html");
  EXPECT_NE(html.find("&lt;street&gt;"), std::string::npos);
  EXPECT_NE(html.find("-2.23"), std::string::npos);  // the paper's own
  EXPECT_NE(html.find("data:image"), std::string::npos);
  const std::string results = ReadFile(folder / "results.csv");
  EXPECT_EQ(std::count(results.begin(), results.end(), '\n'),
            static_cast<long>(1 + methods_.size() * options_.iterations.size()));
  const std::string table = ReadFile(folder / "table1.csv");
  EXPECT_NE(table.find("printed"), std::string::npos);
  EXPECT_NE(table.find("100.00"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "fig5_printed.png"));
  fs::remove_all(folder);
}

TEST(LoeperReplayOptions, BadValuesAreNamed) {
  LoeperReplayOptions options;
  EXPECT_NO_THROW(options.Validate());
  options.iterations = {100, 50};
  EXPECT_THROW(options.Validate(), InputError);
  options = {};
  options.sides_m = {-1.0};
  EXPECT_THROW(options.Validate(), InputError);
}

}  // namespace
}  // namespace ridgeline
