// SPDX-License-Identifier: Apache-2.0
#include "replay/loeper_replay.h"

#include <chrono>

#include "base/error.h"
#include "camera/local_frame.h"
#include "eval/bench.h"
#include "eval/metrics.h"
#include "localize/pose_scorer.h"
#include "localize/sampled_search.h"
#include "optim/tpe.h"
#include "score/line_energy.h"
#include "score/picture_evidence.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

using Clock = std::chrono::steady_clock;

// What all methods share: the paper's assumptions of section 4.3.
LocalizerOptions Level() {
  LocalizerOptions options;
  options.search.method = "sampler";
  options.search.refine = false;
  options.search.widenings = 0;
  options.search.space.height_m = 0.0;
  options.search.space.camera_height_range_m = 0.0;
  options.search.space.pitch_deg = 0.0;
  options.search.space.roll_deg = 0.0;
  return options;
}

LocalizerOptions Published() {
  LocalizerOptions options = Level();
  options.lines.min_length_px = 20.0;
  options.score.name = "line_energy_zbuffer";
  options.score.evidence.work_size_px = 1280;
  options.score.groups.Get<LineEnergyOptions>().max_distance_px = 10.0;
  options.search.sampler.name = "tpe";
  options.search.sampler.groups.Get<TpeOptions>().divide_by_deviation = true;
  options.confidence.abstain_below = 0.0;
  return options;
}

// A picture as one method compares it.
class Compared {
 public:
  Compared(const Query& query, const Localizer& localizer, int threads)
      : localizer_(localizer),
        input_(InputOf(query, localizer.options(), pictures_)),
        evidence_(UndistortImage(BgrOf(input_.picture), input_.camera),
                  input_.camera.Pinhole(),
                  localizer.options().lines,
                  localizer.options().score.evidence,
                  threads,
                  input_.lines),
        score_(MakeScore({evidence_, localizer.scene(), localizer.options().score})) {}

  std::vector<LoeperSample> Search(const SearchStart& start,
                                   const Pose& truth,
                                   int iterations,
                                   std::uint64_t seed,
                                   int threads) const {
    const PoseSpace space(start.prior,
                          start.ranges,
                          localizer_.scene(),
                          localizer_.dtm(),
                          localizer_.footprints());
    const PoseScorer scorer(*score_,
                            localizer_.scene(),
                            space,
                            evidence_.camera(),
                            localizer_.options().score.evidence.surface_step_deg);
    SearchOptions search = localizer_.options().search;
    search.evaluations = iterations;
    const Pose local_truth =
        LocalFrame{localizer_.scene().model().origin_in_world}.FromWorld(truth);
    const double truth_deg = ViewAnglesOf(truth.cam_from_world).heading_deg;
    std::vector<LoeperSample> samples;
    for (const Trial& trial : SampleSearch(scorer, search, seed, threads).trace.trials) {
      if (trial.state != TrialState::kComplete) continue;
      const std::vector<double>& v = trial.values;
      const auto pose = space.PoseAt({v[0], v[1], v[2], v[3], v[4], v[5]});
      if (!pose) continue;
      const PoseError error = ErrorOf(*pose, local_truth);
      samples.push_back(
          {static_cast<int>(trial.index) + 1,
           trial.energy,
           error.translation_m,
           error.horizontal_m,
           // kappa counts against the clock.
           -HeadingDifferenceDeg(ViewAnglesOf(pose->cam_from_world).heading_deg, truth_deg),
           error.rotation_deg});
    }
    return samples;
  }

 private:
  const Localizer& localizer_;
  PictureReader pictures_;
  LocalizationInput input_;
  PictureEvidence evidence_;
  std::unique_ptr<Score> score_;
};

}  // namespace

