// SPDX-License-Identifier: Apache-2.0
// A sampler of one's own: where to look next, given what was seen so far?
//
//   custom_sampler DATASET QUERY        e.g. custom_sampler town/dataset.json street_000
//
// A sampler minimises the energy of a pose over a box: east, north, height, heading, pitch, roll
// around the prior. It does not know that. It is a Strategy: points of the unit cube out, energies
// in. The library turns points into poses, leaves out places inside of buildings, evaluates on all
// cores, and checks what goes in and out.
//
// The strategy of this example is the oldest of the evolution strategies, the (1+1) of Rechenberg
// (1973): keep the best point so far, try a normal step from it, move there if it is better. The
// art is in the length of the step. If more than one step in five succeeds, the point is far from
// the minimum, and the steps may grow; if fewer do, they should shrink. So a success multiplies the
// length by exp(0.8) and a failure by exp(-0.2): at one success in five the two cancel out.
//
// It is a local method, and the energy of poses has many local minima (the next house looks like
// this one). Once its steps are so short that nothing can change any more, it begins anew at
// random.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <string>

#include "base/random.h"
#include "input/dataset.h"
#include "input/read_picture.h"
#include "input/world.h"
#include "localize/localizer.h"
#include "optim/sampler_table.h"

namespace {

using ridgeline::StrategyContext;
using ridgeline::TrialState;
using ridgeline::UnitPoint;

// Become keys like all others: search.sampler.one_plus_one.first_step.
struct OnePlusOneOptions {
  double first_step = 0.2;   // standard deviation, as a share of the box
  double last_step = 0.002;  // below it, begin anew

  void Visit(ridgeline::OptionVisitor& v) {
    v.Field("first_step", first_step, ridgeline::LeftOpen(0.0, 1.0));
    v.Field("last_step", last_step, ridgeline::Positive());
    v.Rule("last_step", last_step < first_step, std::to_string(last_step), "below first_step");
  }
};

class OnePlusOne final : public ridgeline::Strategy {
 public:
  OnePlusOne(const StrategyContext& context, const OnePlusOneOptions& options)
      : context_(context), options_(options) {
    Begin();
  }

  // [sampler
  // Random numbers come from (seed, stage, index of the draw) and from nowhere else. This is why a
  // search gives the same result again, on one thread or on eight.
  std::optional<UnitPoint> Propose(std::int64_t /*id*/) override {
    static const std::uint64_t kStage = ridgeline::HashText("example.one_plus_one");
    ridgeline::Random random(context_.seed, kStage, draws_++);
    UnitPoint point(context_.dimension);
    for (std::size_t k = 0; k < point.size(); ++k) {
      point[k] =
          parent_.empty() ? random.Uniform() : Inside(parent_[k] + step_ * random.Normal(), k);
    }
    return point;
  }

  // The point was in a building, say. The next draw will be another one; nothing to be learned.
  void Reject(std::int64_t /*id*/) override {}

  // Several proposals are out at a time, so a result may belong to an earlier parent. That does no
  // harm: it is a success if it is better than the parent of today.
  void Observe(std::int64_t /*id*/,
               const UnitPoint& point,
               double energy,
               TrialState state) override {
    const bool is_success = state == TrialState::kComplete && energy < energy_;
    const bool has_parent = !parent_.empty();
    if (is_success) {
      parent_ = point;
      energy_ = energy;
    }
    if (!has_parent) return;  // a first point is no step
    step_ = std::min(options_.first_step, step_ * std::exp(is_success ? 0.8 : -0.2));
    if (step_ < options_.last_step) Begin();
  }
  // sampler]

 private:
  void Begin() {
    parent_.clear();
    energy_ = std::numeric_limits<double>::infinity();
    step_ = options_.first_step;
  }

  // A coordinate that is a full circle of headings goes on at its other end; others are reflected.
  double Inside(double u, std::size_t k) const {
    if (context_.periodic[k]) return u - std::floor(u);
    u = std::abs(std::remainder(u, 2.0));
    return std::min(u, 1.0);
  }

  StrategyContext context_;
  OnePlusOneOptions options_;
  std::uint64_t draws_ = 0;
  UnitPoint parent_;
  double energy_ = 0.0;
  double step_ = 0.0;
};

constexpr ridgeline::SamplerPlugin kOnePlusOne = {
    .name = "one_plus_one",
    .declare =
        [](ridgeline::OptionGroups& options) { options.Add<OnePlusOneOptions>("one_plus_one"); },
    .make = [](const StrategyContext& context,
               const ridgeline::OptionGroups& options) -> std::unique_ptr<ridgeline::Strategy> {
      return std::make_unique<OnePlusOne>(context, options.Get<OnePlusOneOptions>());
    }};

// The least energy that a sampler finds. Refinement is left out, so that the sampler is seen alone.
double LeastEnergy(const std::string& sampler,
                   const ridgeline::World& world,
                   const ridgeline::Query& query) {
  ridgeline::LocalizerOptions options;
  options.search.method = "sampler";
  options.search.sampler.name = sampler;
  options.search.evaluations = 3000;
  options.search.refine = false;
  const ridgeline::Localizer localizer(world.model, world.dtm, options);
  ridgeline::LocalizationInput input;
  input.picture = ridgeline::ReadPicture(query);
  input.camera = query.camera.value();
  input.prior = query.prior.value();
  const ridgeline::Localization found = localizer.Localize(input, /*seed=*/1, /*threads=*/0);
  if (found.modes.empty()) return 1.0;
  const ridgeline::PoseMode& best = found.modes.front();
  std::printf("%-14s energy %.4f", sampler.c_str(), best.energy);
  if (query.truth) {
    std::printf(
        ", off by %.2f m, %.2f deg",
        (best.pose.center_in_world - query.truth->center_in_world).norm(),
        ridgeline::RotationDistanceDeg(best.pose.cam_from_world, query.truth->cam_from_world));
  }
  std::printf("\n");
  return best.energy;
}

// A sampler has to be worth its while: with as many evaluations it should do better than points at
// random.
int Run(const char* dataset_file, const char* query_id) {
  ridgeline::AddSampler(kOnePlusOne);  // before any options are made

  const ridgeline::Dataset dataset = ridgeline::ReadDataset(dataset_file);
  const ridgeline::Query& query =
      dataset.queries.at(ridgeline::FindQuery(dataset, query_id, "QUERY"));
  const ridgeline::World world = ridgeline::ReadWorld(dataset, 10.0);

  const double random = LeastEnergy("random", world, query);
  const double own = LeastEnergy("one_plus_one", world, query);
  return own < random ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "custom_sampler DATASET QUERY\n"), 2;
  try {
    return Run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
