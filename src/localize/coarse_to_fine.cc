// SPDX-License-Identifier: Apache-2.0
#include "localize/coarse_to_fine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace ridgeline {
namespace {

constexpr float kLowest = -std::numeric_limits<float>::infinity();
// Poses this far below the best [nat] are not looked at closely.
constexpr float kMargin = 15.0f;
// Places and headings first looked at lie about this far apart, or as far as in the volume.
constexpr double kCoarseM = 3.4;

// One axis of the volume and which of its places are looked at first: the middles of runs of
// places.
class Axis {
 public:
  // @param coarse_step  Most distance of the places first looked at.
  // @param is_circle  The last place is a neighbour of the first.
  Axis(const std::vector<double>& places, double coarse_step, bool is_circle)
      : is_circle_(is_circle) {
    if (places.size() > 1) {
      stride_ = std::max(1, static_cast<int>(std::lround(coarse_step / (places[1] - places[0]))));
    }
    const auto stride = static_cast<std::size_t>(stride_);
    for (std::size_t run = 0; run < places.size(); run += stride) {
      first_.push_back(std::min(run + stride / 2, places.size() - 1));
    }
  }

  const std::vector<std::size_t>& first() const { return first_; }
  int stride() const { return stride_; }

  // The neighbours of place i among those looked at first: indices into first(), perhaps the same.
  std::array<std::size_t, 2> Around(std::size_t i) const {
    const auto upper = static_cast<std::size_t>(std::lower_bound(first_.begin(), first_.end(), i) -
                                                first_.begin());
    if (upper < first_.size() && first_[upper] == i) return {upper, upper};
    const std::size_t before = is_circle_ ? first_.size() - 1 : 0;
    const std::size_t behind = is_circle_ ? 0 : first_.size() - 1;
    return {upper > 0 ? upper - 1 : before, upper < first_.size() ? upper : behind};
  }

 private:
  std::vector<std::size_t> first_;
  int stride_ = 1;
  bool is_circle_;
};

// A volume and its coarse grid. Places are numbered as in the volume: heights, norths, easts.
class Cascade {
 public:
  Cascade(const PoseSpace& space, const PoseVolume& volume)
      : space_(space),
        volume_(volume),
        east_(volume.east_m, kCoarseM, false),
        north_(volume.north_m, kCoarseM, false),
        height_(volume.height_m, kCoarseM, false),
        heading_(volume.heading_deg, kFirstHeadingStepDeg, space.ranges().heading_deg >= 180.0) {
    for (std::size_t p = 0; p < volume.positions(); ++p) {
      is_admissible_.push_back(PositionOf(p).has_value() ? 1 : 0);
    }
    for (const std::size_t h : height_.first()) {
      for (const std::size_t n : north_.first()) {
        for (const std::size_t e : east_.first()) places_.push_back(NearestAdmissible(h, n, e));
      }
    }
  }

  // What to look at first, by place.
  std::vector<std::vector<std::uint32_t>> FirstLooks() const {
    std::vector<std::uint32_t> orientations;
    for (const std::size_t heading : heading_.first()) {
      for (std::size_t tilt = 0; tilt < volume_.tilts.size(); ++tilt) {
        orientations.push_back(OrientationOf(heading, tilt));
      }
    }
    std::vector<std::vector<std::uint32_t>> looks(volume_.positions());
    for (const auto& place : places_) {
      if (place) looks[*place] = orientations;
    }
    return looks;
  }

  // Where to look closely, by place, given the first looks; sets all other admissible poses of
  // `result` to the highest value around them.
  std::vector<std::vector<std::uint32_t>> CloseLooks(const PoseVolume& first,
                                                     PoseVolume& result) const {
    const float best = *std::max_element(first.log_ratios.begin(), first.log_ratios.end());
    std::vector<std::vector<std::uint32_t>> looks(volume_.positions());
    for (std::size_t p = 0; p < looks.size(); ++p) {
      if (is_admissible_[p] == 0) continue;
      const std::vector<float> highest = HighestAround(p, first);
      for (std::uint32_t o = 0; o < volume_.orientations(); ++o) {
        const std::size_t tilt = o % volume_.tilts.size();
        float around = kLowest;
        for (const std::size_t k : heading_.Around(o / volume_.tilts.size())) {
          around = std::max(around, highest[OrientationOf(heading_.first()[k], tilt)]);
        }
        result.log_ratios[p * volume_.orientations() + o] = around;
        if (around > kLowest && around >= best - kMargin) looks[p].push_back(o);
      }
    }
    return looks;
  }

