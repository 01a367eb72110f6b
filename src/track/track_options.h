// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/options.h"
#include "track/gnss_monitor.h"
#include "track/pose_filter.h"

namespace ridgeline {

struct TrackOptions {
  PoseFilterOptions filter;
  GnssMonitorOptions gnss;
  // Half-range of the first search, around the first prior or fix [m].
  double start_m = 20.0;
  // What a camera does at most where nothing says how it has moved.
  double max_speed_m_s = 15.0;
  double max_turn_deg_s = 30.0;
  // A picture is looked at closely where the predicted position is less certain than this, or after
  // so much of the way [m]; with a glance (at a reduced size, fewer poses) after so much of the way.
  double key_sigma_m = 0.5;
  double key_distance_m = 4.0;
  double glance_distance_m = 1.0;
  int glance_size_px = 480;
  // Deviation of the odometry's scale, as a share of it, before it has been compared.
  double scale_sigma = 0.03;
  // Deviations of the instruments, where there are readings: tilt, compass [deg], fix [m].
  double tilt_sigma_deg = 1.5;
  double compass_sigma_deg = 10.0;
  double fix_sigma_m = 6.0;
  // A pose is tracked from this confidence on, and sought again below the other.
  double tracking_from = 0.8;
  double seek_below = 0.6;
  // Where the position is less certain than this, nothing is left to follow [m].
  double lost_radius_m = 40.0;

  void Visit(OptionVisitor& v);
};

}  // namespace ridgeline
