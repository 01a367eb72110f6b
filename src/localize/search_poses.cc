// SPDX-License-Identifier: Apache-2.0
#include "localize/search_poses.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "localize/background.h"
#include "localize/coarse_to_fine.h"
#include "localize/gravity.h"
#include "localize/refine_pose.h"
#include "localize/sampled_search.h"

namespace ridgeline {
namespace {

// As many as a phone's box has in the first look, or half of them.
constexpr int kBackgroundPlaces = 64;

// Refines the first `count` modes, until those that are left could not become the best by gaining
// half as much again as the most any has gained.
void RefineWhileHopeful(const std::vector<ScoredPose>& modes,
                        std::size_t count,
                        const std::function<void(std::size_t first, std::size_t count)>& refine) {
  constexpr std::size_t kAtATime = 2;  // not the number of threads: results must not depend on it
  constexpr double kGainFactor = 1.5;
  constexpr double kMargin = 5.0;
  double best = modes.front().log_ratio;
  double gain = 0.0;
  for (std::size_t done = 0; done < count; done += kAtATime) {
    if (modes[done].log_ratio + kGainFactor * gain + kMargin < best) break;
    const std::size_t end = std::min(count, done + kAtATime);
    const std::vector<ScoredPose> before(modes.begin() + done, modes.begin() + end);
    refine(done, end - done);
    for (std::size_t i = done; i < end; ++i) {
      gain = std::max(gain, modes[i].log_ratio - before[i - done].log_ratio);
      best = std::max(best, modes[i].log_ratio);
    }
  }
}

void SortBestFirst(std::vector<ScoredPose>& modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const ScoredPose& x, const ScoredPose& y) {
    return x.log_ratio > y.log_ratio;
  });
}

// Modes, best first, that were refined to one peak are one, to the last steps of the refinement.
void JoinModes(std::vector<ScoredPose>& modes) {
  constexpr double kSameM = 0.3;
  constexpr double kSameDeg = 0.3;
  std::vector<ScoredPose> apart;
  for (const ScoredPose& mode : modes) {
    const bool is_known = std::any_of(apart.begin(), apart.end(), [&](const ScoredPose& better) {
      return DistanceM(mode.offset, better.offset) <= kSameM &&
             AngleDeg(mode.offset, better.offset) <= kSameDeg;
    });
    if (!is_known) apart.push_back(mode);
  }
  modes = std::move(apart);
}

std::vector<Tilt> TiltsOf(const PoseScorer& scorer,
                          const PictureEvidence& picture,
                          const MapOptions& options) {
  constexpr double kTiltSeparationDeg = 1.0;
  const PoseSpaceOptions& ranges = scorer.space().ranges();
  return FindTilts(picture.segments(),
                   picture.camera(),
                   scorer.space().center_angles(),
                   ranges.pitch_deg,
                   ranges.roll_deg,
                   kTiltSeparationDeg,
                   options.tilts);
}

std::vector<Eigen::Matrix3f> RotationsOf(std::span<const Tilt> tilts) {
  std::vector<Eigen::Matrix3f> cam_from_level;
  for (const Tilt& tilt : tilts) {
    cam_from_level.push_back(CamFromWorld(ViewAngles{0.0, tilt.pitch_deg, tilt.roll_deg})
                                 .toRotationMatrix()
                                 .cast<float>());
  }
  return cam_from_level;
}

// A score as a map uses it, quick under the map's tilts. Between the places of a wide grid the
// model's edges are off by as much as the model errs: there the tolerance is wider.
class MapScore {
 public:
  // @param tolerance  By which the model's errors grow; 1 or less: as they are.
  MapScore(const Score& score, double tolerance, std::span<const Tilt> tilts) : score_(&score) {
    if (tolerance > 1.0) Take(tolerant_, score.Tolerant(tolerance));
    Take(quick_, score_->ForTilts(RotationsOf(tilts)));
  }

  const Score& operator*() const { return *score_; }
  bool is_tolerant() const { return tolerant_ != nullptr; }

 private:
  void Take(std::unique_ptr<Score>& place, std::unique_ptr<Score> score) {
    place = std::move(score);
    if (place) score_ = place.get();
  }

  const Score* score_;
  std::unique_ptr<Score> tolerant_;
  std::unique_ptr<Score> quick_;
};

