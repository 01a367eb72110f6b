// SPDX-License-Identifier: Apache-2.0
// Compares refinements of a pose on a dataset with truths: from starts drawn around the truth, the
// compass search on the score, the least squares fit, and one after the other. Prints median and
// worst errors, the share within 0.5 m and 0.5 degrees, and the time of each.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>

#include "base/error.h"
#include "eval/bench.h"
#include "input/world.h"
#include "localize/fit_pose.h"
#include "localize/pose_scorer.h"
#include "localize/refine_pose.h"
#include "score/line_likelihood.h"
#include "score/picture_evidence.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

struct Settings {
  std::string dataset;
  std::string perturb = "1,1,0,1.5";
  std::vector<int> seeds = {1, 2, 3};
  bool each = false;
  LocalizerOptions options;
  PoseFitOptions fit;
};

struct Outcome {
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  std::vector<double> milliseconds;
  std::vector<double> normalized;  // squared Mahalanobis distance of the place, of the fit
};

double Quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

class Comparison {
 public:
  Comparison(const Localizer& localizer, const Settings& settings)
      : localizer_(localizer), settings_(settings) {}

  void Run(const Query& query) {
    const LocalizerOptions& options = settings_.options;
    PictureReader pictures;
    LocalizationInput input = InputOf(query, options, pictures);
    const PictureEvidence picture(UndistortImage(BgrOf(input.picture), input.camera),
                                  input.camera.Pinhole(),
                                  options.lines,
                                  options.score.evidence,
                                  1,
                                  input.lines);
    const auto score = MakeScore({picture, localizer_.scene(), options.score});
    const Perturbation half = ParsePerturbation(settings_.perturb);
    // The compass search must be able to reach the truth.
    Perturbation box = half;
    for (double* value : {&box.east_m,
                          &box.north_m,
                          &box.height_m,
                          &box.heading_deg,
                          &box.pitch_deg,
                          &box.roll_deg}) {
      *value *= 2.0;
    }
    const PoseSpaceOptions ranges = RangesOf(options.search.space, box);
    for (const int seed : settings_.seeds) {
      const PosePrior prior = DrawPrior(*query.truth, half, seed, query.id);
      const PoseSpace space(
          prior, ranges, localizer_.scene(), localizer_.dtm(), localizer_.footprints());
      if (!space.PoseAt({})) continue;
      const PoseScorer scorer(*score,
                              localizer_.scene(),
                              space,
                              picture.camera(),
                              options.score.evidence.surface_step_deg);
      const auto compass = [&](const PoseSpace::Offset& start, const RefineSteps& steps) {
        return RefinePose(scorer, {start, 0.0}, steps).pose.offset;
      };
      const auto fit = [&](const PoseSpace::Offset& start, double tolerance) {
        PoseFitOptions fit_options = settings_.fit;
        fit_options.first_tolerance = tolerance;
        return FitPose({picture.segments(), picture.field(), picture.camera()},
                       localizer_.scene(),
                       space,
                       options.score.evidence.cues.Get<LineLikelihoodOptions>(),
                       fit_options,
                       start);
      };
      const double first = settings_.fit.first_tolerance;
      Add(query, seed, "start", space, [&] { return PoseSpace::Offset{}; });
      Add(query, seed, "compass", space, [&] { return compass({}, {0.5, 0.5, 0.06}); });
      PoseFit last;
      Add(query, seed, "fit", space, [&] {
        last = fit({}, first);
        return last.offset;
      });
      AddNormalized(query, space, "fit", last);
      Add(query, seed, "fit, then compass", space, [&] {
        return compass(fit({}, first).offset, {0.12, 0.12, 0.06});
      });
      Add(query, seed, "compass, then fit", space, [&] {
        last = fit(compass({}, {0.5, 0.5, 0.06}), 1.0);
        return last.offset;
      });
      AddNormalized(query, space, "compass, then fit", last);
      Add(query, seed, "coarse compass, then fit", space, [&] {
        return fit(compass({}, {0.5, 0.5, 0.3}), 1.0).offset;
      });
    }
  }

