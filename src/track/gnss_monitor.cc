// SPDX-License-Identifier: Apache-2.0
#include "track/gnss_monitor.h"

#include <algorithm>
#include <cmath>
#include <string>


namespace ridgeline {
namespace {

// A drag that one fix has seen is as likely as a jump at that fix, but for rounding: the jump, which
// begins later, is believed.
constexpr double kTie = 1.0 - 1e-9;

}  // namespace

void GnssMonitorOptions::Visit(OptionVisitor& v) {
  v.Field("noise_m", noise_m, Positive());
  v.Field("drift_m", drift_m, NotNegative());
  v.Field("drift_time_s", drift_time_s, Positive());
  v.Field("window_s", window_s, Positive());
  v.Field("step_s", step_s, Positive());
  v.Rule("window_s",
         window_s >= step_s && window_s <= 1000.0 * step_s,
         std::to_string(window_s),
         "one to a thousand steps (step_s)");
  v.Field("threshold", threshold, Positive());
}

GnssMonitor::GnssMonitor(const GnssMonitorOptions& options)
    : options_(options), drift_variance_(options.drift_m * options.drift_m) {}

GnssMonitor::Verdict GnssMonitor::Add(double time_s,
                                      const Eigen::Vector2d& fix,
                                      const Eigen::Vector2d& track,
                                      double track_sigma_m) {
  verdict_.first = false;
  if (last_s_ && time_s <= *last_s_) return verdict_;
  const double drift_variance = options_.drift_m * options_.drift_m;
  const double keep = last_s_ ? std::exp(-(time_s - *last_s_) / options_.drift_time_s) : 0.0;
  last_s_ = time_s;
  // Whiten: the filter's prediction of the difference, and its error.
  drift_ *= keep;
  drift_variance_ = keep * keep * drift_variance_ + (1.0 - keep * keep) * drift_variance;
  const double variance =
      drift_variance_ + options_.noise_m * options_.noise_m + track_sigma_m * track_sigma_m;
  const Eigen::Vector2d surprise = fix - track - drift_;
  const double gain = drift_variance_ / variance;
  drift_ += gain * surprise;
  drift_variance_ *= 1.0 - gain;
  // A jump at this fix, or a drag from here on.
  if (!last_begin_s_ || time_s - *last_begin_s_ >= options_.step_s - 1e-6) {
    last_begin_s_ = time_s;
    hypotheses_.push_back({time_s, false, 0.0, Eigen::Vector2d::Zero(), 0.0});
    hypotheses_.push_back({time_s, true, 0.0, Eigen::Vector2d::Zero(), 0.0});
    while (time_s - hypotheses_.front().begin_s > options_.window_s) {
      hypotheses_.erase(hypotheses_.begin());
    }
  }
  const Hypothesis* best = nullptr;
  double highest = 0.0;
  for (Hypothesis& h : hypotheses_) {
    const double lie = h.is_drag ? time_s - h.begin_s : 1.0;
    h.believed *= keep;
    const double trace = lie - h.believed;
    h.believed += gain * trace;
    h.match += trace / variance * surprise;
    h.energy += trace * trace / variance;
    if (h.energy <= 0.0) continue;
    const double ratio = 0.5 * h.match.squaredNorm() / h.energy;
    if (ratio >= kTie * highest) {
      highest = ratio;
      best = &h;
    }
  }
  const bool had_noticed = verdict_.lies;
  if (best != nullptr && (highest >= options_.threshold || !had_noticed)) {
    verdict_.ratio = highest;
    // The begin stays what it was found to be: later it leaves the window.
    if (!had_noticed) {
      verdict_.since_s = best->begin_s;
      verdict_.is_drag = best->is_drag;
      verdict_.size = best->match / best->energy;
    }
  }
  verdict_.lies = had_noticed || highest >= options_.threshold;
  verdict_.first = verdict_.lies && !had_noticed;
  return verdict_;
}

}  // namespace ridgeline