void LoeperReplayOptions::Validate() const {
  const auto refuse = [](const char* option, const char* found, const char* expected) {
    throw InputError(option, "", found, expected);
  };
  if (sides_m.empty()) refuse("--side", "nothing", "sides of the box in m, e.g. 40,20");
  for (const double side : sides_m) {
    if (!(side > 0.0 && side <= 2000.0)) refuse("--side", "a side out of range", "(0, 2000] m");
  }
  if (headings_deg.empty()) refuse("--heading", "nothing", "half-ranges in deg, e.g. 10,20");
  for (const double heading : headings_deg) {
    if (!(heading >= 0.0 && heading <= 180.0)) {
      refuse("--heading", "a half-range out of range", "[0, 180] deg");
    }
  }
  int last = 0;
  for (const int count : iterations) {
    if (count <= last) refuse("--iterations", "numbers that do not rise", "e.g. 50,100,200");
    last = count;
  }
  if (iterations.empty()) refuse("--iterations", "nothing", "e.g. 50,100,200");
}

std::vector<LoeperMethod> LoeperMethods() {
  std::vector<LoeperMethod> methods;
  methods.push_back({"printed",
                     "z-buffer, Canny, Hough; TPE; box around the true place and heading",
                     true,
                     Published()});
  LocalizerOptions corrected = Published();
  corrected.score.name = "line_energy";
  methods.push_back({"corrected",
                     "the same energy on exact visible edges; TPE; box around a drawn prior",
                     false,
                     corrected});
  methods.push_back({"evidence",
                     "the default score and sampler on as many poses; box around a drawn prior",
                     false,
                     Level()});
  return methods;
}

const LoeperSample* LoeperRun::BestAfter(int iterations) const {
  const LoeperSample* best = nullptr;
  for (const LoeperSample& sample : samples) {
    if (sample.iteration > iterations) break;
    if (best == nullptr || sample.energy < best->energy) best = &sample;
  }
  return best;
}

Protocol LoeperProtocol(double side_m, double heading_deg) {
  Protocol protocol = FindProtocol("paper");
  protocol.error.east_m = protocol.error.north_m = 0.5 * side_m;
  protocol.error.heading_deg = heading_deg;
  return protocol;
}

std::vector<LoeperRun> ReplayLoeper(const Dataset& dataset,
                                    std::span<const std::size_t> queries,
                                    std::span<const LoeperMethod> methods,
                                    std::span<const std::unique_ptr<Localizer>> localizers,
                                    const LoeperReplayOptions& options,
                                    const LoeperProgress& progress) {
  options.Validate();
  std::vector<LoeperRun> runs;
  const std::size_t boxes = options.sides_m.size() * options.headings_deg.size();
  const std::size_t total = queries.size() * methods.size() * boxes;
  std::vector<BenchQueries> sources;  // by box
  for (const double side : options.sides_m) {
    for (const double heading : options.headings_deg) {
      sources.emplace_back(
          LoeperProtocol(side, heading), dataset, methods.front().options.search.space);
    }
  }
  for (const std::size_t q : queries) {
    const Query& query = dataset.queries[q];
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Localizer& localizer = *localizers[m];
      const Compared compared(query, localizer, options.threads);
      for (std::size_t b = 0; b < boxes; ++b) {
        SearchStart start = sources[b].Start(q, options.seed, localizer);
        if (methods[m].around_truth) {
          start.prior.position_in_world = query.truth->center_in_world.head<2>();
          start.prior.heading_deg = ViewAnglesOf(query.truth->cam_from_world).heading_deg;
        }
        LoeperRun run{q,
                      m,
                      options.sides_m[b / options.headings_deg.size()],
                      options.headings_deg[b % options.headings_deg.size()],
                      {},
                      0.0};
        const Clock::time_point begin = Clock::now();
        run.samples = compared.Search(
            start, *query.truth, options.iterations.back(), options.seed, options.threads);
        run.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        runs.push_back(std::move(run));
        if (progress) progress(runs.size(), total);
      }
    }
  }
  return runs;
}

}  // namespace ridgeline
