// SPDX-License-Identifier: Apache-2.0
// Learns the weights of the evidence's cues: those that give the true poses of datasets the highest
// probability among all poses of their search boxes, and writes them as a configuration.
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "eval/bench.h"
#include "input/world.h"
#include "localize/pose_scorer.h"
#include "localize/pose_space.h"
#include "score/evidence_score.h"

namespace ridgeline {
namespace {

struct Settings {
  std::vector<std::string> datasets;
  std::string perturb = "10,10,0,20";
  double ridge = 0.0003;  // best in cross-validation over queries (docs/scores.md)
  std::vector<int> seeds = {1};
  std::string out;
  LocalizerOptions options;
};

// The cues of all poses of one search box.
struct Box {
  std::vector<std::vector<float>> cues;
  std::vector<bool> is_near;  // within 2 m and 2 degrees of the truth
};

// The cues of the poses on a grid around the prior.
struct Grid {
  PoseSpaceOptions ranges;
  int spacing_m = 1;
  int heading_step_deg = 1;
  bool includes_truth = true;  // false: poses far from the truth only, to be told from it
};

void AddPoses(const Grid& grid,
              const PosePrior& prior,
              const Pose& truth_in_world,
              const EvidenceScore& evidence,
              const PictureEvidence& picture,
              const Localizer& localizer,
              Box& box) {
  constexpr double kFarM = 5.0;
  constexpr double kFarDeg = 10.0;
  const PoseSpace space(
      prior, grid.ranges, localizer.scene(), localizer.dtm(), localizer.footprints());
  const PoseScorer scorer(evidence,
                          localizer.scene(),
                          space,
                          picture.camera(),
                          localizer.options().score.evidence.surface_step_deg);
  const PanoramaRange range =
      scorer.RangeAround(space.center_angles(), {grid.ranges.heading_deg, 0.0, 0.0});
  const int east = static_cast<int>(grid.ranges.east_m);
  const int north = static_cast<int>(grid.ranges.north_m);
  const int heading = static_cast<int>(grid.ranges.heading_deg);
  Pose truth = truth_in_world;
  truth.center_in_world -= localizer.scene().model().origin_in_world;
  std::vector<Box> rows(static_cast<std::size_t>(2 * north / grid.spacing_m + 1));
  ParallelFor(rows.size(), 0, [&](std::size_t row) {
    PoseScorer::Look look(scorer);
    const int n = grid.spacing_m * static_cast<int>(row) - north;
    for (int e = -east; e <= east; e += grid.spacing_m) {
      const auto position = space.PositionAt(e, n, 0.0);
      if (!position) continue;
      look.From(*position, range);
      for (int h = -heading; h <= heading; h += grid.heading_step_deg) {
        PoseSpace::Offset offset;
        offset.heading_deg = h;
        const Pose pose{CamFromWorld(space.AnglesAt(offset)), *position};
        const PoseError error = ErrorOf(pose, truth);
        const bool is_far = error.translation_m > kFarM || error.rotation_deg > kFarDeg;
        if (!grid.includes_truth && !is_far) continue;
        const std::span<const float> cues = evidence.Cues(look.view(), pose, look.workspace());
        rows[row].cues.emplace_back(cues.begin(), cues.end());
        rows[row].is_near.push_back(error.translation_m <= 2.0 && error.rotation_deg <= 2.0);
      }
    }
  });
  for (const Box& row : rows) {
    box.cues.insert(box.cues.end(), row.cues.begin(), row.cues.end());
    box.is_near.insert(box.is_near.end(), row.is_near.begin(), row.is_near.end());
  }
}

// The box of the perturbation, densely, and decoys from farther away, in all headings.
Box BoxOf(const Query& query, int seed, const Localizer& localizer, const Settings& settings) {
  const LocalizerOptions& options = settings.options;
  PictureReader pictures;
  const LocalizationInput input = InputOf(query, options, pictures);
  const PictureEvidence picture(UndistortImage(BgrOf(input.picture), input.camera),
                                input.camera.Pinhole(),
                                options.lines,
                                options.score.evidence,
                                0,
                                input.lines);
  const EvidenceScore evidence({picture, localizer.scene(), options.score.evidence.cues},
                               options.score.weights);
  const Perturbation perturb = ParsePerturbation(settings.perturb);
  const PosePrior prior = DrawPrior(*query.truth, perturb, seed, query.id);
  Grid dense;
  dense.ranges = RangesOf(options.search.space, perturb);
  Grid decoys{dense.ranges, 4, 6, false};
  decoys.ranges.east_m = decoys.ranges.north_m = 40.0;
  decoys.ranges.heading_deg = 180.0;
  Box box;
  for (const Grid& grid : {dense, decoys}) {
    AddPoses(grid, prior, *query.truth, evidence, picture, localizer, box);
  }
  return box;
}

// Standard deviation of each cue over the poses of all boxes.
std::vector<double> SpreadsOf(const std::vector<Box>& boxes, std::size_t cues_of_pose) {
  std::vector<double> sums(cues_of_pose, 0.0);
  std::vector<double> squares(cues_of_pose, 0.0);
  double count = 0.0;
  for (const Box& box : boxes) {
    count += static_cast<double>(box.cues.size());
    for (const std::vector<float>& cues : box.cues) {
      for (std::size_t k = 0; k < cues_of_pose; ++k) {
        sums[k] += cues[k];
        squares[k] += static_cast<double>(cues[k]) * cues[k];
      }
    }
  }
  std::vector<double> spreads(cues_of_pose);
  for (std::size_t k = 0; k < cues_of_pose; ++k) {
    const double mean = sums[k] / count;
    spreads[k] = std::sqrt(std::max(squares[k] / count - mean * mean, 1e-12));
  }
  return spreads;
}

// Mean negative log probability of the poses near the truth under P(pose) ~ exp(sum of w_k cue_k),
// mixed with a uniform share, so that no single picture decides, and a ridge on what the cues
// typically contribute (w_k times their spread), since the pictures are few; the parameters are
// log w_k.
class Loss final : public ceres::FirstOrderFunction {
 public:
  Loss(const std::vector<Box>& boxes, std::size_t cues_of_pose, double ridge)
      : boxes_(boxes), spreads_(SpreadsOf(boxes, cues_of_pose)), ridge_(ridge) {}

