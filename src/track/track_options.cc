// SPDX-License-Identifier: Apache-2.0
#include "track/track_options.h"

#include <string>

#include "base/error.h"

namespace ridgeline {

void TrackOptions::Visit(OptionVisitor& v) {
  v.Group("filter", [this](OptionVisitor& g) { filter.Visit(g); });
  v.Group("gnss", [this](OptionVisitor& g) { gnss.Visit(g); });
  v.Field("start_m", start_m);
  v.Field("max_speed_m_s", max_speed_m_s);
  v.Field("max_turn_deg_s", max_turn_deg_s);
  v.Field("key_sigma_m", key_sigma_m);
  v.Field("key_distance_m", key_distance_m);
  v.Field("glance_distance_m", glance_distance_m);
  v.Field("glance_size_px", glance_size_px);
  v.Field("scale_sigma", scale_sigma);
  v.Field("tilt_sigma_deg", tilt_sigma_deg);
  v.Field("compass_sigma_deg", compass_sigma_deg);
  v.Field("fix_sigma_m", fix_sigma_m);
  v.Field("tracking_from", tracking_from);
  v.Field("seek_below", seek_below);
  v.Field("lost_radius_m", lost_radius_m);
}

void TrackOptions::Validate() const {
  filter.Validate();
  gnss.Validate();
  const auto require = [](bool valid, const char* field, double found, const char* expected) {
    if (!valid) throw InputError("", std::string("track.") + field, std::to_string(found), expected);
  };
  const std::pair<const char*, double> positive[] = {{"start_m", start_m},
                                                     {"max_speed_m_s", max_speed_m_s},
                                                     {"max_turn_deg_s", max_turn_deg_s},
                                                     {"key_sigma_m", key_sigma_m},
                                                     {"scale_sigma", scale_sigma},
                                                     {"tilt_sigma_deg", tilt_sigma_deg},
                                                     {"compass_sigma_deg", compass_sigma_deg},
                                                     {"fix_sigma_m", fix_sigma_m},
                                                     {"lost_radius_m", lost_radius_m}};
  for (const auto& [name, value] : positive) require(value > 0.0, name, value, "more than 0");
  require(key_distance_m >= 0.0, "key_distance_m", key_distance_m, "at least 0");
  require(glance_distance_m >= 0.0, "glance_distance_m", glance_distance_m, "at least 0");
  require(glance_size_px >= 160, "glance_size_px", glance_size_px, "at least 160");
  require(tracking_from > 0.0 && tracking_from <= 1.0, "tracking_from", tracking_from, "(0, 1]");
  require(seek_below >= 0.0 && seek_below <= tracking_from,
          "seek_below",
          seek_below,
          "0 to track.tracking_from");
}

}  // namespace ridgeline
