// SPDX-License-Identifier: Apache-2.0
#include "track/track_options.h"

#include <string>

namespace ridgeline {

void TrackOptions::Visit(OptionVisitor& v) {
  v.Group("filter", [this](OptionVisitor& g) { filter.Visit(g); });
  v.Group("gnss", [this](OptionVisitor& g) { gnss.Visit(g); });
  v.Field("start_m", start_m, Positive());
  v.Field("max_speed_m_s", max_speed_m_s, Positive());
  v.Field("max_turn_deg_s", max_turn_deg_s, Positive());
  v.Field("key_sigma_m", key_sigma_m, Positive());
  v.Field("key_distance_m", key_distance_m, NotNegative());
  v.Field("glance_distance_m", glance_distance_m, NotNegative());
  v.Field("glance_size_px", glance_size_px, AtLeast(160));
  v.Field("scale_sigma", scale_sigma, Positive());
  v.Field("tilt_sigma_deg", tilt_sigma_deg, Positive());
  v.Field("compass_sigma_deg", compass_sigma_deg, Positive());
  v.Field("fix_sigma_m", fix_sigma_m, Positive());
  v.Field("tracking_from", tracking_from, LeftOpen(0.0, 1.0));
  v.Field("seek_below", seek_below, NotNegative());
  v.Rule("seek_below", seek_below <= tracking_from, std::to_string(seek_below), "<= tracking_from");
  v.Field("lost_radius_m", lost_radius_m, Positive());
}

}  // namespace ridgeline