  int NumParameters() const override { return static_cast<int>(spreads_.size()); }

  bool Evaluate(const double* logs, double* cost, double* gradient) const override {
    constexpr double kUniformShare = 0.03;
    const std::size_t count = spreads_.size();
    std::vector<double> weights(count);
    for (std::size_t k = 0; k < count; ++k) weights[k] = std::exp(logs[k]);
    *cost = 0.0;
    std::vector<double> slope(count, 0.0);
    for (const Box& box : boxes_) {
      std::vector<double> sums(box.cues.size(), 0.0);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        for (std::size_t k = 0; k < count; ++k) sums[i] += weights[k] * box.cues[i][k];
      }
      const double highest = *std::max_element(sums.begin(), sums.end());
      double total = 0.0;
      double near = 0.0;
      std::vector<double> all_mean(count, 0.0);
      std::vector<double> near_mean(count, 0.0);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const double p = std::exp(sums[i] - highest);
        total += p;
        if (box.is_near[i]) near += p;
        for (std::size_t k = 0; k < count; ++k) {
          all_mean[k] += p * box.cues[i][k];
          if (box.is_near[i]) near_mean[k] += p * box.cues[i][k];
        }
      }
      const double share = near / total;
      const double near_share =
          static_cast<double>(std::count(box.is_near.begin(), box.is_near.end(), true)) /
          static_cast<double>(sums.size());
      const double mixed = (1.0 - kUniformShare) * share + kUniformShare * near_share;
      *cost -= std::log(mixed) / static_cast<double>(boxes_.size());
      for (std::size_t k = 0; k < count; ++k) {
        const double d = near_mean[k] / total - share * all_mean[k] / total;
        slope[k] -= (1.0 - kUniformShare) * d / mixed / static_cast<double>(boxes_.size());
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      *cost += ridge_ * weights[k] * weights[k] * spreads_[k] * spreads_[k];
      slope[k] += 2.0 * ridge_ * weights[k] * spreads_[k] * spreads_[k];
    }
    if (gradient != nullptr) {
      for (std::size_t k = 0; k < count; ++k) gradient[k] = slope[k] * weights[k];
    }
    return true;
  }

