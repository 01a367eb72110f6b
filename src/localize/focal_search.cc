// SPDX-License-Identifier: Apache-2.0
#include "localize/focal_search.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "score/score.h"

namespace ridgeline {
namespace {

// A focal length tried: that of the picture's camera times `scale`.
struct Attempt {
  Localization result;
  double scale = 1.0;
  double log_posterior = 0.0;
};

class Trials {
 public:
  Trials(const PictureEvidence& picture,
         const std::function<Localization(const PictureEvidence&)>& localize)
      : picture_(picture), localize_(localize) {}

  // @param deviation  From the reading [standard deviations].
  Attempt At(double scale, double deviation) {
    Attempt attempt;
    attempt.scale = scale;
    attempt.result =
        scale == 1.0 ? localize_(picture_) : localize_(PictureEvidence(picture_, scale));
    attempt.log_posterior = Score::LogRatioOf(attempt.result.energy) - 0.5 * deviation * deviation;
    evaluations_ += attempt.result.evaluations;
    times_.insert(times_.end(), attempt.result.times.begin(), attempt.result.times.end());
    return attempt;
  }

  std::uint64_t evaluations() const { return evaluations_; }
  const std::vector<StageTime>& times() const { return times_; }

 private:
  const PictureEvidence& picture_;
  const std::function<Localization(const PictureEvidence&)>& localize_;
  std::uint64_t evaluations_ = 0;
  std::vector<StageTime> times_;
};

constexpr int kMostDeviations = 2;
// The best of two searches is better than one by chance: another focal length has to gain this.
constexpr double kLeastGainNat = 3.0;

std::string Words(double focal_px, std::size_t readings, double scale_of_reading) {
  char text[160];
  std::snprintf(text,
                sizeof(text),
                "focal length: %.0f px explains the picture best (of %zu reading%s, %+.1f %%)",
                focal_px,
                readings,
                readings == 1 ? "" : "s",
                100.0 * (scale_of_reading - 1.0));
  return text;
}

}  // namespace

Localization WithBestFocal(const PictureEvidence& picture,
                           const std::vector<FocalHypothesis>& hypotheses,
                           const std::function<Localization(const PictureEvidence&)>& localize) {
  if (hypotheses.empty()) return localize(picture);
  Trials trials(picture, localize);
  const double own_px = hypotheses.front().focal_px;
  Attempt best = trials.At(1.0, 0.0);
  const FocalHypothesis* reading = &hypotheses.front();
  for (std::size_t i = 1; i < hypotheses.size(); ++i) {
    Attempt attempt = trials.At(hypotheses[i].focal_px / own_px, 0.0);
    if (attempt.log_posterior < best.log_posterior + kLeastGainNat) continue;
    reading = &hypotheses[i];
    best = std::move(attempt);
  }
  const double read_scale = best.scale;
  const double sigma = reading->sigma_percent / 100.0;
  for (const int direction : {-1, 1}) {
    if (sigma <= 0.0 || best.scale != read_scale) break;
    for (int k = 1; k <= kMostDeviations; ++k) {
      Attempt attempt = trials.At(read_scale * std::exp(direction * k * sigma), k);
      if (attempt.log_posterior < best.log_posterior + kLeastGainNat) break;
      best = std::move(attempt);
    }
  }
  Localization result = std::move(best.result);
  result.evaluations = trials.evaluations();
  result.times = trials.times();
  result.focal_px = own_px * best.scale;
  result.notes.push_back(
      Words(*result.focal_px, hypotheses.size(), best.scale / read_scale));
  return result;
}

}  // namespace ridgeline
