// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "city/source_model.h"

namespace ridgeline {

// Puts one GML polygon together, ring by ring, and appends it to a source model. What is wrong with
// it is counted in the model's tally under the building's id.
class GmlPolygonBuilder {
 public:
  explicit GmlPolygonBuilder(SourceModel& model) : model_(model) {}

  void BeginPolygon(std::string_view id);
  void BeginRing();
  // Coordinates of the present ring; it may have several lists. `dimension` as in srsDimension, 0
  // if not said.
  void AddNumbers(const std::vector<double>& numbers, int dimension);
  void EndRing(const std::string& building_id);
  // Index of the polygon; nullopt if it was dropped.
  std::optional<std::uint32_t> EndPolygon(const std::string& building_id);

 private:
  bool RingLacksHeights() const;
  void DropPolygon(const char* kind, const std::string& building_id);

  SourceModel& model_;
  SourcePolygon polygon_;
  bool failed_ = false;
  std::vector<double> numbers_;
  int dimension_ = 0;
};

}  // namespace ridgeline