 private:
  std::uint32_t OrientationOf(std::size_t heading, std::size_t tilt) const {
    return static_cast<std::uint32_t>(heading * volume_.tilts.size() + tilt);
  }
  std::size_t PlaceOf(std::size_t h, std::size_t n, std::size_t e) const {
    return (h * volume_.north_m.size() + n) * volume_.east_m.size() + e;
  }
  std::optional<Eigen::Vector3d> PositionOf(std::size_t place) const {
    const PoseSpace::Offset offset =
        volume_.OffsetOf(place * volume_.orientations(), space_.center_angles());
    return space_.PositionAt(offset.east_m, offset.north_m, offset.height_m);
  }

  // The admissible place nearest to one of the coarse grid, within half a stride.
  std::optional<std::size_t> NearestAdmissible(std::size_t h, std::size_t n, std::size_t e) const {
    const int north_reach = north_.stride() / 2;
    const int east_reach = east_.stride() / 2;
    std::optional<std::size_t> nearest;
    int least = std::numeric_limits<int>::max();
    for (int dn = -north_reach; dn <= north_reach; ++dn) {
      for (int de = -east_reach; de <= east_reach; ++de) {
        const auto north = static_cast<std::ptrdiff_t>(n) + dn;
        const auto east = static_cast<std::ptrdiff_t>(e) + de;
        if (north < 0 || east < 0 || north >= std::ssize(volume_.north_m) ||
            east >= std::ssize(volume_.east_m)) {
          continue;
        }
        const std::size_t place =
            PlaceOf(h, static_cast<std::size_t>(north), static_cast<std::size_t>(east));
        const int distance = dn * dn + de * de;
        if (is_admissible_[place] == 0 || distance >= least) continue;
        least = distance;
        nearest = place;
      }
    }
    return nearest;
  }

  // By orientation, the highest first look from the places of the coarse grid around a place.
  std::vector<float> HighestAround(std::size_t place, const PoseVolume& first) const {
    const std::size_t e = place % volume_.east_m.size();
    const std::size_t n = place / volume_.east_m.size() % volume_.north_m.size();
    const std::size_t h = place / volume_.east_m.size() / volume_.north_m.size();
    std::vector<float> highest(volume_.orientations(), kLowest);
    for (const std::size_t i : height_.Around(h)) {
      for (const std::size_t j : north_.Around(n)) {
        for (const std::size_t k : east_.Around(e)) {
          const auto& corner = places_[(i * north_.first().size() + j) * east_.first().size() + k];
          if (!corner) continue;
          const float* values = &first.log_ratios[*corner * volume_.orientations()];
          for (std::size_t o = 0; o < highest.size(); ++o) {
            highest[o] = std::max(highest[o], values[o]);
          }
        }
      }
    }
    return highest;
  }

  const PoseSpace& space_;
  const PoseVolume& volume_;
  Axis east_, north_, height_, heading_;
  std::vector<std::uint8_t> is_admissible_;
  std::vector<std::optional<std::size_t>> places_;  // of the coarse grid; none: no admissible place
};

}  // namespace

double CoarseSpacingOf(const PoseSpaceOptions& ranges, const MapOptions& options) {
  return std::max(SpacingOf(ranges, options), kCoarseM);
}

PoseVolume ComputeVolumeCoarseToFine(const PoseScorer& tolerant,
                                     const PoseScorer& fine,
                                     std::span<const Tilt> tilts,
                                     const MapOptions& options,
                                     int threads) {
  PoseVolume volume = EmptyVolume(fine.space(), tilts, options);
  const Cascade cascade(fine.space(), volume);
  PoseVolume first = volume;
  FillVolume(tolerant, cascade.FirstLooks(), threads, first);
  const auto looks = cascade.CloseLooks(first, volume);
  volume.evaluations = first.evaluations;
  volume.highest_first = *std::max_element(first.log_ratios.begin(), first.log_ratios.end());
  FillVolume(fine, looks, threads, volume);
  return volume;
}

}  // namespace ridgeline
