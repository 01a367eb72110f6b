// SPDX-License-Identifier: Apache-2.0
#include "localize/roof_doubt.h"

#include <algorithm>
#include <array>
#include <memory>

#include "city/nearby_buildings.h"
#include "localize/refine_pose.h"
#include "score/score_table.h"

namespace ridgeline {
namespace {

constexpr std::size_t kBuildings = 3;
// A building that could tell less is not asked.
constexpr double kTellingRoofNat = 2.0;
constexpr double kLeastGain = 6.0;
constexpr std::array<double, 4> kShiftsM = {-1.5, -0.75, 0.75, 1.5};
constexpr double kBetweenM = 0.375;
// Gains are compared among the buildings around the camera alone, without the terrain.
constexpr double kAroundM = 120.0;
// Turns the camera only: the last step is above the first.
constexpr RefineSteps kTurnOnly{.first_m = 0.05, .first_deg = 0.5, .last_m = 0.06};

// The highest log likelihood ratio at the place of `pose` with a roof moved.
class Turner {
 public:
  Turner(const RoofTrial& trial, const ScoredPose& pose)
      : trial_(trial),
        pose_(pose),
        around_(NearbyBuildings(
            trial.model,
            trial.space.center() + Eigen::Vector2d(pose.offset.east_m, pose.offset.north_m),
            kAroundM)),
        as_modelled_(With(trial.settled)) {}

  double Gain(const RoofShift& shift) const {
    std::vector<RoofShift> shifts = trial_.settled;
    shifts.push_back(shift);
    return With(shifts) - as_modelled_;
  }

 private:
  double With(const std::vector<RoofShift>& shifts) const {
    const CityModel shifted = WithShiftedRoofs(around_, shifts);
    const Scene scene(shifted, nullptr, trial_.options.projection);
    const std::unique_ptr<Score> score =
        MakeScore({trial_.picture, scene, trial_.options.score});
    const PoseScorer scorer(*score,
                            scene,
                            trial_.space,
                            trial_.picture.camera(),
                            trial_.options.score.evidence.surface_step_deg);
    return RefinePose(scorer, pose_, kTurnOnly).pose.log_ratio;
  }

  const RoofTrial& trial_;
  const ScoredPose& pose_;
  CityModel around_;
  double as_modelled_;
};

}  // namespace

std::optional<RoofShift> RoofInDoubt(const RoofTrial& trial,
                                     const Goodness& goodness,
                                     const ScoredPose& best) {
  const Turner turner(trial, best);
  RoofShift found;
  double highest = 0.0;
  const auto attempt = [&](const RoofShift& shift) {
    const double gain = turner.Gain(shift);
    if (gain > highest) {
      highest = gain;
      found = shift;
    }
  };
  for (std::size_t k = 0; k < std::min(kBuildings, goodness.buildings.size()); ++k) {
    const BuildingFit& fit = goodness.buildings[k];
    const bool is_settled =
        std::any_of(trial.settled.begin(), trial.settled.end(), [&](const RoofShift& s) {
          return s.building == fit.building;
        });
    if (is_settled || fit.information() < kTellingRoofNat) continue;
    for (const double up : kShiftsM) attempt({fit.building, up});
  }
  if (highest < kLeastGain) return std::nullopt;
  const RoofShift coarse = found;
  for (const double between : {-kBetweenM, kBetweenM}) {
    attempt({coarse.building, coarse.up_m + between});
  }
  return found;
}

}  // namespace ridgeline