// The background as the modes are refined, and how far the best mode stands above it then. Returns the
// number of energies computed.
std::uint64_t RefineBackground(const PoseScorer& scorer, int threads, SearchedPoses& found) {
  constexpr std::size_t kRefined = 8;
  // The places are far apart: the first step is a large one.
  constexpr RefineSteps kSteps{.first_m = 2.0, .first_deg = 1.0, .last_m = 0.25};
  if (found.background.empty()) return 0;
  std::vector<ScoredPose> poses;
  for (const BackgroundPose& pose : found.background) poses.push_back(pose.best);
  std::vector<std::uint64_t> evaluations(poses.size());
  RefineWhileHopeful(
      poses, std::min(kRefined, poses.size()), [&](std::size_t first, std::size_t count) {
        ParallelFor(count, threads, [&](std::size_t k) {
          const std::size_t i = first + k;
          const RefinedPose refined =
              RefinePose(scorer.In(found.background[i].space), poses[i], kSteps);
          poses[i] = refined.pose;
          evaluations[i] = refined.evaluations;
        });
      });
  SortBestFirst(poses);
  found.above_background = found.modes.front().log_ratio - poses.front().log_ratio;
  return std::accumulate(evaluations.begin(), evaluations.end(), std::uint64_t{0});
}

// The poses of MapPoses() that can be the best or count beside it.
SearchedPoses SearchMap(const PoseScorer& scorer,
                        const PictureEvidence& picture,
                        const MapOptions& options,
                        int threads) {
  const PoseSpaceOptions& ranges = scorer.space().ranges();
  const std::vector<Tilt> tilts = TiltsOf(scorer, picture, options);
  SearchedPoses found;
  found.spacing_m = SpacingOf(ranges, options);
  const MapScore coarse(scorer.score(), CoarseSpacingOf(ranges, options), tilts);
  if (!coarse.is_tolerant()) {
    found.volume = MapPoses(scorer, picture, options, threads);
    found.evaluations = found.volume->evaluations;
    return found;
  }
  const MapScore fine(scorer.score(), SpacingOf(ranges, options), tilts);
  const PoseScorer first = scorer.With(*coarse);
  found.volume = ComputeVolumeCoarseToFine(first, scorer.With(*fine), tilts, options, threads);
  found.evaluations = found.volume->evaluations;
  found.background = BackgroundOf(
      first, tilts, kFirstHeadingStepDeg, kBackgroundPlaces, threads, found.evaluations);
  if (!found.background.empty()) {
    found.above_background =
        found.volume->highest_first - found.background.front().best.log_ratio;
  }
  return found;
}

}  // namespace

std::string TooFewLines(std::size_t lines) {
  constexpr std::size_t kLeast = 4;
  if (lines >= kLeast) return "";
  return "the picture shows " + std::to_string(lines) + " straight lines; " +
         std::to_string(kLeast) + " are the least";
}

PoseVolume MapPoses(const PoseScorer& scorer,
                    const PictureEvidence& picture,
                    const MapOptions& options,
                    int threads) {
  const std::vector<Tilt> tilts = TiltsOf(scorer, picture, options);
  const MapScore score(scorer.score(), SpacingOf(scorer.space().ranges(), options), tilts);
  return ComputeVolume(scorer.With(*score), tilts, options, threads);
}

SearchedPoses SearchPoses(const PoseScorer& scorer,
                          const PictureEvidence& picture,
                          const SearchOptions& options,
                          std::uint64_t seed,
                          int threads) {
  SearchedPoses found;
  if (options.method == "map") {
    found = SearchMap(scorer, picture, options.map, threads);
    found.modes = FindModes(*found.volume, scorer.space(), options.map);
  } else {
    SampledSearch search = SampleSearch(scorer, options, seed, threads);
    found.evaluations = search.trace.trials.size();
    found.modes = std::move(search.modes);
  }
  return found;
}

std::uint64_t RefineModes(const PoseScorer& scorer, int threads, SearchedPoses& found) {
  std::vector<ScoredPose>& modes = found.modes;
  std::uint64_t total = 0;
  const auto refine = [&](std::size_t first, std::size_t count, const RefineSteps& steps) {
    std::vector<std::uint64_t> evaluations(count);
    ParallelFor(count, threads, [&](std::size_t i) {
      const RefinedPose refined = RefinePose(scorer, modes[first + i], steps);
      modes[first + i] = refined.pose;
      evaluations[i] = refined.evaluations;
    });
    for (const std::uint64_t n : evaluations) total += n;
  };
  RefineWhileHopeful(modes, modes.size(), [&](std::size_t first, std::size_t count) {
    refine(first, count, {0.5 * found.spacing_m, 0.5, 0.3});
  });
  SortBestFirst(modes);
  const std::size_t third = (modes.size() + 2) / 3;
  JoinModes(modes);
  const std::size_t better = std::min(third, modes.size());
  RefineWhileHopeful(modes, better, [&](std::size_t first, std::size_t count) {
    refine(first, count, {0.25, 0.25, 0.06});
  });
  SortBestFirst(modes);
  JoinModes(modes);
  return total + RefineBackground(scorer, threads, found);
}

}  // namespace ridgeline
