// SPDX-License-Identifier: Apache-2.0
#include "city/format/gml_polygon.h"

#include <algorithm>
#include <utility>

namespace ridgeline {

void GmlPolygonBuilder::BeginPolygon(std::string_view id) {
  polygon_ = SourcePolygon{static_cast<std::uint32_t>(model_.rings.size()), 0, std::string(id)};
  failed_ = false;
}

void GmlPolygonBuilder::BeginRing() {
  numbers_.clear();
  dimension_ = 0;
}

void GmlPolygonBuilder::AddNumbers(const std::vector<double>& numbers, int dimension) {
  dimension_ = dimension;
  numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
}

// Coordinates in pairs, although lists of triples were to be expected: seen where heights were
// stripped from a file. A triple reading of such a list would be nonsense, not a building.
bool GmlPolygonBuilder::RingLacksHeights() const {
  if (dimension_ == 2) return true;
  const auto closed = [this](std::size_t dimension) {
    return numbers_.size() % dimension == 0 && numbers_.size() >= 4 * dimension &&
           std::equal(numbers_.begin(),
                      numbers_.begin() + static_cast<std::ptrdiff_t>(dimension),
                      numbers_.end() - static_cast<std::ptrdiff_t>(dimension));
  };
  return !closed(3) && closed(2);
}

void GmlPolygonBuilder::DropPolygon(const char* kind, const std::string& building_id) {
  if (!failed_) model_.tally.Add(kind, building_id);
  failed_ = true;
}

void GmlPolygonBuilder::EndRing(const std::string& building_id) {
  if (RingLacksHeights()) {
    DropPolygon("polygons without heights (coordinates in pairs) dropped", building_id);
    return;
  }
  if (numbers_.size() % 3 != 0) {
    DropPolygon("polygons whose coordinates are not triples dropped", building_id);
    return;
  }
  SourceRing ring{static_cast<std::uint32_t>(model_.points.size()), 0};
  for (std::size_t i = 0; i < numbers_.size(); i += 3) {
    const Eigen::Vector3d point(numbers_[i], numbers_[i + 1], numbers_[i + 2]);
    if (ring.point_count > 0 && model_.points.back() == point) continue;
    model_.points.push_back(point);
    ++ring.point_count;
  }
  if (ring.point_count > 1 && model_.points[ring.first_point] == model_.points.back()) {
    model_.points.pop_back();
    --ring.point_count;
  } else if (ring.point_count > 2) {
    model_.tally.Add("rings closed that did not end where they start", building_id);
  }
  if (ring.point_count < 3) {
    model_.points.resize(ring.first_point);
    if (polygon_.ring_count == 0) {
      DropPolygon("polygons with fewer than 3 points dropped", building_id);
    } else {
      model_.tally.Add("holes with fewer than 3 points dropped", building_id);
    }
    return;
  }
  model_.rings.push_back(ring);
  ++polygon_.ring_count;
}

std::optional<std::uint32_t> GmlPolygonBuilder::EndPolygon(const std::string& building_id) {
  if (polygon_.ring_count == 0) DropPolygon("polygons without coordinates dropped", building_id);
  if (failed_) {
    model_.rings.resize(polygon_.first_ring);
    return std::nullopt;
  }
  model_.polygons.push_back(std::move(polygon_));
  return static_cast<std::uint32_t>(model_.polygons.size() - 1);
}

}  // namespace ridgeline