  void Print() const {
    std::printf("%-26s %8s %8s %8s %8s %8s %6s %9s\n",
                "",
                "median m",
                "75 %",
                "90 %",
                "med deg",
                "90 %",
                "0.5/.5",
                "med ms");
    for (const auto& [name, o] : outcomes_) {
      double good = 0.0;
      for (std::size_t i = 0; i < o.translations_m.size(); ++i) {
        if (o.translations_m[i] <= 0.5 && o.rotations_deg[i] <= 0.5) good += 1.0;
      }
      std::printf("%-26s %8.3f %8.3f %8.3f %8.3f %8.3f %5.0f%% %9.2f\n",
                  name.c_str(),
                  Quantile(o.translations_m, 0.5),
                  Quantile(o.translations_m, 0.75),
                  Quantile(o.translations_m, 0.9),
                  Quantile(o.rotations_deg, 0.5),
                  Quantile(o.rotations_deg, 0.9),
                  100.0 * good / o.translations_m.size(),
                  Quantile(o.milliseconds, 0.5));
      if (!o.normalized.empty()) {
        std::printf(
            "%-26s squared Mahalanobis distance of the place: median %.2f, 90 %%: %.2f "
            "(expected 1.39, 4.61)\n",
            "",
            Quantile(o.normalized, 0.5),
            Quantile(o.normalized, 0.9));
      }
    }
  }

 private:
  template <typename Refine>
  void Add(const Query& query,
           int seed,
           const char* name,
           const PoseSpace& space,
           const Refine& refine) {
    const auto start = std::chrono::steady_clock::now();
    const PoseSpace::Offset offset = refine();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Pose pose = *space.PoseAt(offset);
    pose.center_in_world += localizer_.scene().model().origin_in_world;
    const PoseError error = ErrorOf(pose, *query.truth);
    Outcome& outcome = outcomes_[name];
    outcome.translations_m.push_back(error.translation_m);
    outcome.rotations_deg.push_back(error.rotation_deg);
    outcome.milliseconds.push_back(1000.0 * seconds);
    if (settings_.each) {
      std::printf("%s %d %-26s %7.3f m %7.3f deg %8.2f ms\n",
                  query.id.c_str(),
                  seed,
                  name,
                  error.translation_m,
                  error.rotation_deg,
                  1000.0 * seconds);
    }
  }

  void AddNormalized(const Query& query,
                     const PoseSpace& space,
                     const char* name,
                     const PoseFit& fit) {
    if (fit.status != PoseFitStatus::kOk) return;
    const Eigen::Vector2d error =
        (space.PoseAt(fit.offset)->center_in_world + localizer_.scene().model().origin_in_world -
         query.truth->center_in_world)
            .head<2>();
    outcomes_[name].normalized.push_back(
        error.dot(fit.covariance.topLeftCorner<2, 2>().inverse() * error));
    if (settings_.each) {
      std::printf(
          "   matches %d, rounds %d, sigma0 %.2f, sigmas %.3f %.3f m %.3f deg, overhang "
          "%.2f +- %.2f m, focal %.4f\n",
          fit.matches,
          fit.rounds,
          fit.sigma0,
          std::sqrt(fit.covariance(0, 0)),
          std::sqrt(fit.covariance(1, 1)),
          std::sqrt(fit.covariance(3, 3)),
          fit.overhang_m,
          fit.overhang_sigma_m,
          fit.focal_factor);
    }
  }

  const Localizer& localizer_;
  const Settings& settings_;
  std::map<std::string, Outcome> outcomes_;
};

void CompareAll(const Settings& settings) {
  const Dataset dataset = ReadDataset(settings.dataset);
  constexpr double kMarginM = 100.0;
  const World world = ReadWorld(dataset, kMarginM);
  const Localizer localizer(world.model, world.dtm, settings.options);
  Comparison comparison(localizer, settings);
  for (const Query& query : dataset.queries) {
    if (query.truth) comparison.Run(query);
  }
  comparison.Print();
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  ridgeline::Settings settings;
  std::vector<std::string> assignments;
  CLI::App app("Compares refinements of poses drawn around the truth");
  app.add_option("dataset", settings.dataset, "dataset.json")->required();
  app.add_option("--perturb",
                 settings.perturb,
                 "half-ranges of the starts: east, north, height, heading[, pitch, roll]");
  app.add_option("--seeds", settings.seeds, "of the starts")->delimiter(',');
  app.add_flag("--each", settings.each, "print every run");
  app.add_option("--set", assignments, "options; those of the fit as fit.max_rounds=8");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& assignment : assignments) {
      ridgeline::SetOption(assignment, [&](ridgeline::OptionVisitor& v) {
        settings.options.Visit(v);
        v.Group("fit", [&](ridgeline::OptionVisitor& g) { settings.fit.Visit(g); });
      });
    }
    ridgeline::CompareAll(settings);
  } catch (const ridgeline::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