 private:
  const std::vector<Box>& boxes_;
  std::vector<double> spreads_;
  double ridge_;
};

// The weight that a cue's is learned from.
double Start(const Settings& settings, const std::string& cue) {
  const double weight = settings.options.score.weights.at(cue);
  if (weight > 0.0) return weight;
  throw InputError(
      "", "score.weights." + cue, std::to_string(weight), "> 0, where learning begins");
}

void Learn(const Settings& settings) {
  for (const std::string& cue : CueNames()) Start(settings, cue);
  std::vector<Box> boxes;
  for (const std::string& path : settings.datasets) {
    const Dataset dataset = ReadDataset(path);
    constexpr double kMarginM = 100.0;
    const World world = ReadWorld(dataset, kMarginM);
    const Localizer localizer(world.model, world.dtm, settings.options);
    for (const Query& query : dataset.queries) {
      if (!query.truth) continue;
      for (const int seed : settings.seeds) {
        Box box = BoxOf(query, seed, localizer, settings);
        const bool has_near = std::count(box.is_near.begin(), box.is_near.end(), true) > 0;
        if (has_near) boxes.push_back(std::move(box));
        std::printf("%s, seed %d: %s\n",
                    query.id.c_str(),
                    seed,
                    has_near ? "used" : "no admissible pose near the truth");
      }
    }
  }
  if (boxes.empty())
    throw InputError(settings.datasets.front(), "", "no queries with truth", "some");

  const std::vector<std::string> names = CueNames();
  std::vector<double> logs;
  for (const std::string& name : names) logs.push_back(std::log(Start(settings, name)));
  const ceres::GradientProblem problem(new Loss(boxes, names.size(), settings.ridge));
  ceres::GradientProblemSolver::Options solver;
  solver.max_num_iterations = 200;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(solver, problem, logs.data(), &summary);
  std::printf("loss of %zu boxes: %.4f with the weights so far, %.4f with these:\n",
              boxes.size(),
              summary.initial_cost,
              summary.final_cost);
  nlohmann::ordered_json weights = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double weight = std::round(1e4 * std::exp(logs[k])) / 1e4;
    std::printf("  %-14s %.4f\n", names[k].c_str(), weight);
    weights[names[k]] = weight;
  }
  if (!settings.out.empty()) {
    WriteFileAtomically(settings.out,
                        nlohmann::ordered_json{{"score", {{"weights", weights}}}}.dump(2) + "\n");
  }
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  ridgeline::Settings settings;
  std::vector<std::string> assignments;
  CLI::App app("Learns the weights of the evidence's cues on datasets with truths");
  app.add_option("datasets", settings.datasets, "dataset.json ...")->required();
  app.add_option(
      "--perturb", settings.perturb, "half-ranges of the boxes: east, north, height, heading");
  app.add_option("--seeds", settings.seeds, "of the priors")->delimiter(',');
  app.add_option("--ridge", settings.ridge, "weight of the ridge");
  app.add_option("--set", assignments, "options, as score.evidence.work_size_px=640");
  app.add_option("--out", settings.out, "configuration to write");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& assignment : assignments) {
      ridgeline::SetOption(assignment,
                           [&](ridgeline::OptionVisitor& v) { settings.options.Visit(v); });
    }
    ridgeline::Learn(settings);
  } catch (const ridgeline::InputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
  return 0;
}
