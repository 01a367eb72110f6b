// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/options.h"

namespace ridgeline {

struct GnssMonitorOptions {
  // An honest receiver: white noise of a fix, and an error that drifts, each per axis [m].
  double noise_m = 1.0;
  double drift_m = 2.0;
  double drift_time_s = 60.0;
  // How far back, and in what steps, the begin of a lie is sought [s].
  double window_s = 60.0;
  double step_s = 1.0;
  // Log likelihood ratio at which a receiver is called a liar.
  double threshold = 13.0;

  void Visit(OptionVisitor& v);
};

// Whether a receiver lies, judged against positions that it had no part in. Under honesty the
// difference of the two is a drifting error (Gauss-Markov) and white noise, which a Kalman filter
// per axis whitens. A lie adds a jump or a drag of constant speed from some time on, whose trace in
// the whitened differences is known but for its size: the generalized likelihood ratio over all
// begins in a window (Willsky and Jones, IEEE Trans. Automatic Control 21, 1976) is tested at every
// fix. Some thousand multiplications for each fix.
class GnssMonitor {
 public:
  explicit GnssMonitor(const GnssMonitorOptions& options);

  struct Verdict {
    bool lies = false;
    double ratio = 0.0;       // the highest log likelihood ratio
    double since_s = 0.0;     // the likeliest begin of the lie
    bool is_drag = false;     // else a jump
    Eigen::Vector2d size = Eigen::Vector2d::Zero();  // [m], of a drag [m/s]
    bool first = false;       // noticed at this fix
  };

  // A fix against the position of the track (east, north [m]) with its deviation per axis. Times
  // that do not rise are passed over.
  Verdict Add(double time_s,
              const Eigen::Vector2d& fix,
              const Eigen::Vector2d& track,
              double track_sigma_m);

  const Verdict& verdict() const { return verdict_; }

 private:
  // A lie that began at a time: its trace in the drift that the filter believes in, and the sums
  // of its fit to the whitened differences.
  struct Hypothesis {
    double begin_s = 0.0;
    bool is_drag = false;
    double believed = 0.0;
    Eigen::Vector2d match = Eigen::Vector2d::Zero();
    double energy = 0.0;
  };

  GnssMonitorOptions options_;
  std::optional<double> last_s_;
  Eigen::Vector2d drift_ = Eigen::Vector2d::Zero();
  double drift_variance_ = 0.0;
  std::optional<double> last_begin_s_;
  std::vector<Hypothesis> hypotheses_;
  Verdict verdict_;
};

}  // namespace ridgeline
