// SPDX-License-Identifier: Apache-2.0
#include "localize/belief.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "camera/local_frame.h"
#include "localize/posterior.h"
#include "localize/widen.h"

namespace ridgeline {
namespace {

// Radius of a normal distribution in the plane, and half-width on a line, in standard deviations,
// that are exceeded once in a thousand times.
constexpr double kOneInThousandPlane = 3.717;
constexpr double kOneInThousandLine = 3.291;
constexpr double kAcceptedRisk = 1e-3;

// A building that has this to say and says the opposite is named.
constexpr double kTellingNat = 4.0;
constexpr double kMisfit = 0.25;
constexpr double kRoofGainNat = 3.0;
// An answer on the border of the box is as likely the nearest place to a truth beyond it.
constexpr double kOnBorder = 0.5;
// A score without absolute terms compares the poses of the box with one another: no more is known of
// its best than that.
constexpr double kUnjudged = 0.5;
// Below this the edges are not where they should be.
constexpr double kExplained = 0.5;
// Below this the edges in view agree with many places.
constexpr double kLittleNat = 10.0;
// Below this the best of the box is a place like others [nat].
constexpr double kStandsOutNat = 3.0;

std::string Text(const char* format, double value) {
  char text[200];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

// None where a gross error is likelier than the risk that is accepted.
std::optional<ProtectionLevel> ProtectionOf(const PoseSpread& spread, double gross_probability) {
  if (gross_probability > kAcceptedRisk) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(spread.position_covariance);
  return ProtectionLevel{kOneInThousandPlane * std::sqrt(solver.eigenvalues()(1)),
                         kOneInThousandLine * spread.heading_sigma_deg};
}

std::vector<std::string> DoubtsOf(const Goodness& goodness, const CityModel& model) {
  std::vector<std::string> doubts;
  if (goodness.is_known() && goodness.explained() < kExplained) {
    doubts.push_back(Text("the model's edges are not seen where they should be: %.0f % % of what a "
                          "right pose shows on average",
                          100.0 * std::max(0.0, goodness.explained())));
  }
  if (goodness.is_known() && goodness.information() < kLittleNat) {
    doubts.push_back(Text("little of the model is in view: its edges can tell %.0f nats, ",
                          goodness.information()) +
                     Text("where %.0f are wanted", kLittleNat));
  }
  for (const BuildingFit& fit : goodness.buildings) {
    const std::string building = "building " + NameOf(model.buildings[fit.building]);
    if (fit.roof_gain > kRoofGainNat) {
      doubts.push_back(building + Text(": its roof seems %+.1f m off in the model", fit.roof_shift_m));
    } else if (fit.information() > kTellingNat && fit.explained() < kMisfit) {
      doubts.push_back(building + " does not fit");
    }
  }
  return doubts;
}

void Withhold(LocalizationStatus status, std::string reason, Localization& result) {
  result.status = status;
  result.reason = std::move(reason);
  result.pose.reset();
}

void Decide(const ConfidenceOptions& options, bool on_limit, Localization& result) {
  result.pose = result.modes.front().pose;
  result.reason.clear();
  if (result.confidence < options.abstain_below) {
    const bool is_explained =
        (!result.goodness.is_known() || result.goodness.explained() >= kExplained) &&
        (!result.above_background || *result.above_background >= kStandsOutNat);
    Withhold(is_explained ? LocalizationStatus::kAmbiguous : LocalizationStatus::kNotExplained,
             is_explained ? "other poses explain the picture about as well (confidence " +
                                Text("%.2f)", result.confidence)
                          : "no pose that was searched explains the picture (confidence " +
                                Text("%.2f)", result.confidence),
             result);
  } else if (options.alert_limit_m > 0.0 &&
             (!result.protection || result.protection->position_m > options.alert_limit_m)) {
    Withhold(LocalizationStatus::kUnprotected,
             result.protection ? Text("the protection level is %.1f m", result.protection->position_m) +
                                     Text(", above the alert limit of %.1f m", options.alert_limit_m)
                               : "no protection level can be given",
             result);
  } else {
    const bool doubtful = result.confidence < options.doubtful_below || on_limit;
    result.status = doubtful ? LocalizationStatus::kDoubtful : LocalizationStatus::kOk;
  }
}

}  // namespace

std::string NameOf(const Building& building) {
  return building.parent_id.empty() ? building.id : building.parent_id + " (" + building.id + ")";
}

void Believe(const SearchedPoses& found,
             const PoseScorer& scorer,
             const ConfidenceOptions& options,
             Localization& result) {
  const PoseSpace& space = scorer.space();
  const CityModel& model = scorer.scene().model();
  const LocalFrame frame{model.origin_in_world};
  const ScoredPose& best = found.modes.front();
  const Posterior posterior = found.volume ? PosteriorOf(*found.volume, found.modes, space, options)
                                           : PosteriorOf(found.modes, options);
  result.spread = posterior.spread;
  result.posterior_mass = posterior.mass;
  result.modes.clear();
  for (const ScoredPose& mode : found.modes) {
    const std::optional<Pose> local = space.PoseAt(mode.offset);
    result.modes.push_back({frame.ToWorld(*local), Score::EnergyOf(mode.log_ratio)});
  }
  result.energy = result.modes.front().energy;
  result.goodness = GoodnessOf(scorer, best.offset);
  result.above_background = found.above_background;
  const auto probability = [&](const OutcomeModel& outcome) {
    return outcome.Probability(posterior.mass, result.goodness, result.above_background);
  };
  result.confidence = result.goodness.is_known() ? probability(options.right)
                                                 : std::min(posterior.mass, kUnjudged);
  if (IsOnBorder(best.offset, space)) result.confidence *= kOnBorder;
  result.protection.reset();
  if (result.goodness.is_known() && !IsOnBorder(best.offset, space)) {
    const double near = std::max(result.confidence, probability(options.near));
    result.protection = ProtectionOf(result.spread, 1.0 - near);
  }
  const std::vector<std::string> limits = LimitsReached(best.offset, space);
  result.doubts = DoubtsOf(result.goodness, model);
  if (!result.goodness.is_known()) {
    result.doubts.push_back("this score compares poses with one another only: whether the best is "
                            "right is not judged");
  }
  if (result.above_background && *result.above_background < kStandsOutNat) {
    result.doubts.push_back("places where it cannot be explain the picture about as well");
  }
  for (const std::string& limit : limits) {
    result.doubts.push_back("the answer lies on the limit of " + limit);
  }
  Decide(options, !limits.empty(), result);
}

void Reconsider(double factor,
                bool on_limit,
                const ConfidenceOptions& options,
                Localization& result) {
  result.confidence *= factor;
  Decide(options, on_limit, result);
}

}  // namespace ridgeline
